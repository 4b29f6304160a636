#include "core/frame.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/cursor.h"
#include "core/error.h"
#include "core/replace_file.h"

enum { MAGIC = 8 };

/* Checks the first bytes; *stated is the size that they state. */
static vndf_status check_head(const vndf_frame *frame, const unsigned char *bytes, size_t size, uint32_t *stated,
                              vndf_error *error)
{
    vndf_reader r = {bytes, size, MAGIC, 0};
    if (size < VNDF_FRAME_HEAD || memcmp(bytes, frame->magic, MAGIC) != 0)
        return vndf_fail(error, VNDF_ERROR_TABLE, "not a vndf %s: it must begin with \"%.7s\"", frame->name,
                         frame->magic);
    uint32_t version = vndf_read_u32(&r);
    *stated = vndf_read_u32(&r);
    if (version != frame->version)
        return vndf_fail(error, VNDF_ERROR_TABLE, "%s format version %u; this library reads version %u%s",
                         frame->name, (unsigned)version, (unsigned)frame->version,
                         version < frame->version ? ": build it again" : "");
    if (*stated < 64 || *stated > frame->most)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes; from 64 to %u are possible",
                         frame->name, (unsigned)*stated, (unsigned)frame->most);
    return VNDF_OK;
}

vndf_status vndf_frame_check(const vndf_frame *frame, const unsigned char *bytes, size_t size, vndf_error *error)
{
    uint32_t stated = 0;
    vndf_status status = check_head(frame, bytes, size, &stated, error);
    if (status != VNDF_OK)
        return status;
    if (stated != size)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes, but %lu are here",
                         frame->name, (unsigned)stated, (unsigned long)size);
    vndf_reader last = {bytes, size, size - 4, 0};
    if (vndf_read_u32(&last) != vndf_crc32(0, bytes, size - 4))
        return vndf_fail(error, VNDF_ERROR_TABLE, "the checksum does not match: the %s is damaged", frame->name);
    return VNDF_OK;
}

/* Reads the size that the head states and one byte more: an endless file or pipe must not be read for ever. */
static unsigned char *read_stream(const vndf_frame *frame, FILE *file, size_t *size, vndf_error *error)
{
    unsigned char head[VNDF_FRAME_HEAD];
    uint32_t stated = 0;
    size_t n = fread(head, 1, sizeof head, file);
    if (ferror(file) || check_head(frame, head, n, &stated, error) != VNDF_OK)
        return NULL;
    unsigned char *bytes = malloc((size_t)stated + 1);
    if (!bytes) {
        vndf_fail(error, VNDF_ERROR_MEMORY, "no memory for %u bytes", (unsigned)stated);
        return NULL;
    }
    memcpy(bytes, head, sizeof head);
    *size = n + fread(bytes + n, 1, (size_t)stated + 1 - n, file);
    if (!ferror(file) && *size <= stated)
        return bytes;
    if (!ferror(file))
        vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes, and more follow", frame->name,
                  (unsigned)stated);
    free(bytes);
    return NULL;
}

/* The whole of a file, to be freed. */
static unsigned char *read_file(const vndf_frame *frame, const char *path, size_t *size, vndf_error *error)
{
    vndf_error inner = {VNDF_OK, ""};
    FILE *file = path ? fopen(path, "rb") : NULL;
    if (!file) {
        vndf_fail(error, path ? VNDF_ERROR_IO : VNDF_ERROR_ARGUMENT, "cannot open %s: %s", path ? path : "(NULL)",
                  path ? strerror(errno) : "no path");
        return NULL;
    }
    errno = 0;
    unsigned char *bytes = read_stream(frame, file, size, &inner);
    if (!bytes && inner.status == VNDF_OK)
        vndf_fail(error, VNDF_ERROR_IO, "cannot read %s: %s", path, errno ? strerror(errno) : "unknown reason");
    else if (!bytes)
        vndf_fail(error, inner.status, "%s: %s", path, inner.message);
    fclose(file);
    return bytes;
}

void *vndf_frame_load(const vndf_frame *frame, const char *path, vndf_frame_decode *decode, vndf_error *error)
{
    size_t size = 0;
    unsigned char *bytes = read_file(frame, path, &size, error);
    if (!bytes)
        return NULL;
    vndf_error inner = {VNDF_OK, ""};
    void *made = decode(bytes, size, &inner);
    if (!made)
        vndf_fail(error, inner.status, "%s: %s", path, inner.message);
    free(bytes);
    return made;
}

/* ---- saving ---- */

static vndf_status no_memory(const char *path, vndf_error *error)
{
    return vndf_fail(error, VNDF_ERROR_MEMORY, "no memory to save %s", path);
}

vndf_status vndf_frame_save(const void *what, vndf_frame_encode *encode, const char *path, vndf_error *error)
{
    size_t size = encode(what, NULL, 0);
    unsigned char *bytes = malloc(size);
    if (!bytes)
        return no_memory(path, error);
    encode(what, bytes, size);
    int good = vndf_replace_whole(path, bytes, size), reason = errno;
    free(bytes);
    if (good)
        return VNDF_OK;
    return reason == ENOMEM ? no_memory(path, error)
                            : vndf_fail(error, VNDF_ERROR_IO, "cannot write %s: %s", path, strerror(reason));
}

vndf_status vndf_frame_save_memory(const void *what, vndf_frame_encode *encode, void *bytes, size_t size,
                                   vndf_error *error)
{
    size_t needed = encode(what, NULL, 0);
    if (size != needed)
        return vndf_fail(error, VNDF_ERROR_ARGUMENT, "the memory has %lu bytes, the file %lu", (unsigned long)size,
                         (unsigned long)needed);
    encode(what, bytes, size);
    return VNDF_OK;
}

void vndf_frame_begin(const vndf_frame *frame, vndf_writer *w, size_t size)
{
    vndf_write_bytes(w, frame->magic, MAGIC);
    vndf_write_u32(w, frame->version);
    vndf_write_u32(w, (uint32_t)size);
}

void vndf_frame_end(vndf_writer *w)
{
    vndf_write_u32(w, w->at <= w->capacity ? vndf_crc32(0, w->bytes, w->at) : 0);
}
