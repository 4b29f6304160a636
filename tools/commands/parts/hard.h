/* The hard cases (stress.h) as parts of `vndf check`: --hard and --at. */
#ifndef TOOLS_COMMANDS_HARD_H
#define TOOLS_COMMANDS_HARD_H

#include "vndf.h"

/* Runs the whole product, prints a line or two for each property; STATUS_GOOD, or STATUS_NO if one fails. */
int hard_check(const vndf_distribution *distribution, unsigned long long seed);

/* The same for one input, `numbers` as hard_check prints them: wi, alpha, u1 and u2, and wo where
 * there is one; STATUS_USE after a complaint if they are none. */
int hard_check_at(const vndf_distribution *distribution, const char *command, const char *numbers);

#endif
