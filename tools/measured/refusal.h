/* Why a file of measurements is refused, in words for people: the file, the place in it, what is wrong, what would be
 * right. And what was found in one that is not, as lines `key value`. */
#ifndef TOOLS_MEASURED_REFUSAL_H
#define TOOLS_MEASURED_REFUSAL_H

#include <stddef.h>

#if defined(__GNUC__)
#  define MEASURED_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#  define MEASURED_PRINTF(text, first)
#endif

typedef struct refusal {
    char message[512];
} refusal;

/* "NAME: message"; returns 0, so that a reader can end with it. */
int refuse_data(refusal *why, const char *name, const char *format, ...) MEASURED_PRINTF(3, 4);

/* Lines that grow; a zeroed one is empty. What does not fit is left out. */
typedef struct notes {
    char text[4096];
    size_t used;
} notes;

/* Adds one line. */
void note(notes *to, const char *format, ...) MEASURED_PRINTF(2, 3);

#endif
