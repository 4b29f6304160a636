#include "commands/parts/render_against.h"

#include <math.h>

#include "cli/arguments.h"

int render_against_read(const char *command, const char *path, int width, int height, image *other)
{
    image_error error;
    if (!image_read_pfm(other, path, &error))
        return complain(command, "--against: %s", error.message), 0;
    if (other->width == width && other->height == height)
        return 1;
    complain(command, "--against: %s has %d x %d pixels, this picture has %d x %d", path, other->width,
             other->height, width, height);
    image_free(other);
    return 0;
}

void render_against_print(const film *f, const image *other, const char *path)
{
    double apart = 0, more = 0, light = 0;
    for (size_t i = 0; i < film_pixels(f); i++) {
        const double *sum = f->sum + 3 * i;
        double mine = (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / (double)f->samples;
        double its = luminance(other->rgb + 3 * i);
        apart += fabs(mine - its);
        more += mine - its;
        light += its;
    }
    printf("beside %s pixels differ by %.2f%% of its mean luminance, all light together by %+.2f%%\n", path,
           100 * apart / light, 100 * more / light);
}
