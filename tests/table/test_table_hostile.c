/* A table whose bytes were changed and whose checksum was put right is refused, or its samples are finite, unit
 * and not below the surface and its densities finite and positive: such tables may be wrong, never dangerous. */
#define _DEFAULT_SOURCE
#include "harness/damage.h"
#include "oracle/oracle.h"
#include "vndf_build.h"

static uint32_t get_u32(const unsigned char *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* One change: a bit, a byte, a word of a nasty number, two words swapped, or a float scaled. */
static void mutate(unsigned char *bytes, size_t size, unsigned long long *state)
{
    static const uint32_t nasty[] = {0,          1,          0x7f800000, 0xff800000, 0x7fc00000, 0x80000000,
                                     0x3f800000, 0x00800000, 0x7f7fffff, 0xffffffff, 0x00000002, 0x33800000};
    unsigned long long r = test_random_bits(state);
    size_t at = 16 + (size_t)(r >> 20) % (size - 24), word = at & ~(size_t)3,
           other = 16 + (size_t)(r >> 33) % (size - 24);
    float f;
    switch (r >> 61) {
    case 0: bytes[at] ^= (unsigned char)(1 << (r & 7)); break;
    case 1: bytes[at] = (unsigned char)r; break;
    case 2: put_u32(bytes + at, nasty[(r & 0xffff) % 12]); break;
    case 3: put_u32(bytes + word, get_u32(bytes + (other & ~(size_t)3))); break;
    default:
        memcpy(&f, bytes + at, sizeof f);
        f *= (float)exp(8 * (test_uniform(state) - 0.5f));
        memcpy(bytes + at, &f, sizeof f);
    }
}

int main(void)
{
    unsigned char bytes[2048], copy[2048];
    unsigned long long state = 23;
    oracle o = oracle_get(ORACLE_LAPLACE);
    vndf_distribution *table = oracle_build(&o, 2048, NULL);
    size_t size = vndf_distribution_info(table).bytes;
    long taken = 0, unsafe = 0, tries = test_quick() ? 4000 : 20000;
    TEST(table && size <= sizeof bytes && vndf_save_memory(table, bytes, size, NULL) == VNDF_OK);
    for (long i = 0; size <= sizeof bytes && i < tries; i++) {
        unsigned long long before = state;
        memcpy(copy, bytes, size);
        for (unsigned long long n = 1 + test_random_bits(&state) % 3; n > 0; n--)
            mutate(copy, size, &state);
        mend_checksum(copy, size);
        vndf_error error = {VNDF_OK, ""};
        vndf_distribution *changed = vndf_load_memory(copy, size, &error);
        TEST((changed == NULL) == (error.status == VNDF_ERROR_TABLE));
        taken += changed != NULL;
        if (changed && !TEST(is_safe(changed, &state)) && unsafe++ < 5)
            fprintf(stderr, "  state %llu\n", before);
        vndf_free(changed);
    }
    fprintf(stderr, "%ld of %ld changed tables were taken, %ld of them unsafe\n", taken, tries, unsafe);
    vndf_free(table);
    return test_done();
}
