/* The commands of `vndf` and what they return. Each is a file in commands/, which prints its answer on stdout and its
 * complaints on stderr as `vndf NAME: ...`. */
#pragma once

#include <stddef.h>

struct arguments;

enum {
    STATUS_GOOD = 0, /* done, and the answer is yes */
    STATUS_NO = 1,   /* done, and the answer is no: a claim failed */
    STATUS_USE = 2   /* not done: wrong use, unreadable input, an output that cannot be written */
};

typedef struct subcommand {
    const char *name;       /* "vndf build" */
    const char *purpose;    /* for `vndf --help` */
    const char *positional; /* the words that are no options, "FILE|ggx|beckmann"; a hint where there are none */
    size_t least, most;     /* how many of these */
    int (*run)(const struct arguments *); /* an exit status */
    const char *const *help;              /* its chapters, NULL ends them: C promises 4095 characters of a text */
} subcommand;

extern const subcommand command_build, command_info, command_check, command_sample, command_plot, command_report,
    command_bench, command_bake, command_export, command_explore, command_render, command_judge;
