/* vndf_info.memory is what a loaded table holds of the heap, to the byte; and of every shipped table that is no
 * more than so many times its file. The linker puts the functions below in the place of malloc and its kin
 * (--wrap), in the library as well as here. */
#include <stdlib.h>
#include <string.h>

#include "harness/test.h"
#include "vndf.h"

#ifdef VNDF_TEST_WRAP

#  include <dirent.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);

/* ---- counting ---- */

typedef struct counted {
    void *at;
    size_t size;
} counted;

/* Blocks that were taken while `counting` and are live, and their bytes in all. */
enum { BLOCKS_MAX = 256 };
static counted blocks[BLOCKS_MAX];
static size_t block_count, held;
static int counting;

static void add(void *block, size_t size)
{
    if (!counting || !block || !TEST(block_count < BLOCKS_MAX))
        return;
    blocks[block_count++] = (counted){block, size};
    held += size;
}

static void take_away(const void *block)
{
    for (size_t i = 0; i < block_count; i++)
        if (blocks[i].at == block) {
            held -= blocks[i].size;
            blocks[i] = blocks[--block_count];
            return;
        }
}

void *__wrap_malloc(size_t size)
{
    void *block = __real_malloc(size);
    add(block, size);
    return block;
}

void *__wrap_calloc(size_t count, size_t size)
{
    void *block = __real_calloc(count, size);
    add(block, count * size);
    return block;
}

void *__wrap_realloc(void *block, size_t size)
{
    take_away(block);
    void *grown = __real_realloc(block, size);
    add(grown, size);
    return grown;
}

void __wrap_free(void *block)
{
    take_away(block);
    __real_free(block);
}

/* ---- tables ---- */

/* How many times its file a table may take, beside 448 bytes by which rho is looked up: 25 numbers for each knot, of 10
 * or 11 in the file. */
static const double MOST = 2.4;

/* A bound of 0 is none. */
static void test_table(const char *folder, const char *name, double most)
{
    char path[1024];
    snprintf(path, sizeof path, VNDF_SOURCE_DIR "/%s/%s", folder, name);
    counting = 1;
    vndf_distribution *table = vndf_load(path, NULL);
    counting = 0;
    vndf_info info = vndf_distribution_info(table);
    int told = TEST(table != NULL) && TEST(info.memory == held);
    if (!told || !TEST(most <= 0 || (double)held <= most * (double)info.bytes + 448))
        fprintf(stderr, "  %s: says %lu, holds %lu, its file %lu\n", name, (unsigned long)info.memory,
                (unsigned long)held, (unsigned long)info.bytes);
    vndf_free(table);
    TEST(held == 0);
}

static void test_shipped(void)
{
    int count = 0;
    struct dirent *entry;
    DIR *folder = opendir(VNDF_SOURCE_DIR "/tables");
    while (TEST(folder != NULL) && (entry = readdir(folder)) != NULL) {
        size_t length = strlen(entry->d_name);
        if (length < 5 || strcmp(entry->d_name + length - 5, ".vndf") != 0)
            continue;
        test_table("tables", entry->d_name, MOST);
        count++;
    }
    if (folder)
        closedir(folder);
    TEST(count >= 15);
}

int main(void)
{
    static const char *const odd[] = {"disc.vndf", "exponential.vndf", "ring.vndf", "singular.vndf", "tail.vndf"};
    test_shipped();
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        test_table("tests/corpus/table", odd[i], 0);
    TEST(vndf_distribution_info(vndf_ggx()).memory == 0 && vndf_distribution_info(vndf_beckmann()).memory == 0);
    TEST(vndf_distribution_info(NULL).memory == 0);
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: the linker has no --wrap here, allocations cannot be counted");
    return 0;
}

#endif
