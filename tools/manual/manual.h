/* The manual page and the completion of bash, from the forms of all commands: the tables of options that they parse
 * with, and the texts that they print for --help. */
#ifndef TOOLS_MANUAL_MANUAL_H
#define TOOLS_MANUAL_MANUAL_H

#include <stdio.h>

#include "cli/arguments.h"
#include "manual/values.h"

typedef struct manual_option {
    const char *name;
    int takes_value;
} manual_option;

typedef struct manual_command {
    const char *name; /* "build", "bench effects" */
    const char *purpose;
    const char *help;
    const char *positional;
    manual_option option[WORDS_MAX];
    size_t option_count;
} manual_command;

/* The head is the text of `vndf --help`. */
typedef struct manual {
    const char *version, *head;
    const manual_command *command;
    size_t count;
} manual;

/* Takes what is of use of the form; name and purpose stay. */
void manual_command_from(const command_form *form, manual_command *command);

/* What may stand without an option: what the form says, a mode of the command ("effects" of bench), and all commands
 * where the form says COMMAND. */
values manual_positional(const manual *from, const manual_command *command);

/* The mode of the command that is a command of its own, "effects" of bench; else NULL. */
const char *manual_mode(const manual *from, const manual_command *command);

void manual_write_man(const manual *from, FILE *to);
void manual_write_bash(const manual *from, FILE *to);

#endif
