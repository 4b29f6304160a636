#include "measured/brdf/merl.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "measured/brdf/power.h"
#include "measured/model.h"

enum { HALVES = 90, DIFFERENCES = 90, HALF_TURN = 180, HEAD = 12, AREAS = 541 };
/* Every n-th bin is compared with the model. */
enum { STEP_D = 3, STEP_PHI = 30, PROBES = HALVES * (DIFFERENCES / STEP_D) * (HALF_TURN / STEP_PHI) };

static const double pi = 3.14159265358979323846;
static const double scale[3] = {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
static const double luminance[3] = {0.2126, 0.7152, 0.0722};

/* ---- directions ---------------------------------------------------------------------------------- */

/* `place` of the way through its bin. */
static double half_angle(int bin, double place)
{
    double u = (bin + place) / HALVES;
    return pi / 2 * u * u;
}

/* wi and wo, on both sides of h at (theta_h, 0). */
static void directions_of(double theta_h, double theta_d, double phi_d, direction *wi, direction *wo)
{
    direction d = direction_at(theta_d, phi_d);
    double c = cos(theta_h), s = sin(theta_h);
    *wi = (direction){c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    *wo = direction_mirrored(*wi, (direction){s, 0, c});
}

/* f where F is 1: D / (4 (A_i cos_o + A_o cos_i - cos_i cos_o)), or D / (4 A_i A_o). */
static double masked_ndf(power_masking masking, double ndf, double area_i, double cos_i, double area_o,
                         double cos_o)
{
    if (masking == POWER_SEPARABLE)
        return ndf / (4 * area_i * area_o);
    return ndf / (4 * (area_i * cos_o + area_o * cos_i - cos_i * cos_o));
}

/* ---- in ------------------------------------------------------------------------------------------ */

typedef struct merl_file {
    const unsigned char *numbers;
    int azimuths; /* of phi_d */
    double place; /* of a number in its bin: 1/2 in the middle, 0 at the lower end */
    merl_channel channel;
} merl_file;

/* A place of the file beside the model there, with F = 1 - rise and F = rise. */
typedef struct probe {
    double found, weight, theta_h, rise, cos_i, cos_o;
} probe;

typedef struct search {
    power_bins bins;
    power_masking masking;
    double back[POWER_ANGLES]; /* f of light that goes back */
    double ndf[POWER_ANGLES], f0, low, high, residual;
    double area[AREAS]; /* over theta */
    probe *probes;      /* owned */
    size_t count;
} search;

static double double_at(const unsigned char *b)
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++)
        bits |= (uint64_t)b[i] << 8 * i;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static int int_at(const unsigned char *b)
{
    return (int)((uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0]);
}

/* Negative where there is no number. */
static double value_at(const merl_file *file, int half, int difference, int azimuth)
{
    size_t plane = (size_t)HALVES * DIFFERENCES * (size_t)file->azimuths;
    size_t at = ((size_t)half * DIFFERENCES + (size_t)difference) * (size_t)file->azimuths + (size_t)azimuth;
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double value = double_at(file->numbers + 8 * (at + (size_t)i * plane)) * scale[i];
        if (file->channel != MERL_LUMINANCE && file->channel != (merl_channel)i)
            continue;
        if (!(value >= 0) || !(value < 1e30))
            return -1;
        sum += (file->channel == MERL_LUMINANCE ? luminance[i] : 1) * value;
    }
    return sum;
}

/* The mean over azimuths at theta_d = 0, -1 where there is none. Returns at how many angles. */
static int read_back(const merl_file *file, search *s)
{
    int missing = 0;
    for (int half = 0; half < HALVES; half++) {
        double sum = 0, count = 0;
        for (int azimuth = 0; azimuth < file->azimuths; azimuth++) {
            double value = value_at(file, half, 0, azimuth);
            sum += value >= 0 ? value : 0;
            count += value >= 0;
        }
        missing += count == 0;
        s->back[half] = count > 0 ? sum / count : -1;
    }
    return missing;
}

