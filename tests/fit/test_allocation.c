/* Whichever allocation fails, the call that needed it says so (VNDF_ERROR_MEMORY, with a message), and nothing
 * leaks: every operation is tried with its first allocation failing, then its second, until it succeeds with
 * none that failed. And vndf_info.memory is what a loaded table holds of the heap, to the byte, no more than 2.4 times
 * its file for a shipped one.
 *
 * The linker puts the functions below in the place of malloc and its kin (--wrap), in the library as well as
 * here. */
#include <stdlib.h>

#include "oracle/oracle.h"
#include "source/source.h"
#include "table/file.h"
#include "harness/test.h"
#include "vndf_bsdf.h"

#ifdef VNDF_TEST_WRAP

#  include <dirent.h>

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

static const char shipped[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";
static const char csv[] = "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n";
static const char saved[] = "allocation.vndf";

static double laplace(double r, void *user)
{
    (void)user;
    return exp(-r);
}

/* A way to a source, or a name for what takes one; a shell's words for what has them. */
typedef struct subject {
    const char *name, *words;
    double max_tv;
} subject;

static const subject sources[] = {
    {"slope expression", "--slope 'exp(-k*r)*step(2-r)' --set k=3", 0},
    {"ndf expression", "--ndf 'c^20*(1+theta)'", 0},
    {"family", "--family student-t:2.5", 0},
    {"mix", "--family 'mix:(0.7,0.1,ggx)+(0.3,0.4,beckmann)'", 0},
    {"material", "--family sgd:alum-bronze/r", 0},
    {"CSV text", NULL, 0},
    {"CSV file", NULL, 0},
    {"callback", NULL, 0},
};
static const subject to_target = {"family, to a target", "--family student-t:2.5", 0.5};

static vndf_source *make(const subject *of, vndf_error *error)
{
    if (of->words)
        return vndf_source_from_description(of->words, error);
    if (strcmp(of->name, "CSV text") == 0)
        return vndf_source_csv_text("some.csv", csv, sizeof csv - 1, error);
    if (strcmp(of->name, "CSV file") == 0)
        return vndf_source_csv_file(VNDF_SOURCE_DIR "/tables/example.csv", error);
    return vndf_source_slope_callback(laplace, NULL, "laplace", error);
}

typedef int operation(const subject *of, vndf_error *error);

static int make_alone(const subject *of, vndf_error *error)
{
    vndf_source *source = make(of, error);
    vndf_source_free(source);
    return source != NULL;
}

/* The failures of the source were the subject of make_alone. */
static int build(const subject *of, vndf_error *error)
{
    vndf_build_options options = {.max_bytes = 2048, .max_tv = of->max_tv};
    long after = left;
    left = -1;
    vndf_source *source = make(of, error);
    left = after;
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, error) : NULL;
    vndf_free(table);
    vndf_source_free(source);
    return table != NULL;
}

