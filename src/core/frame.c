#include "core/frame.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/cursor.h"
#include "core/error.h"
#include "core/replace_file.h"

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
    if (stated < 64 || stated > frame->most)
        return vndf_fail(error, VNDF_ERROR_TABLE, "the %s says that it has %u bytes; from 64 to %u are possible",
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

/* ---- saving ---- */

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
