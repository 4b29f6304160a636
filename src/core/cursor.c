#include "core/cursor.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/error.h"

typedef union number {
    uint32_t u32;
    float f32;
    uint64_t u64;
    double f64;
} number;

const unsigned char *vndf_read_bytes(vndf_reader *reader, size_t n)
{
    if (reader->failed || n > reader->size - reader->at) {
        reader->failed = 1;
        return NULL;
    }
    reader->at += n;
    return reader->bytes + (reader->at - n);
}

static uint64_t read_integer(vndf_reader *reader, unsigned n)
{
    const unsigned char *bytes = vndf_read_bytes(reader, n);
    uint64_t value = 0;
    for (unsigned i = 0; bytes && i < n; i++)
        value |= (uint64_t)bytes[i] << (8 * i);
    return value;
}

uint32_t vndf_read_u32(vndf_reader *reader)
{
    return (uint32_t)read_integer(reader, 4);
}

float vndf_read_f32(vndf_reader *reader)
{
    number n = {.u32 = vndf_read_u32(reader)};
    return n.f32;
}

double vndf_read_f64(vndf_reader *reader)
{
    number n = {.u64 = read_integer(reader, 8)};
    return n.f64;
}

void vndf_write_bytes(vndf_writer *writer, const void *bytes, size_t n)
{
    if (!writer->failed && n > writer->capacity - writer->size) {
        size_t capacity = 2 * (writer->size + n + 32);
        unsigned char *grown = realloc(writer->bytes, capacity);
        writer->failed = grown == NULL;
        writer->bytes = grown ? grown : writer->bytes;
        writer->capacity = grown ? capacity : writer->capacity;
    }
    if (writer->failed || n == 0)
        return;
    memcpy(writer->bytes + writer->size, bytes, n);
    writer->size += n;
}

static void write_integer(vndf_writer *writer, uint64_t value, unsigned n)
{
    unsigned char bytes[8];
    for (unsigned i = 0; i < n; i++)
        bytes[i] = (unsigned char)(value >> (8 * i));
    vndf_write_bytes(writer, bytes, n);
}

void vndf_write_u32(vndf_writer *writer, uint32_t value)
{
    write_integer(writer, value, 4);
}

void vndf_write_f32(vndf_writer *writer, float value)
{
    number n = {.f32 = value};
    write_integer(writer, n.u32, 4);
}

void vndf_write_f64(vndf_writer *writer, double value)
{
    number n = {.f64 = value};
    write_integer(writer, n.u64, 8);
}

/* ---- texts ---- */

enum { TEXT_MAX = 32768 };

void vndf_write_text(vndf_writer *w, const char *text)
{
    size_t n = strlen(text);
    vndf_write_u32(w, (uint32_t)n);
    vndf_write_bytes(w, text, n);
}

/* Programs print the texts, and a control character could harm a terminal. */
char *vndf_read_text(vndf_reader *r)
{
    uint32_t n = vndf_read_u32(r);
    const unsigned char *bytes = n <= TEXT_MAX ? vndf_read_bytes(r, n) : NULL;
    r->failed |= !bytes;
    for (uint32_t i = 0; bytes && i < n; i++)
        r->failed |= bytes[i] < 32 || bytes[i] == 127;
    char *text = r->failed ? NULL : malloc((size_t)n + 1);
    if (text) {
        memcpy(text, bytes, n);
        text[n] = '\0';
    }
    return text;
}

/* ---- files ---- */

unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error)
{
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "%s: cannot be opened: %s",
                  path ? path : "the path is NULL", path ? strerror(errno) : "a file name is needed");
        return NULL;
    }
    vndf_writer all = {NULL, 0, 0, 0};
    unsigned char part[16384];
    size_t got = 1;
    errno = 0;
    while (got > 0 && all.size <= most && !all.failed) { /* in steps, since a pipe does not tell its size */
        got = fread(part, 1, most + 1 - all.size < sizeof part ? most + 1 - all.size : sizeof part, file);
        vndf_write_bytes(&all, part, got);
    }
    vndf_write_bytes(&all, "", 1); /* so that an empty file has bytes */
    int reason = errno, failed = ferror(file);
    fclose(file);
    *size = all.size - 1;
    if (!all.failed && !failed)
        return all.bytes;
    if (!all.failed)
        vndf_fail(error, VNDF_ERROR_IO, "%s: cannot be read: %s", path,
                  reason ? strerror(reason) : "unknown reason");
    else
        vndf_fail(error, VNDF_ERROR_MEMORY, "%s: no memory to read it", path);
    free(all.bytes);
    return NULL;
}
