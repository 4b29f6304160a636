/* Files that appear in a folder together. The folder is made if it is not there. If it is, it must be empty or
 * hold a page of the same command, whose files are then replaced - none of them if one is an input - and
 * nothing else touched. All files are written to temporaries first and renamed when all have been written; a
 * failure or a signal before that leaves the folder as it was. A file that is there already, byte for byte,
 * stays. */
#ifndef TOOLS_DRAW_FOLDER_H
#define TOOLS_DRAW_FOLDER_H

#include "draw/page.h"

typedef enum folder_state { FOLDER_REFUSED, FOLDER_NEW, FOLDER_EMPTY, FOLDER_OURS } folder_state;

/* Complains if it is refused. */
folder_state folder_examine(const char *command, const char *path);

/* Writes the files; `held` are the signals that wait (tools/cli/output.h). An exit status, with a complaint if it is
 * not good. */
int folder_write(const char *command, const char *path, const page_file *files, size_t count, unsigned held);

#endif
