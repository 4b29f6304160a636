/* What is promised of samples and densities holds where the caller has the processor flush denormals to zero and read
 * them as zero, as renderers do: all that test_stress asks, by single calls; and batches of every instruction set give
 * the same bits, for directions of length 1e-37 to 3e38, roughness from one end of its range to the other, and numbers
 * at their ends. */
#include "evidence/measure/stress.h"
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

static float hard_uniform(unsigned long long *state)
{
    static const float ends[] = {0, 1, 1e-42f, 0x1p-24f, 1 - 0x1p-24f, 0.5f};
    unsigned long long i = test_random_bits(state) >> 61;
    return i < 6 ? ends[i] : test_uniform(state);
}

static void test_batches(const vndf_distribution *d)
{
    static float in[7][COUNT], x[COUNT], y[COUNT], z[COUNT], pdf[COUNT];
    unsigned long long state = 3;
    for (int i = 0; i < COUNT; i++) {
        double length = i % 2 ? 1 : random_decade(&state, -37, 38.4), reach = i % 5 ? 4 : 17.9;
        vndf_vec3 wi = random_direction(&state, -1);
        in[0][i] = (float)random_decade(&state, -reach, reach);
        in[1][i] = (float)random_decade(&state, -reach, reach);
        in[2][i] = (float)(length * (double)wi.x);
        in[3][i] = (float)(length * (double)wi.y);
        in[4][i] = (float)(length * (i % 4 ? (double)wi.z : random_decade(&state, -40, 0)));
        in[5][i] = hard_uniform(&state);
        in[6][i] = hard_uniform(&state);
    }
    set_flushing(1);
    for (int limit = VNDF_INSTRUCTIONS_PORTABLE; limit <= VNDF_INSTRUCTIONS_AVX512; limit++) {
        const vndf_batch b = {d, COUNT, 0, (vndf_instructions)limit, in[0], in[1], in[2], in[3], in[4]};
        vndf_sample_n(&b, in[5], in[6], (vndf_normals){x, y, z}, pdf);
        for (int i = 0; i < COUNT; i++) {
            seen s = seen_surface(d, in[0][i], in[1][i], (vndf_vec3){in[2][i], in[3][i], in[4][i]});
            float alone = -1;
            vndf_vec3 wm = seen_draw(&s, in[5][i], in[6][i], &alone);
            TEST(wm.x == x[i] && wm.y == y[i] && wm.z == z[i] && pdf[i] == alone);
        }
    }
    set_flushing(0);
}

static void test_calls(const vndf_distribution *d, const char *name)
{
    set_flushing(1);
    stress_result result = stress_run(d, test_amount(74, 37, 19), test_amount(1000, 4000, 40000), 1);
    set_flushing(0);
    for (int id = 0; id < STRESS_COUNT; id++)
        if (!(TEST(result.found[id].failed == 0) & TEST(result.found[id].checked > 0)))
            fprintf(stderr, "  %s, %s: worst %g\n", name, stress_properties[id].name, result.found[id].worst);
}

static void test_subject(const subject *of, size_t index)
{
    if (index >= 2 && index % 3 != 2)
        return;
    test_batches(of->d);
    test_calls(of->d, of->name);
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}

#else

int main(void)
{
    printf("SKIPPED: no way to flush denormals is known here\n");
    return 0;
}

#endif
