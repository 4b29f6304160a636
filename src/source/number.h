/* Numbers as text, the same in every locale: a decimal point is '.', whatever setlocale() was told. */
#ifndef VNDF_SOURCE_NUMBER_H
#define VNDF_SOURCE_NUMBER_H

#include <stddef.h>

/* Longest number that is read, and space for one that is printed. */
enum { VNDF_NUMBER_LENGTH = 4096, VNDF_NUMBER_TEXT = 32 };

/* Reads [+-] digits [. digits] [e [+-] digits] from the start of text, correctly rounded, into *value
 * (infinite if it is too large). Returns how many characters belong to the number; 0 if there is none. No
 * hexadecimal, no "inf" or "nan". */
size_t vndf_number_read(const char *text, size_t size, double *value);

/* The same for text that must be one number from its first to its last character: 1 if it is. */
int vndf_number_is_all(const char *text, size_t size, double *value);

/* Prints the shortest of %.15g, %.16g, %.17g that reads back as the same double; returns out. */
const char *vndf_number_print(char out[VNDF_NUMBER_TEXT], double value);

#endif
