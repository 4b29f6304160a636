/* A sampler as a process: a command of the shell that reads queries from stdin, one a line, to its end, and answers
 * each by a line on stdout, in their order:
 *
 *     s wi.x wi.y wi.z u1 u2 u3          by    wm.x wm.y wm.z pdf
 *     p wi.x wi.y wi.z wm.x wm.y wm.z    by    pdf
 */
#ifndef TOOLS_JUDGE_PROCESS_H
#define TOOLS_JUDGE_PROCESS_H

#include <stddef.h>

#include "vndf.h"

typedef struct query {
    char kind;       /* 's' or 'p' */
    vndf_vec3 wi, x; /* x: u1 u2 u3, or wm */
} query;

typedef struct answer {
    double x, y, z, pdf; /* of 'p' the density alone; NaN and infinity are numbers */
} answer;

/* Runs the command once. The answers are to be freed. NULL after a complaint of `who`: the command does not run or ends
 * with a status other than 0, a line is no answer, there are too few lines or too many, or queries is NULL, for want of
 * memory. */
answer *process_ask(const char *who, const char *command, const query *queries, size_t count);

#endif
