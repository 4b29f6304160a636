/* What `vndf bake` writes for each table: numbers for numpy (.npy), textures of half floats for engines (.dds), arrays
 * for C, GLSL and JavaScript, and a picture (.png); and a page that shows them all. */
#ifndef TOOLS_BAKE_FILES_H
#define TOOLS_BAKE_FILES_H

#include "bake/bake.h"
#include "draw/page.h"

/* As --format has them; the picture is always written. */
typedef enum bake_form { BAKE_NPY, BAKE_DDS, BAKE_C, BAKE_GLSL, BAKE_JS, BAKE_PICTURE } bake_form;

/* Adds the file of a table in this form to a page; `made_by` is the command. 0 after a complaint. */
int bake_file(html_page *page, const baked *b, bake_form form, const char *made_by);

/* A section of the page about a table. */
void bake_section(html_page *page, const baked *b);

/* The half float nearest to x, ties to even; what is too large is infinite. */
unsigned bake_half(float x);

#endif