/* Where both directions are within 80 degrees of z; the weight is the light's, cos_i cos_o over both directions. */
static void add_probe(search *s, const merl_file *file, int half, int difference, int azimuth)
{
    static const double least = 0.17364817766693; /* cos 80 degrees */
    double theta_h = half_angle(half, file->place), theta_d = (difference + file->place) / DIFFERENCES * pi / 2;
    direction wi, wo;
    directions_of(theta_h, theta_d, (azimuth + file->place) / file->azimuths * pi, &wi, &wo);
    double found = value_at(file, half, difference, azimuth);
    if (!(wi.z > least && wo.z > least) || !(found >= 0))
        return;
    double weight = wi.z * wo.z * s->bins.share[half] * sin(theta_d) * cos(theta_d);
    s->probes[s->count++] = (probe){found, weight, theta_h, model_schlick(cos(theta_d)), wi.z, wo.z};
}

static void read_probes(search *s, const merl_file *file)
{
    int step = STEP_PHI * file->azimuths / HALF_TURN;
    for (int half = 0; half < HALVES; half++)
        for (int difference = 1; difference < DIFFERENCES; difference += STEP_D)
            for (int azimuth = step / 2; azimuth < file->azimuths; azimuth += step)
                add_probe(s, file, half, difference, azimuth);
}

/* ---- the search ---------------------------------------------------------------------------------- */

static double area_of(const search *s, double cosine)
{
    double place = acos(fmin(cosine, 1)) / (pi / 2) * (AREAS - 1);
    int at = place < AREAS - 2 ? (int)place : AREAS - 2;
    return s->area[at] + (place - at) * (s->area[at + 1] - s->area[at]);
}

/* f of the model at a probe, F being 1. */
static double shape_at(const search *s, const probe *p)
{
    double ndf = power_ndf(&s->bins, s->ndf, p->theta_h);
    return masked_ndf(s->masking, ndf, area_of(s, p->cos_i), p->cos_i, area_of(s, p->cos_o), p->cos_o);
}

/* Least squares for the two ends of F over relative weights, so that the dim wide part counts as the bright peak. */
static void fit_fresnel(search *s, double diffuse)
{
    double aa = 0, ab = 0, bb = 0, fa = 0, fb = 0;
    for (size_t i = 0; i < s->count; i++) {
        const probe *p = &s->probes[i];
        double shape = shape_at(s, p), weight = p->weight / (shape * s->f0 + diffuse + 1e-30);
        double low = shape * (1 - p->rise), high = shape * p->rise, found = p->found - diffuse;
        aa += weight * low * low;
        ab += weight * low * high;
        bb += weight * high * high;
        fa += weight * found * low;
        fb += weight * found * high;
    }
    double det = aa * bb - ab * ab;
    s->low = det > 0 ? (fa * bb - fb * ab) / det : s->f0;
    s->high = det > 0 ? (fb * aa - fa * ab) / det : 1;
}

/* Half of |found - model| over found. */
static double residual_of(const search *s, double diffuse)
{
    double off = 0, whole = 0;
    for (size_t i = 0; i < s->count; i++) {
        const probe *p = &s->probes[i];
        double model = diffuse + shape_at(s, p) * (s->low * (1 - p->rise) + s->high * p->rise);
        off += p->weight * fabs(p->found - model) / 2;
        whole += p->weight * p->found;
    }
    return whole > 0 ? off / whole : 0;
}

/* D and F for one diffuse constant; the residual. */
static double try_diffuse(search *s, double diffuse)
{
    double f[POWER_ANGLES];
    for (int i = 0; i < s->bins.count; i++)
        f[i] = s->back[i] < 0 ? -1 : fmax(s->back[i] - diffuse, 0);
    if (!power_iterate(&s->bins, s->masking, f, s->ndf, &s->f0))
        return 1;
    for (int i = 0; i < AREAS; i++)
        s->area[i] = power_area(&s->bins, s->ndf, pi / 2 * i / (AREAS - 1));
    fit_fresnel(s, diffuse);
    return s->residual = residual_of(s, diffuse);
}

