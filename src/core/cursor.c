#include "core/cursor.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/error.h"
#include "core/replace_file.h"

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
    const uint32_t bits = vndf_read_u32(reader);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

double vndf_read_f64(vndf_reader *reader)
{
    const uint64_t bits = read_integer(reader, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
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
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    write_integer(writer, bits, 4);
}

void vndf_write_f64(vndf_writer *writer, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    write_integer(writer, bits, 8);
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
char *vndf_read_text(vndf_reader *r, int lines)
{
    uint32_t n = vndf_read_u32(r);
    const unsigned char *bytes = n <= TEXT_MAX ? vndf_read_bytes(r, n) : NULL;
    r->failed |= !bytes;
    for (uint32_t i = 0; bytes && i < n; i++)
        r->failed |= (bytes[i] < 32 && !(lines && bytes[i] == '\n')) || bytes[i] == 127;
    char *text = r->failed ? NULL : malloc((size_t)n + 1);
    if (text) {
        memcpy(text, bytes, n);
        text[n] = '\0';
    }
    return text;
}

/* ---- files ---- */

unsigned char *vndf_read_all(FILE *file, size_t most, size_t *size)
{
    vndf_writer all = {NULL, 0, 0, 0};
    unsigned char part[16384];
    errno = EIO; /* where nothing else is said */
    size_t got = 1;
    while (got > 0 && all.size <= most && !all.failed) { /* in steps, since a pipe does not tell its size */
        got = fread(part, 1, most + 1 - all.size < sizeof part ? most + 1 - all.size : sizeof part, file);
        vndf_write_bytes(&all, part, got);
    }
    vndf_write_bytes(&all, "", 1);
    *size = all.size - 1;
    if (!all.failed && !ferror(file))
        return all.bytes;
    errno = all.failed ? ENOMEM : errno;
    free(all.bytes);
    return NULL;
}

unsigned char *vndf_read_file(const char *path, size_t most, size_t *size, vndf_error *error)
{
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "%s: cannot be opened: %s",
                  path ? path : "the path is NULL", path ? strerror(errno) : "a file name is needed");
        return NULL;
    }
    unsigned char *bytes = vndf_read_all(file, most, size);
    const int reason = errno;
    fclose(file);
    if (!bytes)
        vndf_fail(error, reason == ENOMEM ? VNDF_ERROR_MEMORY : VNDF_ERROR_IO, "%s: cannot be read: %s", path,
                  reason == ENOMEM ? "there is no memory for it" : strerror(reason));
    return bytes;
}

/* ---- our files ---- */

enum { MAGIC = 8 };

vndf_status vndf_frame_check(const vndf_frame *frame, const unsigned char *bytes, size_t size, vndf_error *error)
{
    const char *name = frame->name;
    if (!bytes)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "no bytes: NULL was given");
    if (size < VNDF_FRAME_HEAD || memcmp(bytes, frame->magic, MAGIC) != 0)
        return vndf_fail(error, VNDF_ERROR_TABLE, "not a vndf %s: it must begin with \"%.7s\"", name,
                         frame->magic);
    vndf_reader head = {bytes, size, MAGIC, 0}, last = {bytes, size, size - 4, 0};
    unsigned version = vndf_read_u32(&head), stated = vndf_read_u32(&head);
    if (version != frame->version)
        return vndf_fail(error, VNDF_ERROR_TABLE, "%s format version %u; this library reads version %u%s", name,
                         version, (unsigned)frame->version, version < frame->version ? ": build it again" : "");
    if (stated > frame->most)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes; at most %u are possible",
                         name, stated, (unsigned)frame->most);
    if (stated < size)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes, and more follow", name,
                         stated);
    if (stated > size)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes, but %lu are here", name,
                         stated, (unsigned long)size);
    if (vndf_read_u32(&last) != vndf_crc32(0, bytes, size - 4))
        return vndf_fail(error, VNDF_ERROR_TABLE, "the checksum does not match: the %s is damaged", name);
    return VNDF_OK;
}

void *vndf_frame_load(const vndf_frame *frame, const char *path, vndf_frame_decode *decode, vndf_error *error)
{
    size_t size = 0;
    unsigned char *bytes = vndf_read_file(path, frame->most, &size, error);
    if (!bytes)
        return NULL;
    vndf_error inner = {VNDF_OK, ""};
    void *made = decode(bytes, size, &inner);
    if (!made)
        vndf_fail(error, inner.status, "%s: %s", path, inner.message);
    free(bytes);
    return made;
}

void vndf_frame_begin(const vndf_frame *frame, vndf_writer *w)
{
    vndf_write_bytes(w, frame->magic, MAGIC);
    vndf_write_u32(w, frame->version);
    vndf_write_u32(w, 0);
}

void vndf_frame_end(vndf_writer *w)
{
    uint32_t size = (uint32_t)w->size + 4;
    for (int i = 0; !w->failed && i < 4; i++)
        w->bytes[MAGIC + 4 + i] = (unsigned char)(size >> 8 * i);
    vndf_write_u32(w, w->failed ? 0 : vndf_crc32(0, w->bytes, w->size));
}

vndf_status vndf_frame_save(vndf_writer *w, const char *path, void *bytes, size_t size, vndf_error *error)
{
    vndf_status status = VNDF_OK;
    if (!w->failed && path && !vndf_replace_whole(path, w->bytes, w->size))
        status = vndf_fail(error, errno == ENOMEM ? VNDF_ERROR_MEMORY : VNDF_ERROR_IO, "%s %s: %s",
                           errno == ENOMEM ? "no memory to save" : "cannot write", path, strerror(errno));
    else if (w->failed)
        status = vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %zu bytes", w->size);
    else if (!path && size != w->size)
        status = vndf_fail(error, VNDF_ERROR_ARGUMENT, "the memory has %zu bytes, the file %zu", size, w->size);
    else if (!path)
        memcpy(bytes, w->bytes, size);
    free(w->bytes);
    return status;
}
