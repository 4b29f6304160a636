/* The subcommands of `vndf` and what they return. Each takes the words after its own name, prints its
 * answer on stdout and its complaints on stderr as `vndf NAME: ...`, and returns an exit status. */
#ifndef TOOLS_COMMAND_H
#define TOOLS_COMMAND_H

#include <stddef.h>

enum {
    STATUS_GOOD = 0, /* done, and the answer is yes */
    STATUS_NO = 1,   /* done, and the answer is no: a claim failed */
    STATUS_USE = 2   /* not done: wrong use, unreadable input, an output that cannot be written */
};

int command_build(int argc, char **argv);
int command_info(int argc, char **argv);
int command_check(int argc, char **argv);
int command_sample(int argc, char **argv);
int command_eval(int argc, char **argv);
int command_plot(int argc, char **argv);
int command_report(int argc, char **argv);
int command_bench(int argc, char **argv);
int command_bench_effects(int argc, char **argv); /* the words after `bench effects` */
int command_albedo(int argc, char **argv);
int command_export(int argc, char **argv);
int command_explore(int argc, char **argv);
int command_render(int argc, char **argv);
int command_help(int argc, char **argv);

typedef struct subcommand {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *purpose;
} subcommand;

/* All of them, in the order of `vndf --help`. */
extern const subcommand subcommands[];
extern const size_t subcommand_count;

/* What `vndf --help` prints; an exit status. */
int print_help(void);

/* Says that there is no such command, and which one may be meant; STATUS_USE. */
int refuse_subcommand(const char *command, const char *wrong);

#endif
