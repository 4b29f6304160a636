#include "measured/refusal.h"

#include <stdarg.h>
#include <stdio.h>

int refuse_data(refusal *why, const char *name, const char *format, ...)
{
    int length = snprintf(why->message, sizeof why->message, "%.300s: ", name);
    va_list list;
    va_start(list, format);
    vsnprintf(why->message + length, sizeof why->message - (size_t)length, format, list);
    va_end(list);
    return 0;
}

void note(notes *to, const char *format, ...)
{
    va_list list;
    size_t room = sizeof to->text - to->used;
    va_start(list, format);
    int length = vsnprintf(to->text + to->used, room, format, list);
    va_end(list);
    if (length < 0 || (size_t)length + 1 >= room) {
        to->text[to->used] = '\0';
        return;
    }
    to->used += (size_t)length;
    to->text[to->used++] = '\n';
    to->text[to->used] = '\0';
}
