/* Files that appear whole or not at all (core/replace_file.h), none of which is an input as well (files.h). While the
 * temporary exists, SIGINT, SIGTERM and SIGHUP wait; writers ask output_stopping() now and then, and closing lets the
 * signal through after the temporary is gone. */
#pragma once

#include "core/replace_file.h"

typedef struct output_file {
    const char *command;       /* opens every message */
    const char *path;          /* NULL for stdout */
    FILE *file;                /* to write to */
    vndf_replacement replaces; /* unless it is stdout */
} output_file;

/* Opens path, "-" for stdout. What a rename would damage is refused: a device, a pipe, a folder, an input of the
 * command. Returns 1, or 0 and all 0 after a complaint. */
int output_open(output_file *output, const char *command, const char *path);

/* 1 if one of the signals that wait has come; close with output_give_up then. */
int output_stopping(void);

/* Closes and renames. Returns an exit status; a reader of stdout that went away is no complaint. What may fail for want
 * of memory comes before: figures are complete. */
int output_commit(output_file *output);

/* All or, if one cannot be written or `status` is not good, none; the first is renamed last. Those that are all 0 are
 * left out. An exit status. */
int output_commit_all(output_file *output, size_t count, int status);

/* Closes, leaves nothing behind, and complains, unless `why` is NULL: another file failed. An exit status. */
int output_give_up(output_file *output, const char *why);

int output_is_stdout(const char *path);

/* Before anything is opened: descriptors 0 to 2 are open, so that no file becomes one of them. And a file that outgrows
 * a limit of the shell fails to be written, as on a full disk, and ends nothing. 0: there is no /dev/null. */
int output_begin(void);

/* Makes the stopping signals wait until as many callers have released them as held them. */
void output_hold_signals(void);
void output_release_signals(void);

/* Flushes stdout; an exit status, with a complaint if what was printed could not be delivered. */
int output_finish_stdout(const char *command);

/* Which of these forms, {"csv", "f32", NULL} say, an output has by its name; the first for stdout. -1 after a
 * complaint. */
int output_form(const char *command, const char *path, const char *const *forms);
