/* A file that is replaced at once: what is written goes to a temporary beside it, which is renamed over it when it
 * is whole and on the disk. At the end of symbolic links it is the file that they lead to that is replaced, which keeps
 * its mode; a link that leads nowhere is replaced itself. For vndf_save, and for the outputs of the program. */
#ifndef VNDF_CORE_REPLACE_FILE_H
#define VNDF_CORE_REPLACE_FILE_H

#include <stddef.h>
#include <stdio.h>

typedef struct vndf_replacement {
    char *target;    /* owned: the file behind all links */
    char *temporary; /* owned */
    FILE *file;      /* to write to */
} vndf_replacement;

/* 0 and errno, with nothing left behind. */
int vndf_replace_begin(vndf_replacement *r, const char *path);

/* 0 and errno if anything could not be written, now or before; the file is as it was then. Either ends r. */
int vndf_replace_commit(vndf_replacement *r);
void vndf_replace_discard(vndf_replacement *r);

/* Both at once: the file holds these bytes. 0 and errno, with nothing left behind. */
int vndf_replace_whole(const char *path, const void *bytes, size_t size);

/* Flushes; 0 and errno, which may be 0, if that failed or any write before. */
int vndf_replace_flush(FILE *file);

#endif
