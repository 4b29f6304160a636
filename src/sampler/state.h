/* What a view holds in its numbers: the direction on the surface, and what its distribution makes of it. Kinds of
 * distributions are told apart in kernel/view.h and, of what a view holds, in view.c. */
#ifndef VNDF_SAMPLER_STATE_H
#define VNDF_SAMPLER_STATE_H

#include "kernel/one.h"

#include "kernel/beckmann.h"
#include "kernel/ggx.h"
#include "kernel/sample.h"

#if defined(__GNUC__)
#  define VNDF_MAY_ALIAS __attribute__((may_alias))
#else
#  define VNDF_MAY_ALIAS
#endif

/* Views hold it as floats, which may be copied as such. */
typedef struct VNDF_MAY_ALIAS vndf_state {
    frame f;
    union {
        table_view table;
        ggx_view ggx;
        beckmann_view beckmann;
    } of;
} vndf_state;

_Static_assert(sizeof(vndf_state) <= VNDF_VIEW_NUMBERS * sizeof(float), "VNDF_VIEW_NUMBERS is too small");

VNDF_INLINE const vndf_state *vndf_state_of(const vndf_view *view)
{
    return (const vndf_state *)(const void *)view->numbers;
}

/* A table is seen from below the horizon. */
VNDF_INLINE int vndf_is_below(const vndf_view *view)
{
    return view->distribution->kind == VNDF_KIND_TABLE && vndf_state_of(view)->f.uz < 0.0f;
}

/* ---- words of the text ---- */

typedef vndf_vec3 vec3;
#define vec3(x, y, z) vndf_vec3_from(x, y, z)

VNDF_INLINE vec3 vndf_vec3_from(float x, float y, float z)
{
    const vec3 v = {x, y, z};
    return v;
}

/* A vector to be passed or returned: x and y are so in one register, which gcc would read back from two stores. The
 * processor would wait until both are in the cache. */
VNDF_INLINE vndf_vec3 vndf_packed(vec3 w)
{
    vndf_vec3 v = w;
#if defined(VNDF_KERNEL_SSE2)
    _mm_storel_pi((__m64 *)(void *)&v, _mm_unpacklo_ps(lane(w.x), lane(w.y)));
#endif
    return v;
}

#endif
