/* Whichever allocation fails, the call that needed it says so (VNDF_ERROR_MEMORY, with a message), and nothing leaks:
 * every operation is tried with its first allocation failing, then its second, until it succeeds with none that failed.
 * And vndf_info.memory is what a loaded table holds of the heap, to the byte.
 *
 * The linker puts the functions below in the place of malloc and its kin (--wrap), in the library as well as here. */
#include "harness/test.h"
#include "oracle/oracle.h"
#include "source/source.h"
#include "vndf_bsdf.h"

#ifdef VNDF_TEST_WRAP

void *__real_malloc(size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

/* Allocations that succeed before one fails, failures so far, blocks that are live and their bytes. Each block stands
 * behind its size. */
enum { HEAD = 16 };
static long left = -1, failed, live;
static size_t held;

void *__wrap_malloc(size_t size)
{
    int fails = left >= 0 && left-- == 0;
    failed += fails;
    char *block = fails ? NULL : __real_malloc(size + HEAD);
    if (!block)
        return NULL;
    memcpy(block, &size, sizeof size);
    live++;
    held += size;
    return block + HEAD;
}

void *__wrap_calloc(size_t count, size_t size)
{
    void *block = __wrap_malloc(count * size);
    return block ? memset(block, 0, count * size) : NULL;
}

void __wrap_free(void *block)
{
    size_t size;
    if (!block)
        return;
    memcpy(&size, (char *)block - HEAD, sizeof size);
    live--;
    held -= size;
    __real_free((char *)block - HEAD);
}

void *__wrap_realloc(void *block, size_t size)
{
    size_t old = 0;
    void *grown = __wrap_malloc(size);
    if (block)
        memcpy(&old, (char *)block - HEAD, sizeof old);
    if (grown && block)
        memcpy(grown, block, old < size ? old : size);
    if (grown)
        __wrap_free(block);
    return grown;
}

/* ---- operations: each frees what it made ---- */

static const char saved[] = "allocation.vndf";

static double laplace(double r, void *user)
{
    return exp(-r) * (user == NULL);
}

/* From a shell's words, a file, or a function. */
static vndf_source *source_of(const char *words, vndf_error *error)
{
    return words[0] == '-'   ? vndf_source_from_description(words, error)
           : words[0] == '/' ? vndf_source_csv_file(words, error)
                             : vndf_source_slope_callback(laplace, NULL, words, error);
}

static int build(const char *words, vndf_error *error)
{
    const vndf_build_options options = {.max_bytes = 2048, .max_tv = 0.5};
    vndf_source *source = source_of(words, error);
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, error) : NULL;
    vndf_free(table);
    vndf_source_free(source);
    return table != NULL;
}

/* A shipped table: loaded both ways, saved, measured again. */
static int use_table(const char *path, vndf_error *error)
{
    static unsigned char bytes[1 << 14];
    vndf_certificate certificate;
    vndf_distribution *table = vndf_load(path, error);
    size_t size = vndf_distribution_info(table).bytes;
    int good = table && size <= sizeof bytes && vndf_save_memory(table, bytes, size, error) == VNDF_OK &&
               vndf_save(table, saved, error) == VNDF_OK;
    vndf_distribution *again = good ? vndf_load_memory(bytes, size, error) : NULL;
    vndf_source *source = again ? vndf_source_of(table, error) : NULL;
    good = source && vndf_certify(table, source, &certificate, error) == VNDF_OK;
    vndf_source_free(source);
    vndf_free(again);
    vndf_free(table);
    return good;
}

/* A family: loaded, saved, made of distributions, built. */
static int use_family(const char *name, vndf_error *error)
{
    const vndf_distribution *closed[] = {vndf_ggx(), vndf_beckmann()};
    const float parameters[] = {1, 2};
    const vndf_family_options options = {.knots = 2, .max_bytes = 2048};
    vndf_family *loaded = vndf_family_load(VNDF_SOURCE_DIR "/tests/corpus/family/two.vndfs", error);
    int good = loaded && vndf_family_save(loaded, saved, error) == VNDF_OK;
    vndf_family *made = good ? vndf_family_of(closed, parameters, 2, error) : NULL;
    vndf_family *built = made ? vndf_build_family(name, 2, 3, &options, error) : NULL;
    vndf_family_free(loaded);
    vndf_family_free(made);
    vndf_family_free(built);
    return built != NULL;
}

static int albedo(const char *name, vndf_error *error)
{
    vndf_albedo *built = vndf_albedo_build(vndf_ggx(), 0.0f, error);
    int good = built != NULL;
    (void)name;
    vndf_albedo_free(built);
    return good;
}

static const struct trial {
    int (*use)(const char *name, vndf_error *error);
    const char *name;
} TRIALS[] = {
    {build, "--slope 'exp(-k*r)*step(2-r)' --set k=3"},
    {build, "--ndf 'c^20*(1+theta)'"},
    {build, "--family student-t:2.5"},
    {build, "--family 'mix:(0.7,0.1,ggx)+(0.3,0.4,beckmann)'"},
    {build, "--family sgd:alum-bronze/r"},
    {build, VNDF_SOURCE_DIR "/tables/example.csv"},
    {build, "callback"},
    {use_table, VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf"},
    {use_family, "student-t"},
    {albedo, "ggx"},
};

static int try_with(const struct trial *of, long after)
{
    vndf_error error = {VNDF_OK, ""};
    long before = live;
    left = after;
    failed = 0;
    int good = of->use(of->name, &error);
    left = -1;
    int clean = TEST(live == before) & TEST(good == !failed) &
                TEST(error.status == (failed ? VNDF_ERROR_MEMORY : VNDF_OK)) &
                TEST(!failed || strstr(error.message, "no memory"));
    if (!clean)
        fprintf(stderr, "  %s, allocation %ld: status %d, '%s', %ld blocks more\n", of->name, after,
                (int)error.status, error.message, live - before);
    return failed != 0;
}

/* 16 KiB are what lanes read (table/table.h). */
static void test_memory(const char *path, double most)
{
    size_t before = held;
    vndf_distribution *table = vndf_load(path, NULL);
    vndf_info info = vndf_distribution_info(table);
    if (!(TEST(table != NULL) & TEST(info.memory == held - before) &
          TEST((double)info.memory <= most * (double)info.bytes + 16384)))
        fprintf(stderr, "  %s: says %zu, holds %zu, its file %zu\n", path, info.memory, held - before, info.bytes);
    vndf_free(table);
    TEST(held == before);
}

/* A family's 1500 allocations are many times the same. */
int main(void)
{
    const long every = 200, step = 97;
    test_memory(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", 2.4);
    test_memory(VNDF_SOURCE_DIR "/tables/student-t-2.5.vndf", 2.4);
    test_memory(VNDF_SOURCE_DIR "/tests/corpus/table/ring.vndf", 9);
    TEST(vndf_distribution_info(vndf_ggx()).memory == 0 && vndf_distribution_info(NULL).memory == 0);
    for (size_t i = 0; i < sizeof TRIALS / sizeof *TRIALS; i++) {
        long n = 0;
        while (try_with(&TRIALS[i], n))
            n += n < every ? 1 : step;
        TEST(n > 0);
    }
    remove(saved);
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: the linker has no --wrap here, allocations cannot be made to fail");
    return 0;
}

#endif