/* A shipped table: loaded both ways, saved, measured again. */
static int use_table(const subject *of, vndf_error *error)
{
    static unsigned char bytes[1 << 14];
    vndf_certificate certificate;
    vndf_distribution *table = vndf_load(of->name, error);
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

static int reference(const subject *of, vndf_error *error)
{
    vndf_source *source = make(of, error);
    vndf_reference *made = source ? vndf_reference_from(source, error) : NULL;
    vndf_reference_free(made);
    vndf_source_free(source);
    return made != NULL;
}

/* A family: loaded, saved, made of distributions, built. */
static int use_family(const subject *of, vndf_error *error)
{
    const vndf_distribution *closed[] = {vndf_ggx(), vndf_beckmann()};
    const float parameters[] = {1, 2};
    const vndf_family_options options = {.knots = 2, .max_bytes = 2048};
    vndf_family *loaded = vndf_family_load(VNDF_SOURCE_DIR "/tests/corpus/family/two.vndfs", error);
    int good = loaded && vndf_family_save(loaded, saved, error) == VNDF_OK;
    vndf_family *made = good ? vndf_family_of(closed, parameters, 2, error) : NULL;
    vndf_family *built = made ? vndf_build_family(of->name, 2, 3, &options, error) : NULL;
    vndf_family_free(loaded);
    vndf_family_free(made);
    vndf_family_free(built);
    return built != NULL;
}

/* A table of albedos. */
static int albedo(const subject *of, vndf_error *error)
{
    vndf_albedo *built = vndf_albedo_build(vndf_ggx(), 0.0f, error);
    int good = built != NULL;
    (void)of;
    vndf_albedo_free(built);
    return good;
}

/* ---- the trial ---- */

static int try_with(operation *run, const subject *of, long after)
{
    vndf_error error = {VNDF_OK, ""};
    long before = live;
    left = after;
    failed = 0;
    int good = run(of, &error);
    left = -1;
    int clean = TEST(live == before) & TEST(good == !failed);
    if (failed)
        clean &= TEST(error.status == VNDF_ERROR_MEMORY) & TEST(strstr(error.message, "no memory") != NULL);
    else
        clean &= TEST(error.status == VNDF_OK);
    if (!clean)
        fprintf(stderr, "  %s, allocation %ld: status %d, '%s', %ld blocks more\n", of->name, after,
                (int)error.status, error.message, live - before);
    return failed != 0;
}

/* The first `every` allocations, and each step-th of those after them. */
static void try_all(const char *what, operation *run, const subject *of, long every, long step)
{
    long n = 0, tries = 0;
    while (try_with(run, of, n)) {
        n += n < every ? 1 : step;
        tries++;
    }
    TEST(n > 0);
    fprintf(stderr, "%-12s %-22s: some %ld allocations, %ld of them failed in turn\n", what,
            of->name == shipped ? "shipped table" : of->name, n, tries);
}

/* ---- what a table holds ---- */

/* A bound of 0 is none; 448 bytes are those by which rho is looked up. */
static void test_memory(const char *folder, const char *name, double most)
{
    char path[1024];
    snprintf(path, sizeof path, VNDF_SOURCE_DIR "/%s/%s", folder, name);
    size_t before = held;
    vndf_distribution *table = vndf_load(path, NULL);
    size_t more = held - before;
    vndf_info info = vndf_distribution_info(table);
    int told = TEST(table != NULL) && TEST(info.memory == more);
    if (!told || !TEST(most <= 0 || (double)more <= most * (double)info.bytes + 448))
        fprintf(stderr, "  %s: says %zu, holds %zu, its file %zu\n", name, info.memory, more, info.bytes);
    vndf_free(table);
    TEST(held == before);
}

static void test_memories(void)
{
    static const char *const odd[] = {"disc.vndf", "exponential.vndf", "ring.vndf", "singular.vndf", "tail.vndf"};
    int tables = 0;
    struct dirent *entry;
    DIR *folder = opendir(VNDF_SOURCE_DIR "/tables");
    while (TEST(folder != NULL) && (entry = readdir(folder)) != NULL)
        if (strlen(entry->d_name) > 5 && strcmp(entry->d_name + strlen(entry->d_name) - 5, ".vndf") == 0) {
            test_memory("tables", entry->d_name, 2.4);
            tables++;
        }
    if (folder)
        closedir(folder);
    TEST(tables >= 15);
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        test_memory("tests/corpus/table", odd[i], 0);
    TEST(vndf_distribution_info(vndf_ggx()).memory == 0 && vndf_distribution_info(NULL).memory == 0);
}

/* In long_allocation every allocation of every build fails, else all of those that make a source or a reference
 * and some of a build's. */
int main(void)
{
    const subject table = {shipped, NULL, 0};
    test_memories();
    int all = test_long();
    long step = (long)test_amount(97, 97, 1);
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        try_all("source", make_alone, &sources[i], 1000, 1);
        try_all("reference", reference, &sources[i], 1000, 1);
        try_all("build", build, &sources[i], all ? 1000 : 25, step);
    }
    try_all("build", build, &to_target, all ? 1000 : 25, step);
    const subject family = {"student-t", NULL, 0};
    try_all("use", use_table, &table, 1000, 1);
    try_all("use", use_family, &family, all ? 1000 : 100, 5 * step);
    try_all("albedo", albedo, &table, 1000, 1);
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
