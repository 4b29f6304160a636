/* What a path is in: the bodies that it was refracted into and not out of, the innermost last. Light is absorbed
 * as the innermost does; out of it, it is in the one around it again. */
#ifndef TOOLS_RENDER_PATH_MEDIA_H
#define TOOLS_RENDER_PATH_MEDIA_H

#include "render/path/parts.h"

/* A body that is deeper inside than that is not noticed. */
enum { MEDIA_MAX = 4 };

typedef struct path_media {
    const path_material *around[MEDIA_MAX];
    unsigned count;
} path_media;

static inline void media_enter(path_media *media, const path_material *m)
{
    if (media->count < MEDIA_MAX)
        media->around[media->count++] = m;
}

/* Of bodies that overlap, the one that is left may not be the innermost. */
static inline void media_leave(path_media *media, const path_material *m)
{
    unsigned at = media->count;
    while (at > 0 && media->around[at - 1] != m)
        at--;
    if (at == 0)
        return;
    media->count--;
    for (at--; at < media->count; at++)
        media->around[at] = media->around[at + 1];
}

/* Over a distance in the innermost, out of `left` if that is not NULL. What goes on for ever has left all bodies,
 * whatever is noted here: of an open one, the way out may have been missed. */
static inline void media_absorb(const path_media *media, const path_material *left, float distance, float rgb[3])
{
    unsigned count = media->count;
    count -= count > 0 && media->around[count - 1] == left;
    if (count == 0 || !(distance < INFINITY) || !media->around[count - 1]->absorbs)
        return;
    for (int i = 0; i < 3; i++)
        rgb[i] *= expf(-media->around[count - 1]->is->absorb[i] * distance);
}

#endif
