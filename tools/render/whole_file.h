/* All bytes of a file that is not trusted. */
#ifndef RENDER_WHOLE_FILE_H
#define RENDER_WHOLE_FILE_H

#include <stddef.h>

/* The bytes, with a 0 behind them; the caller frees them. Returns NULL and the reason in `reason` if the file
 * cannot be read, has more than `most` bytes, or there is no memory. */
char *whole_file(const char *path, size_t most, size_t *size, char *reason, size_t reason_size);

#endif
