/* The files that this run of the program reads and writes, known by device and inode: by these a file is the
 * same under all its names, links included. Inputs are noted where they are opened - words of a command line,
 * scenes, what scenes name - and outputs where they are, so that no output replaces an input, in whatever
 * order they come. The list is the process's, as its files are. */
#ifndef TOOLS_CLI_FILES_H
#define TOOLS_CLI_FILES_H

#include <stddef.h>

/* Opens something for each of the descriptors 0 to 2 that is closed, so that no file gets its number and is
 * taken for stdin, stdout or stderr: reading and writing there fails as before. Notes what stdout is. To be
 * called before anything is opened; 0 if it cannot be done. */
int files_begin(void);

/* NULL, or what forbids that: "an output of this command". What is no file, or not there, is not noted. */
const char *files_note_input(const char *path);
const char *files_note_output(const char *path);

/* Of stdin, where a command reads it. */
const char *files_note_stdin(void);

/* Whether two paths lead to one file, be it there already or not. */
int files_same(const char *a, const char *b);

/* All bytes of a file that is not trusted, noted as an input, with a 0 behind them; to be freed. NULL and the reason if
 * it cannot be read, has more than `most` bytes, or there is no memory. */
char *files_read(const char *path, size_t most, size_t *size, char *reason, size_t reason_size);

#endif
