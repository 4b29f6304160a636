/* Files that appear in a folder together. The folder is made if it does not exist. If it exists, it must be empty
 * or hold a page of the same command. The files of that page are then replaced - none if one of them is an input -
 * and nothing else is touched. All files are written to temporaries first and renamed when all are complete; a
 * failure or a signal before that leaves the folder as it was. A file that is there already, byte for byte,
 * stays. */
#ifndef TOOLS_DRAW_FOLDER_H
#define TOOLS_DRAW_FOLDER_H

#include "draw/page.h"

typedef enum folder_state { FOLDER_REFUSED, FOLDER_NEW, FOLDER_EMPTY, FOLDER_OURS } folder_state;

/* Complains if the folder is refused. */
folder_state folder_examine(const char *command, const char *path);

/* Writes the files; `held` are the blocked signals (tools/cli/output.h). Returns an exit status, after a complaint
 * if it is not good. */
int folder_write(const char *command, const char *path, const page_file *files, size_t count, unsigned held);

#endif