/* By the golden section, from 0 to the least light that comes back anywhere within 70 degrees; 0 if that is as good. */
static double find_diffuse(search *s)
{
    static const double golden = 0.6180339887498949;
    double low = 0, high = INFINITY;
    for (int i = 0; i < s->bins.count && s->bins.theta[i] < 70 * pi / 180; i++)
        high = s->back[i] < 0 ? high : fmin(high, s->back[i]);
    high = isfinite(high) ? high : 0;
    double most = high, a = high - golden * high, b = golden * high;
    double at_a = try_diffuse(s, a), at_b = try_diffuse(s, b);
    while (high - low > 1e-3 * most) {
        if (at_a <= at_b) {
            high = b;
            b = a;
            at_b = at_a;
            at_a = try_diffuse(s, a = high - golden * (high - low));
        } else {
            low = a;
            a = b;
            at_a = at_b;
            at_b = try_diffuse(s, b = low + golden * (high - low));
        }
    }
    double best = try_diffuse(s, (low + high) / 2);
    return try_diffuse(s, 0) <= 1.01 * best + 1e-5 ? 0 : (low + high) / 2;
}

/* ---- the whole ----------------------------------------------------------------------------------- */

static int open_file(merl_file *file, const char *name, const unsigned char *bytes, size_t size, refusal *why)
{
    int sides[3] = {0, 0, 0};
    if (size < HEAD)
        return refuse_data(why, name,
                           size == 0 ? "the file is empty"
                                     : "this is no MERL file: it ends within the head, three numbers of 4 bytes");
    for (int i = 0; i < 3; i++)
        sides[i] = int_at(bytes + 4 * i);
    if (sides[0] != HALVES || sides[1] != DIFFERENCES || (sides[2] != HALF_TURN && sides[2] != 2 * HALF_TURN))
        return refuse_data(why, name, "this is no MERL file: it begins with %d %d %d in the place of 90 90 180",
                           sides[0], sides[1], sides[2]);
    size_t want = HEAD + (size_t)HALVES * DIFFERENCES * (size_t)sides[2] * 3 * 8;
    if (size != want)
        return refuse_data(why, name, "a MERL file of 90 x 90 x %d has %zu bytes, and there are %zu", sides[2],
                           want, size);
    file->numbers = bytes + HEAD;
    file->azimuths = sides[2];
    return 1;
}

/* F0 of each channel by itself, with its own D; diffuse light counts in. */
static void note_channels(merl_file file, power_masking masking, notes *to)
{
    static const char *const names[3] = {"f0_red", "f0_green", "f0_blue"};
    search *s = calloc(1, sizeof *s);
    for (int i = 0; i < 3 && s; i++) {
        file.channel = (merl_channel)i;
        power_even(&s->bins, HALVES, file.place);
        read_back(&file, s);
        if (power_iterate(&s->bins, masking, s->back, s->ndf, &s->f0))
            note(to, "%s %.4g", names[i], s->f0);
    }
    free(s);
}

/* Reads what is compared; how many angles have no light that goes back. */
static int open_search(search *s, const merl_file *file)
{
    s->count = 0;
    power_even(&s->bins, HALVES, file->place);
    read_probes(s, file);
    return read_back(file, s);
}

/* Files that programs filled may have their numbers at the lower ends of bins, or be masked by the product of both
 * ways. They are taken so where that explains them with half of the error. */
static void find_convention(search *s, merl_file *file)
{
    static const double places[4] = {0.5, 0, 0.5, 0};
    static const power_masking maskings[4] = {POWER_CORRELATED, POWER_CORRELATED, POWER_SEPARABLE,
                                              POWER_SEPARABLE};
    double best = INFINITY;
    int chosen = 0;
    for (int i = 0; i < 4; i++) {
        file->place = places[i];
        s->masking = maskings[i];
        open_search(s, file);
        double residual = s->count > 0 ? fmin(try_diffuse(s, find_diffuse(s)), 1) : 1;
        chosen = residual < best / 2 ? i : chosen;
        best = chosen == i ? residual : best;
    }
    file->place = places[chosen];
    s->masking = maskings[chosen];
}

