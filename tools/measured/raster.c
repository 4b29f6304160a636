#include "measured/raster.h"

#include <stdlib.h>
#include <string.h>

#include "measured/surface.h"
#include "render/image.h"

static int read_pfm(data_file *file, raster *made)
{
    image picture;
    image_error error = {""};
    if (!image_read_pfm_bytes(&picture, file->name, file->bytes, file->size, &error)) {
        memcpy(file->refused, error.message, sizeof file->refused);
        return 0;
    }
    *made = (raster){picture.width, picture.height, file->bytes[1] == 'F' ? 3 : 1, 3, 0, picture.rgb};
    if ((size_t)made->width * (size_t)made->height <= SURFACE_MAX)
        return 1;
    free(made->value);
    return refuse(file, "%d x %d pixels are more than %d", made->width, made->height, SURFACE_MAX);
}

/* A whole number from 1 to `most` in the head of an image; 0 where there is none. */
static int read_side(scan *head, int most)
{
    char word[WORD_MAX];
    double value;
    int is_number = scan_word_anywhere(head, word) && word_number(word, &value);
    return is_number && value >= 1 && value <= most && value == (int)value ? (int)value : 0;
}

static int read_grey(data_file *file, raster *made)
{
    scan head = scan_from(file, ' ');
    head.at = 2;
    *made = (raster){read_side(&head, SURFACE_SIDE_MAX), read_side(&head, SURFACE_SIDE_MAX), 0, 0, 0, NULL};
    int most = read_side(&head, 65535);
    if (made->width == 0 || made->height == 0 || most == 0 || head.at == file->size)
        return refuse(
            file,
            "the head of the image is not whole: width and height up to %d, the largest value up to 65535, "
            "and a blank",
            SURFACE_SIDE_MAX);
    if ((size_t)made->width * (size_t)made->height > SURFACE_MAX)
        return refuse(file, "%d x %d pixels are more than %d", made->width, made->height, SURFACE_MAX);
    made->channels = file->bytes[1] == '6' ? 3 : 1;
    made->stride = (size_t)made->channels;
    made->quantum = 1.0 / most;
    size_t count = (size_t)made->width * (size_t)made->height * made->stride, each = most > 255 ? 2 : 1;
    const unsigned char *b = file->bytes + head.at + 1;
    if (file->size - head.at - 1 != count * each)
        return refuse(file, "%d x %d pixels take %zu bytes after the head, and there are %zu", made->width,
                      made->height, count * each, file->size - head.at - 1);
    made->value = malloc(count * sizeof *made->value);
    if (!made->value)
        return refuse(file, "there is no memory for %zu numbers", count);
    for (size_t i = 0; i < count; i++)
        made->value[i] = (float)((each == 2 ? b[2 * i] << 8 | b[2 * i + 1] : b[i]) * made->quantum);
    return 1;
}

int raster_read(data_file *file, raster *made)
{
    const unsigned char *b = file->bytes;
    *made = (raster){0};
    if (file->size >= 2 && b[0] == 'P' && (b[1] == 'F' || b[1] == 'f'))
        return read_pfm(file, made);
    if (file->size < 2 || b[0] != 'P' || (b[1] != '5' && b[1] != '6'))
        return refuse(file, "of PGM and PPM the binary ones are read, which begin with P5 or P6");
    return read_grey(file, made);
}
