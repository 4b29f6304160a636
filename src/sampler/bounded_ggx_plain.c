/* Bounded visible normals of GGX where all is of plain size and nothing cancels: bounded_ggx.c in float.
 *
 * With (e1, e12; e12, e2) the matrix R^T A^2 R of the level directions and u' = N u for (X, Y) = N (cos psi, sin
 * psi),
 *
 *     |M0|^2 = s^2 e1 + c^2,     |M1|^2 N^2 = X^2 (c^2 e1 + s^2) - 2 c X Y e12 + Y^2 e2,
 *     (c M0.M1 - s cos psi) N = -s (s^2 + c^2 e1) X + c s e12 Y,
 *
 * so the root of the chord, t/N = above/below, takes no vectors. N = 1 in front; in the wedge (X, Y) = (-c cos v,
 * sin v) and N^2 is the largest sin(g)^2. Either way kept is (t/N)^2/(1 + t^2), times the factor of the side, and
 * sin(g)^2/N^2 is u2 times that. */
#include "math/half_turn.h"
#include "math/vector.h"
#include "sampler/bounded_ggx.h"

/* A direction whose w is in the disc. */
typedef struct outlook {
    float s, c, e1, e12, e2;
    float b1, b2, c0; /* half the linear term, per X and Y; the constant term, below 0 */
} outlook;

static outlook outlook_of(const vndf_view *v)
{
    float a2 = v->ax * v->ax, b2 = v->ay * v->ay, x = v->cos_phi, y = v->sin_phi, s = v->s, c = v->c;
    outlook o = {s, c, a2 * x * x + b2 * y * y, (b2 - a2) * x * y, a2 * y * y + b2 * x * x, 0.0f, 0.0f, 0.0f};
    float s2 = s * s, c2 = c * c;
    o.b1 = -s * (s2 + c2 * o.e1);
    o.b2 = c * s * o.e12;
    o.c0 = c * (s2 * o.e1 + c2 - 2.0f);
    return o;
}

/* Away from where w leaves the disc. */
static int is_plain(const vndf_view *view, const outlook *o)
{
    return view->plain && o->c0 < -0.1f * o->c;
}

/* ---- the law of psi ---- */

/* The front counts as if all were kept there, which is nearly so; of the wedge the larger kept of its middle and
 * of the sides: fractions n/d with (M1, N) (c^2 e1 + s^2, c) c^2 and (e2, 1). The quotients do not wait for each
 * other. */
void vndf_bounds_ggx(const vndf_view *view, double bounds[VNDF_BOUNDS])
{
    outlook o = outlook_of(view);
    if (!is_plain(view, &o)) {
        vndf_bounds_ggx_carefully(view, bounds);
        return;
    }
    float c = o.c, c2 = c * c, b = -c * o.b1, away = b + sqrtf(b * b - c * c2 * (c2 * o.e1 + o.s * o.s) * o.c0);
    float middle = o.c0 * o.c0, below = away * away + c2 * middle;
    float beside = fabsf(o.b2) + sqrtf(o.b2 * o.b2 - c * o.e2 * o.c0), side = beside * beside;
    float below_side = c2 * (o.e2 * o.e2) + side;
    int sides = middle * below_side < side * below;
    float n = sides ? side : middle, d = sides ? below_side : below, all = d + c * n, one = 1.0f + c;
    bounds[VNDF_GGX_FRONT] = d / all;
    bounds[VNDF_GGX_IN_FRONT] = all / (d * one);
    bounds[VNDF_GGX_IN_WEDGE] = all / (n * one);
    bounds[VNDF_GGX_RATE] = 0.5f * all / (c * n);
    bounds[VNDF_GGX_BEGIN] = 0.0;
    bounds[VNDF_GGX_SPAN] = 1.0;
}

/* ---- drawing ---- */

/* (X, Y) of a sample, N^2, and the factor of its side. */
typedef struct azimuth {
    float x, y, n2, factor;
} azimuth;