static int search_file(search *s, const merl_file *file, const char *name, notes *to, refusal *why)
{
    int missing = open_search(s, file);
    if (s->count == 0)
        return refuse_data(why, name, "no direction within 80 degrees has a value");
    double diffuse = find_diffuse(s);
    if (try_diffuse(s, diffuse) >= 1 || !(s->f0 > 0))
        return refuse_data(why, name,
                           "no light comes back to where it came from, or D explains nothing of the file");
    note(to, "bins %s", file->place > 0 ? "middle" : "lower end");
    note(to, "masking %s", s->masking == POWER_SEPARABLE ? "separable" : "correlated");
    note(to, "angles_without_light %d", missing);
    note(to, "diffuse %.4g", diffuse * pi);
    note(to, "f0 %.4g", s->low);
    note(to, "f90 %.4g", s->high);
    note(to, "residual_reflectance %.3g", s->residual);
    return 1;
}

int merl_read(profile *rows, const char *name, const unsigned char *bytes, size_t size, merl_channel channel,
              notes *to, refusal *why)
{
    merl_file file = {NULL, 0, 0.5, channel};
    *rows = (profile){VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, NULL, NULL, 0, NULL};
    if (!open_file(&file, name, bytes, size, why))
        return 0;
    search *s = calloc(1, sizeof *s);
    if (s)
        s->probes = malloc(PROBES * sizeof *s->probes);
    int good = s && s->probes && profile_make(rows, VNDF_ROWS_OVER_THETA, VNDF_ROWS_OF_NDF, HALVES);
    if (!good)
        refuse_data(why, name, "there is no memory for %d rows", HALVES);
    if (good)
        find_convention(s, &file);
    good = good && search_file(s, &file, name, to, why);
    for (int i = 0; i < HALVES && good; i++) {
        rows->x[i] = s->bins.theta[i];
        rows->value[i] = s->ndf[i];
    }
    if (good)
        note_channels(file, s->masking, to);
    else
        profile_free(rows);
    if (s)
        free(s->probes);
    free(s);
    return good;
}

/* ---- out ----------------------------------------------------------------------------------------- */

static void put(FILE *file, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        fputc((int)(value >> 8 * i & 255), file);
}

/* f with F = 1 at a bin; 0 where a direction is below the horizon. */
static double value_of(const vndf_surface *surface, double ndf, double theta_h, double theta_d, double phi_d)
{
    direction wi, wo;
    directions_of(theta_h, theta_d, phi_d, &wi, &wo);
    if (!(wi.z > 0) || !(wo.z > 0))
        return 0;
    return masked_ndf(POWER_CORRELATED, ndf, model_area(surface, wi), wi.z, model_area(surface, wo), wo.z);
}

static void fill(float *values, const vndf_surface *surface)
{
    for (int half = 0; half < HALVES; half++) {
        double theta_h = half_angle(half, 0.5), ndf = model_ndf(surface, theta_h);
        for (int i = 0; i < DIFFERENCES; i++)
            for (int k = 0; k < HALF_TURN; k++)
                *values++ = (float)value_of(surface, ndf, theta_h, (i + 0.5) / DIFFERENCES * pi / 2,
                                            (k + 0.5) / HALF_TURN * pi);
    }
}

int merl_write(FILE *file, const vndf_distribution *distribution, float alpha, const double f0[3])
{
    const vndf_surface surface = {distribution, alpha, alpha};
    const size_t count = (size_t)HALVES * DIFFERENCES * HALF_TURN;
    const int sides[3] = {HALVES, DIFFERENCES, HALF_TURN};
    float *values = malloc(count * sizeof *values);
    if (!values)
        return 0;
    fill(values, &surface);
    for (int i = 0; i < 3; i++)
        put(file, (uint64_t)sides[i], 4);
    for (int channel = 0; channel < 3; channel++)
        for (size_t i = 0; i < count; i++) {
            double rise = model_schlick(cos(((double)(i / HALF_TURN % DIFFERENCES) + 0.5) / DIFFERENCES * pi / 2));
            double value = (double)values[i] * (f0[channel] + (1 - f0[channel]) * rise) / scale[channel];
            uint64_t bits;
            memcpy(&bits, &value, sizeof bits);
            put(file, bits, 8);
        }
    free(values);
    return fflush(file) == 0 && !ferror(file);
}
