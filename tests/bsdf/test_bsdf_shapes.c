/* f and density of surfaces with a matrix, with a mean slope and of several lobes are the published formulas, within
 * 3e-5: slopes s = M u + mean give D = P22(M^-1 (s - mean))/(|det M| cos^4), and A(w) is the length of w' times that of
 * the unit problem towards it, w' = (M^T w.xy, w.z - w.xy.mean); sums over lobes are those of D and A; with the mean
 * plane in the place of z = 0. For GGX, Beckmann and a table, matrices of condition up to 300 and either
 * determinant, mean slopes up to 2, 1 to 3 lobes, from both sides. Samples have the density of where they go and the
 * weight f cos over it, within 1e-5 each, and f is reciprocal within 1e-5. All of this is of directions within some
 * roundings of those that are given, which is as good as floats can be: a lobe is narrow, or a half vector short. */
#include <float.h>

#include "bsdf/bsdf_case.h"

enum { LOBES = 3 };

/* A surface, with what the formulas need. */
typedef struct subject {
    const oracle_ndf *ndf[LOBES];
    vndf_mixture mixture;
    vndf_description is;
} subject;

/* ---- formulas ---- */

static const double UNIT[2] = {1, 1};

static double length_of(const double w[3])
{
    return sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void stretch(const vndf_affine *a, const double w[3], double to[3])
{
    to[0] = (double)a->xx * w[0] + (double)a->yx * w[1];
    to[1] = (double)a->xy * w[0] + (double)a->yy * w[1];
    to[2] = w[2] - w[0] * (double)a->mean_x - w[1] * (double)a->mean_y;
}

static double determinant(const vndf_affine *a)
{
    return fabs((double)a->xx * a->yy - (double)a->xy * a->yx);
}

/* The normal with the slope M^-1 (s - mean), unit. */
static void unstretch(const vndf_affine *a, const double wm[3], double n[3])
{
    double per = 1 / ((double)a->xx * a->yy - (double)a->xy * a->yx);
    double x = -wm[0] - wm[2] * (double)a->mean_x, y = -wm[1] - wm[2] * (double)a->mean_y; /* slopes times wm.z */
    n[0] = -((double)a->yy * x - (double)a->xy * y) * per;
    n[1] = -((double)a->xx * y - (double)a->yx * x) * per;
    n[2] = wm[2];
    double length = length_of(n);
    for (int i = 0; i < 3; i++)
        n[i] /= length;
}

static double area_of(const subject *s, int i, const double w[3])
{
    double to[3];
    stretch(&s->mixture.lobe[i].surface, w, to);
    return oracle_ndf_area(s->ndf[i], UNIT, to) * length_of(to);
}

static double weight_of(const subject *s, int i)
{
    double sum = 0;
    for (int k = 0; k < s->mixture.count; k++)
        sum += (double)s->mixture.lobe[k].weight;
    return (double)s->mixture.lobe[i].weight / sum;
}

static double whole_area(const subject *s, const double w[3])
{
    double sum = 0;
    for (int i = 0; i < s->mixture.count; i++)
        sum += weight_of(s, i) * area_of(s, i, w);
    return sum;
}

static double whole_ndf(const subject *s, const double wm[3])
{
    double sum = 0;
    for (int i = 0; i < s->mixture.count; i++) {
        const vndf_affine *a = &s->mixture.lobe[i].surface;
        double n[3];
        unstretch(a, wm, n);
        sum += weight_of(s, i) * oracle_ndf_density(s->ndf[i], UNIT, n) * pow(n[2] / wm[2], 4) / determinant(a);
    }
    return sum;
}

/* The density with which the library draws wm: lobes by their areas, normals as their tables have them. */
static double whole_pdf(const subject *s, const double wi[3], const double wm[3])
{
    double sum = 0, whole = whole_area(s, wi);
    for (int i = 0; i < s->mixture.count; i++) {
        const vndf_affine *a = &s->mixture.lobe[i].surface;
        double n[3], to[3];
        unstretch(a, wm, n);
        stretch(a, wi, to);
        double length = length_of(to), share = weight_of(s, i) * area_of(s, i, wi) / whole;
        for (int k = 0; k < 3; k++)
            to[k] /= length;
        sum += !(share > 0)
                   ? 0
                   : share * oracle_ndf_visible(s->ndf[i], UNIT, to, n) * pow(n[2] / wm[2], 3) / determinant(a);
    }
    return sum;
}

static void mean_of(const subject *s, double mean[2])
{
    mean[0] = mean[1] = 0;
    for (int i = 0; i < s->mixture.count; i++) {
        mean[0] += weight_of(s, i) * (double)s->mixture.lobe[i].surface.mean_x;
        mean[1] += weight_of(s, i) * (double)s->mixture.lobe[i].surface.mean_y;
    }
}

/* w', and the cosine to the mean plane's normal. */
static double rise_of(const subject *s, const double w[3])
{
    double mean[2];
    mean_of(s, mean);
    return w[2] - w[0] * mean[0] - w[1] * mean[1];
}

static double normal_z(const subject *s)
{
    double mean[2];
    mean_of(s, mean);
    return 1 / sqrt(1 + mean[0] * mean[0] + mean[1] * mean[1]);
}

/* 1 + Lambda from the side that w is on. */
static double one_lambda(const subject *s, const double w[3])
{
    double rise = rise_of(s, w), turned[3] = {-w[0], -w[1], -w[2]};
    return whole_area(s, rise > 0 ? w : turned) / fabs(rise);
}

static double masking_of(const subject *s, const double wi[3], const double wo[3])
{
    double i = one_lambda(s, wi), o = one_lambda(s, wo);
    if (s->is.effects.masking == VNDF_MASKING_NONE)
        return 1;
    if (s->is.effects.masking == VNDF_MASKING_SEPARABLE)
        return 1 / (i * o);
    if ((rise_of(s, wi) > 0) == (rise_of(s, wo) > 0))
        return 1 / (i + o - 1);
    return exp(lgamma(i) + lgamma(o) - lgamma(i + o)); /* Beta */
}

typedef struct formula {
    double f, pdf;
} formula;

/* Of unit directions; wi above the mean plane, or all of space turned about. */
static formula formula_at(const subject *s, const double given_i[3], const double given_o[3])
{
    formula none = {0, 0};
    double side = rise_of(s, given_i) < 0 ? -1 : 1, eta = side > 0 ? (double)s->is.eta : 1 / (double)s->is.eta;
    double wi[3], wo[3], wm[3];
    for (int i = 0; i < 3; i++) {
        wi[i] = side * given_i[i];
        wo[i] = side * given_o[i];
    }
    int reflects = rise_of(s, wo) > 0, both = s->is.effects.lobes == VNDF_LOBES_BOTH;
    if (!both && !reflects)
        return none;
    for (int i = 0; i < 3; i++)
        wm[i] = wi[i] + (reflects ? 1 : eta) * wo[i];
    double length = length_of(wm), turn = wm[2] < 0 && !reflects ? -1 : 1;
    for (int i = 0; i < 3; i++)
        wm[i] *= turn / length;
    double facing = dot(wi, wm), beyond = reflects ? facing : -dot(wo, wm), sum = facing - eta * beyond;
    if (!(facing > 0) || !(beyond > 0) || !(wm[2] > 0))
        return none;
    double fresnel = s->is.effects.fresnel == VNDF_FRESNEL_DIELECTRIC
                         ? (double)oracle_fresnel((long double)fmin(facing, 1), (long double)eta, 0)
                         : 1;
    double jacobian = reflects ? 1 / (4 * facing) : eta * eta * beyond / (sum * sum);
    double carried = reflects || s->is.effects.transport == VNDF_TRANSPORT_IMPORTANCE ? 1 : 1 / (eta * eta);
    double part = reflects ? fresnel : 1 - fresnel;
    double shape = whole_ndf(s, wm) * masking_of(s, wi, wo) * facing * jacobian * carried;
    formula at = {part * shape / (rise_of(s, wi) * fabs(rise_of(s, wo)) * normal_z(s)),
                  (both ? part : 1) * whole_pdf(s, wi, wm) * jacobian};
    return at;
}

/* ---- subjects ---- */

static float around(float most, unsigned long long *state)
{
    return most * (2 * test_uniform(state) - 1);
}

/* R diag R of singular values from 0.01 to 3, mirrored half of the time. */
static void random_matrix(vndf_affine *a, unsigned long long *state)
{
    double x = exp(log(0.01) + log(300) * test_uniform_double(state)),
           y = exp(log(0.01) + log(300) * test_uniform_double(state));
    double p = 2 * PI * test_uniform_double(state), q = 2 * PI * test_uniform_double(state);
    double flip = test_uniform(state) < 0.5f ? -1 : 1;
    a->xx = (float)(cos(p) * x * cos(q) - sin(p) * y * flip * sin(q));
    a->xy = (float)(-cos(p) * x * sin(q) - sin(p) * y * flip * cos(q));
    a->yx = (float)(sin(p) * x * cos(q) + cos(p) * y * flip * sin(q));
    a->yy = (float)(-sin(p) * x * sin(q) + cos(p) * y * flip * cos(q));
}

static void random_subject(subject *s, const oracle_ndf *all, vndf_shape shape, unsigned long long *state)
{
    s->mixture.count = shape == VNDF_SHAPE_MIXTURE ? 1 + (int)(LOBES * test_uniform(state)) : 1;
    for (int i = 0; i < s->mixture.count; i++) {
        vndf_affine *a = &s->mixture.lobe[i].surface;
        s->ndf[i] = &all[(size_t)(3 * test_uniform(state))];
        *a = (vndf_affine){.distribution = s->ndf[i]->distribution};
        random_matrix(a, state);
        if (shape != VNDF_SHAPE_MATRIX && test_uniform(state) < 0.8f) {
            a->mean_x = around(1.4f, state);
            a->mean_y = around(1.4f, state);
        }
        s->mixture.lobe[i].weight = shape == VNDF_SHAPE_MIXTURE ? 0.05f + test_uniform(state) : 1;
    }
    s->is = (vndf_description){.distribution = s->ndf[0]->distribution, .effects = {.shape = shape}};
    s->is.affine = s->mixture.lobe[0].surface;
    s->is.mixture = &s->mixture;
    s->is.eta = bsdf_pick(bsdf_etas, BSDF_ETA_COUNT, state);
    s->is.wavelengths = 1;
    int both = test_uniform(state) < 0.6f;
    s->is.effects.lobes = both ? VNDF_LOBES_BOTH : VNDF_LOBES_REFLECTION;
    s->is.effects.fresnel = both ? VNDF_FRESNEL_DIELECTRIC : VNDF_FRESNEL_NONE;
    s->is.effects.transport = test_uniform(state) < 0.5f ? VNDF_TRANSPORT_RADIANCE : VNDF_TRANSPORT_IMPORTANCE;
    const vndf_masking maskings[] = {VNDF_MASKING_HEIGHT_CORRELATED, VNDF_MASKING_SEPARABLE, VNDF_MASKING_NONE};
    s->is.effects.masking = maskings[(size_t)(3 * test_uniform(state))];
}

/* ---- checks ---- */

/* Largest errors, and how many values were compared and were 0. */
typedef struct finding {
    double eval, pdf, weight, density, reciprocity;
    size_t positive, zero, lost;
} finding;

/* How far roundings of wi and wo may move a value: the lobe is narrow, or the half vector short. */
static double spread_of(const subject *s, const double wi[3], const double wo[3], formula at, double *pdf)
{
    double f = *pdf = 0;
    for (int i = 0; i < 6; i++) {
        double moved[2][3];
        memcpy(moved[0], wi, sizeof moved[0]);
        memcpy(moved[1], wo, sizeof moved[1]);
        moved[i / 3][i % 3] += 0x1p-22;
        formula other = formula_at(s, moved[0], moved[1]);
        f += fabs(other.f - at.f);
        *pdf += fabs(other.pdf - at.pdf);
    }
    return f;
}

/* Below 1e-10 a density may be what Beckmann's ends at: exp at its underflow, over wm.z^3. */
static double excess(double got, double want, double spread)
{
    if (want < 1e-10)
        return got > 1e-4 + spread;
    return fmax(fabs(got - want) - spread, 0) / want;
}

static int check_formula(const subject *s, const vndf_bsdf *bsdf, vndf_vec3 wi, vndf_vec3 wo, finding *found)
{
    double i[3], o[3], pdf_spread;
    float f, pdf;
    oracle_from_vec3(wi, i);
    oracle_from_vec3(wo, o);
    vndf_bsdf_eval_pdf(bsdf, wo, 0, &f, &pdf);
    formula want = formula_at(s, i, o);
    double f_spread = spread_of(s, i, o, want, &pdf_spread);
    *(want.f > 1e-20 ? &found->positive : &found->zero) += 1;
    if (want.f > 1e35 || want.pdf > 1e35 || fabs(i[2] + o[2]) < 1e-6) /* level facets divide 0 by 0 here */
        return 1;
    double f_error = excess((double)f, want.f, f_spread), pdf_error = excess((double)pdf, want.pdf, pdf_spread);
    found->eval = fmax(found->eval, f_error);
    found->pdf = fmax(found->pdf, pdf_error);
    if (TEST(f_error <= 3e-5) &
        TEST(pdf_error <= 1e-4)) /* matrices of a condition up to 300 are inverted in float */
        return 1;
    fprintf(stderr, "  eval %.9g want %.9g +- %.2g; pdf %.9g want %.9g +- %.2g\n", (double)f, want.f, f_spread,
            (double)pdf, want.pdf, pdf_spread);
    return 0;
}

static int check_sample(const subject *s, const vndf_bsdf *bsdf, vndf_vec3 wi, const vndf_scattered *drawn,
                        finding *found)
{
    float f, pdf, cosine = vndf_bsdf_cosine(bsdf, drawn->wo);
    double wm[3], i[3], o[3], spread;
    oracle_from_vec3(wi, i);
    oracle_from_vec3(drawn->wo, o);
    oracle_from_vec3(drawn->wm, wm);
    vndf_bsdf_eval_pdf(bsdf, drawn->wo, 0, &f, &pdf);
    spread_of(s, i, o, formula_at(s, i, o), &spread);
    double want = (double)f * fabs((double)cosine) / (double)pdf;
    double weight =
        fmax(fabs((double)drawn->weight[0] - want) - want * spread / (double)pdf, 0) / fmax(want, 1e-3);
    double density = excess((double)pdf, (double)drawn->density, spread);
    int reflected = rise_of(s, i) * rise_of(s, o) > 0;
    if (!(drawn->density < 1e35f) || !(drawn->density > 1e-25f) || !(f < 1e35f))
        return 1;
    found->weight = fmax(found->weight, weight);
    found->density = fmax(found->density, density);
    return TEST(weight <= 1e-5) & TEST(density <= 1e-5) & TEST(dot(wm, i) > 0) &
           TEST(drawn->lobe == (reflected ? VNDF_LOBE_REFLECTION : VNDF_LOBE_TRANSMISSION)) &
           TEST_NEAR((double)cosine, rise_of(s, o) * normal_z(s), 1e-6);
}

/* f(wi, wo) over the square of the index on the side that radiance comes from. */
static void check_reciprocity(const subject *s, const vndf_material *m, vndf_vec3 wi, vndf_vec3 wo, finding *found)
{
    vndf_bsdf there, back;
    float f, g;
    double i[3], o[3], spread;
    oracle_from_vec3(wi, i);
    oracle_from_vec3(wo, o);
    if (s->is.effects.masking == VNDF_MASKING_NONE || !vndf_bsdf_at(&there, m, wi) || !vndf_bsdf_at(&back, m, wo))
        return;
    vndf_bsdf_eval(&there, wo, 0, &f);
    vndf_bsdf_eval(&back, wi, 0, &g);
    formula at = formula_at(s, i, o);
    double index_i = rise_of(s, i) > 0 ? 1 : (double)s->is.eta,
           index_o = rise_of(s, o) > 0 ? 1 : (double)s->is.eta;
    double to = s->is.effects.transport == VNDF_TRANSPORT_RADIANCE ? index_i : index_o;
    double from = s->is.effects.transport == VNDF_TRANSPORT_RADIANCE ? index_o : index_i;
    double a = (double)f / (to * to), b = (double)g / (from * from), unused;
    if (!(a > 1e-20) || !(a < 1e30))
        return;
    spread = 4 * spread_of(s, i, o, at, &unused) / fmax(at.f, 1e-30);
    double error = fmax(fabs(a / b - 1) - spread, 0);
    found->reciprocity = fmax(found->reciprocity, error);
    TEST(error <= 1e-5);
}

static void test_subject(const subject *s, unsigned long long *state, finding *found)
{
    vndf_material material;
    vndf_bsdf bsdf;
    vndf_scattered drawn;
    vndf_vec3 wi = bsdf_direction(state), other = bsdf_direction(state);
    double i[3];
    float u[3];
    bsdf_numbers(state, u);
    TEST(vndf_material_resolve(&s->is, &material, NULL) == VNDF_OK);
    oracle_from_vec3(wi, i);
    double rise = rise_of(s, i);
    if (fabs(rise) < 1e-5) /* along the mean plane: rounding decides */
        return;
    int two_sided = oracle_bsdf_two_sided(&s->is.effects);
    if (!TEST(vndf_bsdf_at(&bsdf, &material, wi) == (two_sided || rise > 0)) || (!two_sided && rise < 0))
        return;
    vndf_bsdf_sample(&bsdf, u, &drawn);
    int good = check_formula(s, &bsdf, wi, other, found);
    if (drawn.lobe != VNDF_LOBE_NONE) {
        good &= check_formula(s, &bsdf, wi, drawn.wo, found) & check_sample(s, &bsdf, wi, &drawn, found);
        check_reciprocity(s, &material, wi, drawn.wo, found);
    } else
        found->lost++;
    if (!good)
        bsdf_describe(&s->is, s->ndf[0]->name, wi, drawn.wo);
}

int main(void)
{
    static const char *const names[3] = {"ggx", "beckmann", "student-t-2.5"};
    static const vndf_shape shapes[3] = {VNDF_SHAPE_MATRIX, VNDF_SHAPE_AFFINE, VNDF_SHAPE_MIXTURE};
    oracle_ndf all[3];
    for (size_t i = 0; i < 3; i++)
        if (!TEST(oracle_ndf_open(&all[i], names[i])))
            return test_done();
    for (int k = 0; k < 3; k++) {
        unsigned long long state = 77 + (unsigned long long)k;
        finding found = {0};
        for (size_t n = 0; n < test_amount(3000, 20000, 20000); n++) {
            subject s;
            random_subject(&s, all, shapes[k], &state);
            test_subject(&s, &state, &found);
        }
        printf(
            "shape %d: eval within %.2g, pdf %.2g, weight %.2g, density %.2g, reciprocity %.2g; %lu above 0, %lu "
            "at 0, %lu lost\n",
            (int)shapes[k], found.eval, found.pdf, found.weight, found.density, found.reciprocity,
            (unsigned long)found.positive, (unsigned long)found.zero, (unsigned long)found.lost);
        TEST(found.positive > found.zero / 2 && found.zero > 0);
    }
    for (size_t i = 0; i < 3; i++)
        oracle_ndf_close(&all[i]);
    return test_done();
}
