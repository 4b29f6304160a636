/* Densities, D, areas, Lambda, G1 and G2 are what the numbers of the file define, by the oracle, which reads its bytes,
 * in double; the density that comes with a sample is that of the normal returned (but of matrices, which may be so
 * flat that a normal's rounding leaves it no digits), and its weight the true density there over that: within 1e-5,
 * below the horizon 1e-4, for 99.9% of the points of each kind of surface, roughness 1e-4 to 1e4, also 1e4 apart,
 * matrices of condition up to 1e8, mean slopes, mixtures. Where inputs have no such digits - leaning surfaces, a mirror
 * - the values at inputs one rounding aside count. It notices a wrong formula, a wrong cell, and digits lost. */
#include "sampler/seen.h"

typedef enum family { ROUGH, APART, SHEARED, LEANING, MIXED, FAMILIES } family;
static const char *const family_names[FAMILIES] = {"roughness", "alphas apart", "matrix", "mean slope", "mixture"};

/* After the quantities of seen.h; -1 where there is no sample, or it has no weight. */
enum { WEIGHT = QUANTITIES, DRAWN, G2, ASKED }; /* G2: of wi and wo at the same place */

static const char *const more_names[] = {"weight", "density drawn", "g2"};

/* A point, and what the oracle knows of its lobes. */
typedef struct point {
    seen s;
    float weight, drawn;
    oracle_surface lobe[2];
    double wi[3], wm[3];
} point;

/* ---- points ---- */

static vndf_surface random_shape(const vndf_distribution *d, family f, unsigned long long *state)
{
    double a = random_decade(state, -4, 4), b = f == ROUGH ? a : a * random_decade(state, -4, 4);
    double p = random_between(state, -PI, PI), q = random_between(state, -PI, PI);
    if (f == SHEARED)
        a = random_decade(state, -4, 4), b = a * random_decade(state, -8, 0);
    if (f == LEANING || f == MIXED)
        a = random_decade(state, -2, 0), b = random_decade(state, -2, 0);
    vndf_surface m = f >= SHEARED ? oracle_turned(d, a, b, q, p) : vndf_rough(d, (float)a, (float)b);
    if (f == LEANING || f == MIXED)
        m.mean_x = (float)random_between(state, -1, 1), m.mean_y = (float)random_between(state, -1, 1);
    return m;
}

/* Half of the normals are samples, half of any slope; a third of the directions are chosen in the stretched frame. */
static point random_point(const oracle *of, const vndf_distribution *d, family f, unsigned long long *state)
{
    static const oracle second = {.shape = ORACLE_GGX, .norm = 1 / PI};
    vndf_mixture m = {f == MIXED ? 2 : 1,
                      {{random_shape(d, f, state), 0.25f}, {random_shape(vndf_ggx(), f, state), 0.5f}}};
    const vndf_surface *a = &m.lobe[0].surface;
    point p;
    float u1 = test_uniform(state), u2 = test_uniform(state);
    vndf_vec3 wi = random_direction(state, f == ROUGH ? -1 : -0.5);
    if (test_random_bits(state) % 3 == 0) {
        double rho = random_decade(state, -3, 3),
               z = (wi.z < 0 ? -1 : 1) * rho * (double)fmaxf(fabsf(a->xx), fabsf(a->yx));
        double length = sqrt((double)wi.x * wi.x + (double)wi.y * wi.y + z * z);
        wi.x = (float)(wi.x / length), wi.y = (float)(wi.y / length), wi.z = (float)(z / length);
    }
    p.s = seen_from(f == MIXED ? SEEN_MIXTURE : SEEN_SURFACE, &m, wi);
    vndf_vec3 wm = seen_draw(&p.s, u1, u2, &p.drawn);
    p.weight = -1;
    if (f == ROUGH)
        vndf_sample_weight(&p.s.view, u1, u2, NULL, &p.weight);
    if (f == SHEARED)
        p.drawn = -1;
    if (test_random_bits(state) % 2) {
        p.weight = p.drawn = -1;
        double r = random_decade(state, -3, 3), t = random_between(state, -PI, PI);
        double x = a->xx * r * cos(t) + a->xy * r * sin(t) - a->mean_x,
               y = a->yx * r * cos(t) + a->yy * r * sin(t) - a->mean_y;
        double z = 1 / sqrt(1 + x * x + y * y);
        const double steep[3] = {x * z, y * z, z};
        wm = vec3_of(steep);
    }
    p.lobe[0] = oracle_surface_from(of, a);
    p.lobe[1] = oracle_surface_from(&second, &m.lobe[1].surface);
    p.wi[0] = (double)wi.x, p.wi[1] = (double)wi.y, p.wi[2] = (double)wi.z;
    p.wm[0] = (double)wm.x, p.wm[1] = (double)wm.y, p.wm[2] = (double)wm.z;
    return p;
}

/* ---- both sides ---- */

static double ask(const point *p, int q)
{
    if (q == WEIGHT || q == DRAWN)
        return (double)(q == WEIGHT ? p->weight : p->drawn);
    if (q == G2 && p->s.kind == SEEN_SURFACE)
        return (double)vndf_g2(&p->s.of.lobe[0].surface, p->s.wi, p->s.wi, VNDF_G2_HEIGHT_CORRELATED);
    if (q == G2)
        return (double)vndf_mixture_g2(&p->s.of, p->s.wi, p->s.wi, VNDF_G2_HEIGHT_CORRELATED);
    return (double)seen_quantity(&p->s, (quantity)q, q < AREA ? vec3_of(p->wm) : p->s.wi);
}

