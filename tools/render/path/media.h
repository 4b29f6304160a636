/* The bodies that hold a path: refraction led into them and not out again, the innermost last. The innermost body
 * absorbs light; behind its surface the body around it does again. */
#ifndef TOOLS_RENDER_PATH_MEDIA_H
#define TOOLS_RENDER_PATH_MEDIA_H

#include "render/path/parts.h"

/* A body deeper inside than this is ignored. */
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

/* Bodies may overlap, so the path may leave one that is not the innermost. */
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

/* Absorbs over a distance in the innermost body, or, if `left` is not NULL, in the body that remains without it. A
 * path that goes on for ever has left all bodies, even if the list still holds one: an open body has no surface on
 * the way out. */
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
