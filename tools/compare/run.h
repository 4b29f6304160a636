/* A comparison from its choice to its page. */
#ifndef COMPARE_RUN_H
#define COMPARE_RUN_H

#include "compare/comparison.h"
#include "draw/folder.h"

/* Bytes. A fine table is as good as exact, and soon built. */
enum { COMPARE_TABLES_MAX = WAYS_MAX - 2, COMPARE_FINE_TABLE = 32768, COMPARE_LARGEST_TABLE = 1048576 };

typedef struct compare_choice {
    const char *command;                                         /* opens every message */
    const char *scene;                                           /* its file */
    const char *arguments;                                       /* all words, for the page */
    unsigned long long spp, reference_spp, width, threads, seed; /* the first three: 0 if not given */
    double seconds;                                              /* for all, where spp is not given */
    double table[COMPARE_TABLES_MAX];
    size_t table_count; /* 0: samplers are compared */
    path_sampler sampler[WAYS_MAX];
    size_t sampler_count;
    int named;             /* the samplers were: one that the scene cannot have is an error */
    const char *reference; /* a PFM; NULL: rendered */
} compare_choice;

/* Renders and writes the page into the folder; an exit status. */
int compare_run(const compare_choice *choice, const char *folder, folder_state state);

#endif