/* A/cos and its reciprocal, cos being the projection of the mean plane. */
static double truth(const point *p, int q)
{
    if (q == WEIGHT)
        return truth(p, VISIBLE) / truth(p, DENSITY);
    if (q == DRAWN)
        return truth(p, DENSITY);
    double area = 0, cosine = 0, sum = 0;
    for (int i = 0; i < p->s.of.count; i++) {
        double weight = p->s.of.count == 2 ? (i + 1) / 3.0 : 1;
        double here =
            weight * (q == DENSITY ? oracle_surface_drawn_area : oracle_surface_area)(&p->lobe[i], p->wi);
        area += here;
        cosine += weight * oracle_look_from(&p->lobe[i], p->wi).c;
        sum += q == DENSITY   ? here * oracle_surface_drawn(&p->lobe[i], p->wi, p->wm)
               : q == VISIBLE ? here * oracle_surface_visible(&p->lobe[i], p->wi, p->wm)
               : q == NDF     ? weight * oracle_surface_ndf(&p->lobe[i], p->wm)
                              : 0;
    }
    switch (q) {
    case AREA: return area;
    case NDF: return sum;
    case LAMBDA: return area / cosine - 1;
    case G1: return cosine > 0 ? cosine / area : 0;
    case G2: return cosine > 0 ? cosine / (2 * area - cosine) : 0;
    default: return sum / area;
    }
}

/* Lobes that see next to nothing of what they see at grazing incidence have no digits, nor has P22 below 1e-30. */
static int is_deep(const point *p)
{
    double level[3] = {p->wi[0], p->wi[1], 0};
    for (int i = 0; i < p->s.of.count; i++)
        if (!(oracle_surface_area(&p->lobe[i], p->wi) > 1e-10 * oracle_surface_area(&p->lobe[i], level)))
            return 1;
    const oracle_surface *o = &p->lobe[0];
    return !(oracle_surface_ndf(o, p->wm) * fabs(o->xx * o->yy - o->xy * o->yx) * pow(p->wm[2], 4) > 1e-30);
}

/* |got - want|/|want|, of Lambda over at least 1, beyond what one rounding of the inputs moves, a tenth of it below the
 * horizon; -1 where nothing is promised. */
static double error_of(const point *p, int q)
{
    double want = truth(p, q), got = ask(p, q), low = want, high = want, size = fmax(fabs(want), q == LAMBDA);
    if (((q == WEIGHT || q == DRAWN) && got < 0) || !(size > 1e-30 && size < 1e30) ||
        (q == LAMBDA && size > 1e6) || is_deep(p))
        return -1;
    size *= oracle_look_from(&p->lobe[0], p->wi).c < 0 ? 10 : 1;
    if (fabs(got - want) <= 1e-5 * size)
        return fabs(got - want) / size;
    for (int i = 0; i < 12; i++) {
        point beside = *p;
        double *at = i < 6 ? &beside.wm[i / 2] : &beside.wi[i / 2 - 3];
        *at += (i % 2 ? 0x1p-23 : -0x1p-23) * fabs(*at);
        double value = truth(&beside, q);
        low = fmin(low, value), high = fmax(high, value);
    }
    low -= 2 * (want - low), high += 2 * (high - want);
    return got < low ? (low - got) / size : got > high ? (got - high) / size : got >= low ? 0 : HUGE_VAL;
}

static void test_family(const subject *of, const oracle *slopes, family f, size_t points)
{
    size_t checked[ASKED] = {0}, missed[ASKED] = {0};
    double worst[ASKED] = {0};
    point at[ASKED];
    unsigned long long state = 100 + (unsigned)f;
    for (size_t i = 0; i < points; i++) {
        point p = random_point(slopes, of->d, f, &state);
        for (int q = 0; q < ASKED; q++) {
            double error = error_of(&p, q);
            checked[q] += error >= 0;
            missed[q] += !(error <= 1e-5);
            if (!(error <= worst[q]))
                worst[q] = error, at[q] = p;
        }
    }
    for (int q = 0; q < ASKED; q++)
        if (!(TEST((double)missed[q] <= 1 + 1e-3 * (double)checked[q]) &
              TEST(worst[q] < (of->shape.rough ? HUGE_VAL : 1e-2))) ||
            test_long()) {
            fprintf(stderr, "  %s, %s, %s: %lu of %lu beyond 1e-5, most %.3g\n", of->name, family_names[f],
                    q < QUANTITIES ? quantity_names[q] : more_names[q - QUANTITIES], (unsigned long)missed[q],
                    (unsigned long)checked[q], worst[q]);
            if (worst[q] > 1e-5)
                seen_print(&at[q].s, "worst"),
                    fprintf(stderr, "    wm %.9g %.9g %.9g: got %.9g, want %.9g\n", at[q].wm[0], at[q].wm[1],
                            at[q].wm[2], ask(&at[q], q), truth(&at[q], q));
        }
}

static void test_subject(const subject *of, size_t index)
{
    oracle_table table = {.numbers = NULL};
    const oracle slopes = index < 2 ? of->shape : (oracle){.shape = ORACLE_COUNT, .table = &table};
    if (index < 2 || TEST(oracle_table_of(&table, of->d)))
        for (int f = 0; f < FAMILIES; f++)
            test_family(of, &slopes, (family)f, test_amount(1000, 5000, 30000));
    oracle_table_free(&table);
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
