/* Holds a picture against another one. */
#ifndef TOOLS_COMMANDS_RENDER_AGAINST_H
#define TOOLS_COMMANDS_RENDER_AGAINST_H

#include "render/film.h"

/* Reads the other picture, a PFM of the film's size. 0 after a complaint. */
int render_against_read(const char *command, const char *path, int width, int height, image *other);

/* Prints the mean over pixels of the difference of luminance, over the mean luminance of the other picture; and how
 * much more light there is in all. */
void render_against_print(const film *f, const image *other, const char *path);

#endif
