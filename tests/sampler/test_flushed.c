/* What is promised of samples and densities holds where the caller has the processor flush denormals to zero and read
 * them as zero, as renderers do: for directions of length 1e-37 to 3e38, roughness from one end of its range to the
 * other, and numbers at their ends, by single calls and by batches of every instruction set, which give the same
 * bits. */
#include <float.h>

#include "sampler/seen.h"

#if defined(__SSE2__)
#  include <xmmintrin.h>

/* Bits of the control register: flush to zero, denormals are zero. */
static void set_flushing(int flushing)
{
    const unsigned both = 0x8040;
    _mm_setcsr(flushing ? _mm_getcsr() | both : _mm_getcsr() & ~both);
}

enum { COUNT = 4000 };

typedef struct inputs {
    float ax[COUNT], ay[COUNT], x[COUNT], y[COUNT], z[COUNT], u1[COUNT], u2[COUNT];
} inputs;

static float hard_uniform(unsigned long long *state)
{
    static const float ends[] = {0, 1, 1e-42f, 0x1p-24f, 1 - 0x1p-24f, 0.5f};
    unsigned long long i = test_random_bits(state) >> 61;
    return i < 6 ? ends[i] : test_uniform(state);
}

static void fill(inputs *in, double scale, unsigned long long *state)
{
    for (int i = 0; i < COUNT; i++) {
        int apart = i % 5 == 0; /* from one end of the range to the other */
        double length = i % 2 ? 1 : random_decade(state, -37, 38.4),
               z = i % 4 ? random_between(state, -1, 1) : random_decade(state, -40, 0);
        double phi = i % 3 ? random_between(state, -PI, PI) : PI / 2 * (i % 4), across = sqrt(1 - z * z);
        in->ax[i] = (float)(random_decade(state, apart ? -17.9 : -4, apart ? 17.9 : 1) / scale);
        in->ay[i] = (float)(random_decade(state, apart ? -17.9 : -4, apart ? 17.9 : 1) / scale);
        in->x[i] = (float)(length * across * cos(phi)), in->y[i] = (float)(length * across * sin(phi)),
        in->z[i] = (float)(length * z);
        in->u1[i] = hard_uniform(state), in->u2[i] = hard_uniform(state);
    }
}

static int is_number(float x)
{
    return x >= -FLT_MAX && x <= FLT_MAX;
}

/* wi as it counts: without what is flushed. */
static int faces(vndf_vec3 wi, vndf_vec3 wm)
{
    double size = fmax(fmax(fabs((double)wi.x), fabs((double)wi.y)), fabs((double)wi.z));
    return dot_of(wi, wm) >= -0x1p-23 * size;
}

static void test_one(const vndf_distribution *d, const inputs *in, int i, const float got[4])
{
    seen s = seen_surface(d, in->ax[i], in->ay[i], (vndf_vec3){in->x[i], in->y[i], in->z[i]});
    float pdf = -1, v1 = -1, v2 = -1;
    vndf_vec3 wm = seen_draw(&s, in->u1[i], in->u2[i], &pdf);
    vndf_invert(&s.view, wm, &v1, &v2);
    int good = TEST(wm.x == got[0] && wm.y == got[1] && wm.z == got[2] && pdf == got[3]);
    good &= TEST(fabs(length_of(wm) - 1) <= 4 * 0x1p-23 && wm.z >= 0 && v1 >= 0 && v1 <= 1 && v2 >= 0 && v2 <= 1);
    good &= TEST(pdf == 0 || (pdf >= FLT_MIN && pdf <= FLT_MAX && faces(s.wi, wm)));
    good &= TEST(is_number(seen_pdf(&s, wm)) && is_number(seen_visible(&s, wm)));
    good &= TEST(i % 2 == 0 || is_number(seen_area(&s, s.wi))); /* of a direction of length 1 */
    if (!good && test_failures < 20) {
        seen_print(&s, "flushed");
        fprintf(stderr, "    u %.9g %.9g: %.9g %.9g %.9g, density %.9g\n", (double)in->u1[i], (double)in->u2[i],
                (double)wm.x, (double)wm.y, (double)wm.z, (double)pdf);
    }
}

static void test_distribution(const vndf_distribution *d, double scale)
{
    static inputs in;
    static float x[COUNT], y[COUNT], z[COUNT], pdf[COUNT];
    unsigned long long state = 3;
    fill(&in, scale, &state);
    for (int flushing = 0; flushing < 2; flushing++)
        for (int limit = VNDF_INSTRUCTIONS_PORTABLE; limit <= VNDF_INSTRUCTIONS_AVX512; limit++) {
            const vndf_batch b = {d, COUNT, 0, (vndf_instructions)limit, in.ax, in.ay, in.x, in.y, in.z};
            set_flushing(flushing);
            vndf_sample_n(&b, in.u1, in.u2, (vndf_normals){x, y, z}, pdf);
            for (int i = 0; i < COUNT; i++)
                test_one(d, &in, i, (const float[4]){x[i], y[i], z[i], pdf[i]});
            set_flushing(0);
        }
}

int main(void)
{
    for (size_t i = 0; i < SUBJECT_COUNT; i += i < 2 ? 1 : 3) {
        subject s = subject_open(i);
        if (s.d)
            test_distribution(s.d, i < 2 ? 1 : vndf_distribution_info(s.d).scale);
        vndf_free(s.owned);
    }
    return test_done();
}

#else

int main(void)
{
    printf("SKIPPED: no way to flush denormals is known here\n");
    return 0;
}

#endif
