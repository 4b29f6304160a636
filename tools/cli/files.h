/* The files that this run of the program reads and writes, known by device and inode: by these a file is the
 * same under all its names, links included. Inputs are noted where they are opened - words of a command line,
 * scenes, what scenes name - and outputs where they are, so that no output replaces an input, in whatever
 * order they come. The list is the process's, as its files are. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* NULL, or what forbids that: "an output of this command". What is no file, or not there, is not noted. */
const char *files_note(const char *path, int is_output);

/* Whether two paths lead to one file, be it there already or not. */
int files_same(const char *a, const char *b);

/* All bytes of a file that is not trusted, or of stdin for "-", noted as an input, with a 0 behind them; to be freed.
 * NULL after a complaint if it cannot be read, has more than `most` bytes, or there is no memory. */
char *input_read(const char *command, const char *path, size_t most, size_t *size);

const char *input_name(const char *path);

/* Whole ones, and floats of 4 or 8 bytes. */
uint64_t little_whole(const unsigned char *at, size_t bytes);
double little_number(const unsigned char *at, size_t bytes);

void put_little(FILE *file, uint64_t value, size_t bytes);
void put_floats(FILE *file, const float *x, size_t count);

/* Into 4 * count bytes. */
void floats_to_bytes(unsigned char *bytes, const float *x, size_t count);
