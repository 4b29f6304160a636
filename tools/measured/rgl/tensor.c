#include "measured/rgl/tensor.h"

#include <string.h>

static const unsigned char head[14] = "tensor_file\0\1\0";

/* Bytes of a number of each type: u8 i8 u16 i16 u32 i32 u64 i64 f16 f32 f64. */
static const unsigned char sizes[12] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};

/* ---- reading ------------------------------------------------------------------------------------- */

typedef struct cursor {
    const unsigned char *bytes;
    size_t size, at;
    int is_short; /* something was read past the end */
} cursor;

static uint64_t number(cursor *c, size_t bytes)
{
    uint64_t value = 0;
    c->is_short |= c->size - c->at < bytes;
    for (size_t i = 0; i < bytes && !c->is_short; i++)
        value |= (uint64_t)c->bytes[c->at + i] << 8 * i;
    c->at += c->is_short ? 0 : bytes;
    return value;
}

static void read_name(cursor *c, tensor_field *field)
{
    size_t length = (size_t)number(c, 2);
    c->is_short |= c->size - c->at < length;
    for (size_t i = 0; i < length && !c->is_short; i++)
        if (i < TENSOR_NAME - 1) {
            unsigned char byte = c->bytes[c->at + i];
            field->name[i] = byte > ' ' && byte <= '~' ? (char)byte : '?';
        }
    c->at += c->is_short ? 0 : length;
}

/* Its shape and numbers. */
static int read_data(cursor *c, tensor_field *field, const char *name, refusal *why)
{
    size_t most = c->size;
    uint64_t dimensions = number(c, 2), type = number(c, 1), begin = number(c, 8);
    if (dimensions > TENSOR_DIMENSIONS || type == 0 || type >= sizeof sizes)
        return refuse_data(why, name,
                           "field '%s' has %d dimensions and the type %d; up to %d and 1 to 11 are possible",
                           field->name, (int)dimensions, (int)type, TENSOR_DIMENSIONS);
    field->dimensions = (int)dimensions;
    field->type = (int)type;
    field->count = 1;
    for (int i = 0; i < field->dimensions; i++) {
        uint64_t length = number(c, 8);
        if (length > most / (field->count ? field->count : 1))
            return refuse_data(why, name, "field '%s' is larger than the file", field->name);
        field->shape[i] = (size_t)length;
        field->count *= (size_t)length;
    }
    if (begin > most || (most - begin) / sizes[type] < field->count)
        return refuse_data(why, name, "the numbers of field '%s' do not end before the file: it is cut off",
                           field->name);
    field->data = c->bytes + begin;
    return 1;
}

int tensor_read(tensor_file *made, const char *name, const unsigned char *bytes, size_t size, refusal *why)
{
    cursor c = {bytes, size, sizeof head, 0};
    memset(made, 0, sizeof *made);
    if (size == 0 || memcmp(bytes, head, size < 12 ? size : 12) != 0)
        return refuse_data(why, name, "this is no tensor file; it would begin with tensor_file");
    if (size < sizeof head + 4)
        return refuse_data(why, name, "this tensor file ends too early: it has %zu bytes, and its head takes %zu",
                           size, sizeof head + 4);
    if (memcmp(bytes, head, sizeof head) != 0)
        return refuse_data(why, name, "a tensor file of version %d.%d; 1.0 is read", bytes[12], bytes[13]);
    uint64_t count = number(&c, 4);
    if (count > TENSOR_FIELDS)
        return refuse_data(why, name, "%lu fields; %d are the most", (unsigned long)count, TENSOR_FIELDS);
    for (; made->count < count; made->count++) {
        tensor_field *field = &made->field[made->count];
        read_name(&c, field);
        if (!c.is_short && !read_data(&c, field, name, why))
            return 0;
        if (c.is_short)
            return refuse_data(why, name, "the list of fields is cut off at field %zu of %lu", made->count + 1,
                               (unsigned long)count);
    }
    return 1;
}

const tensor_field *tensor_find(const tensor_file *file, const char *field)
{
    for (size_t i = 0; i < file->count; i++)
        if (strcmp(file->field[i].name, field) == 0)
            return &file->field[i];
    return NULL;
}

const tensor_field *tensor_floats(const tensor_file *file, const char *field, int dimensions, const char *name,
                                  refusal *why)
{
    const tensor_field *found = tensor_find(file, field);
    if (found && found->type == TENSOR_F32 && found->dimensions == dimensions)
        return found;
    if (!found)
        refuse_data(why, name, "it has no field '%s'", field);
    else
        refuse_data(why, name, "field '%s' has the type %d and %d dimensions; floats (10) and %d are needed",
                    field, found->type, found->dimensions, dimensions);
    return NULL;
}

double tensor_at(const tensor_field *field, size_t i)
{
    const unsigned char *b = field->data + 4 * i;
    uint32_t bits = (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* ---- writing ------------------------------------------------------------------------------------- */

static void put(FILE *file, uint64_t value, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        fputc((int)(value >> 8 * i & 255), file);
}

static size_t count_of(const tensor_written *field)
{
    size_t count = 1;
    for (int i = 0; i < field->dimensions; i++)
        count *= field->shape[i];
    return count;
}

static size_t bytes_of_data(const tensor_written *field)
{
    return count_of(field) * sizes[field->type];
}

/* Where the next numbers may begin: floats at multiples of 8, for hosts that map files. */
static uint64_t aligned(uint64_t at)
{
    return (at + 7) / 8 * 8;
}

static void put_data(FILE *file, const tensor_written *field)
{
    const float *number_of = field->data;
    for (size_t i = 0; i < count_of(field); i++) {
        uint32_t bits;
        if (field->type == TENSOR_U8) {
            fputc(((const unsigned char *)field->data)[i], file);
            continue;
        }
        memcpy(&bits, &number_of[i], sizeof bits);
        put(file, bits, 4);
    }
}

int tensor_write(FILE *file, const tensor_written *fields, size_t count)
{
    uint64_t at = sizeof head + 4, end;
    for (size_t i = 0; i < count; i++)
        at += 2 + strlen(fields[i].name) + 2 + 1 + 8 + 8 * (uint64_t)fields[i].dimensions;
    uint64_t begin = aligned(at);
    fwrite(head, 1, sizeof head, file);
    put(file, count, 4);
    for (size_t i = 0; i < count; i++) {
        put(file, strlen(fields[i].name), 2);
        fputs(fields[i].name, file);
        put(file, (uint64_t)fields[i].dimensions, 2);
        put(file, (uint64_t)fields[i].type, 1);
        put(file, begin, 8);
        for (int d = 0; d < fields[i].dimensions; d++)
            put(file, fields[i].shape[d], 8);
        begin = aligned(begin + bytes_of_data(&fields[i]));
    }
    for (size_t i = 0; i < count; i++) {
        put(file, 0, (size_t)(aligned(at) - at));
        put_data(file, &fields[i]);
        end = aligned(at) + bytes_of_data(&fields[i]);
        at = end;
    }
    return fflush(file) == 0 && !ferror(file);
}