static azimuth draw_azimuth(const outlook *o, const double bounds[VNDF_BOUNDS], float half)
{
    float front = (float)bounds[VNDF_GGX_FRONT], in_front = (float)bounds[VNDF_GGX_IN_FRONT];
    float in_wedge = (float)bounds[VNDF_GGX_IN_WEDGE], rate = (float)bounds[VNDF_GGX_RATE], part = fabsf(half);
    int ahead = part < front; /* 1/front = factor (1 + c) */
    float turned = ahead ? part * (in_front * (0.5f + 0.5f * o->c)) : (part - front) * rate;
    vndf_turn turn = vndf_half_turn(turned < 0.5f ? turned : 0.5f);
    float x = ahead ? turn.cosine : -o->c * turn.sine, y = ahead ? turn.sine : turn.cosine;
    azimuth a = {x, copysignf(y, half), ahead ? 1.0f : x * x + y * y, ahead ? in_front : in_wedge};
    return a;
}

/* The root of the chord and what sin(g)^2/N^2 and cos(g)^2 are at u2. */
typedef struct chord {
    float square, root, kept, sine2, cosine2, rest; /* |M1|^2 N^2; 1 - sin(g)^2 at the end */
} chord;

static chord draw_chord(const outlook *o, const azimuth *at, float u2)
{
    float x = at->x, y = at->y, s = o->s, c = o->c;
    float square = x * x * (c * c * o->e1 + s * s) - 2.0f * c * (x * y) * o->e12 + y * y * o->e2;
    float a = c * square, b = o->b1 * x + o->b2 * y, root = sqrtf(b * b - a * o->c0);
    float above = b > 0.0f ? -o->c0 : root - b, below = b > 0.0f ? root + b : a;
    float above2 = above * above, below2 = below * below, all = at->n2 * above2, per = 1.0f / (below2 + all);
    float kept = above2 * per;
    chord h = {square, root, kept, u2 * kept, (below2 + (1.0f - u2) * all) * per, below2 * per};
    return h;
}

/* Whether the density is that of the normal as it is rounded. That turns psi by some 1e-7/sin(g), and d log(t)/d
 * psi is below (2 root E/|M1| + c E |M0| + s)/root, E^2 = e1 + e2, which bears on kept by twice cos(g)^2 at the
 * end; the matrix may hide what is small in E. That bound is far above what is measured: at 150 the density is
 * within 4e-6. In front and in the wedge kept differs. */
static int is_settled(const outlook *o, const azimuth *at, const chord *h, float sine)
{
    float n = sqrtf(at->n2), e2 = o->e1 + o->e2, gain = o->c * (0.7f + 0.7f * e2) + o->s;
    float change = h->rest * (2.0f * h->root * (h->square + at->n2 * e2) + gain * h->square * n);
    int calm = change < 150.0f * (sine * n) * h->root * h->square && 1e-6f < fabsf(at->x) * sine;
    return calm && 0.01f < sine * n && at->n2 * e2 < 100.0f * h->square;
}

vndf_bounded vndf_bounded_ggx(const vndf_view *view, const double bounds[VNDF_BOUNDS], float u1, float u2)
{
    outlook o = outlook_of(view);
    if (!is_plain(view, &o))
        return vndf_bounded_ggx_carefully(view, bounds, u1, u2);
    azimuth at = draw_azimuth(&o, bounds, 2.0f * u1 - 1.0f);
    chord h = draw_chord(&o, &at, u2);
    float sine = sqrtf(h.sine2), cosine = sqrtf(h.cosine2);
    float x = cosine * o.s - sine * (o.c * at.x), y = sine * at.y, z = cosine * o.c + sine * (o.s * at.x);
    float mx = view->ax * (view->cos_phi * x - view->sin_phi * y);
    float my = view->ay * (view->sin_phi * x + view->cos_phi * y);
    float length2 = mx * mx + my * my + z * z, length = sqrtf(length2), per = 1.0f / length;
    int inside = 1.00001f * (o.c * length2) < 2.0f * cosine * z && 0.02f * o.c * cosine < z && 0.03f < cosine;
    if (!inside || !is_settled(&o, &at, &h, sine))
        return vndf_bounded_ggx_carefully(view, bounds, u1, u2);
    float kept = h.kept * at.factor, density = length2 * length * cosine / (3.14159265f * view->spread * kept);
    vndf_bounded b = {vndf_vec3_of(mx * per, my * per, z * per), density, kept};
    return b;
}
