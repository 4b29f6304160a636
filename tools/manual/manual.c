#include "manual/manual.h"

#include <string.h>

void manual_command_from(const command_form *form, manual_command *command)
{
    command->help = form->help;
    command->positional = form->positional;
    command->option_count = 0;
    for (size_t i = 0; i < form->option_count && i < WORDS_MAX; i++) {
        const option_form *option = &form->options[i];
        manual_option taken = {option->name, option->takes_value};
        command->option[command->option_count++] = taken;
    }
}

const char *manual_mode(const manual *from, const manual_command *command)
{
    size_t length = strlen(command->name);
    for (size_t i = 0; i < from->count; i++)
        if (strncmp(from->command[i].name, command->name, length) == 0 && from->command[i].name[length] == ' ')
            return from->command[i].name + length + 1;
    return NULL;
}

values manual_positional(const manual *from, const manual_command *command)
{
    values may = values_of(command->positional);
    const char *mode = manual_mode(from, command);
    if (mode)
        values_add(&may, mode);
    for (size_t i = 0; i < from->count && strcmp(command->positional, "COMMAND") == 0; i++)
        if (!strchr(from->command[i].name, ' '))
            values_add(&may, from->command[i].name);
    return may;
}
