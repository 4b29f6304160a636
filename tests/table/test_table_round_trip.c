/* Saved and loaded, a table is the same, numbers and file, to the byte; a file is the bytes that memory gets. What
 * cannot be saved or loaded gives its status and leaves nothing behind. vndf_numbers gives as many numbers as it says,
 * a head of 8 and five rows of four for each knot, and no more than there is room for. (What they say: exported_*.) */
#include "harness/damage.h"
#include "oracle/oracle.h"

enum { ROOM = 1 << 14 };

static void test_numbers(const vndf_distribution *d)
{
    static float all[ROOM], part[ROOM];
    size_t count = vndf_numbers(d, NULL, 0);
    if (!TEST(count == 8 + 5 * 4 * (vndf_distribution_info(d).cells + 1) && count < ROOM))
        return;
    all[count] = part[count - 1] = 7;
    TEST(vndf_numbers(d, all, count) == count && all[count] == 7);
    TEST(vndf_numbers(d, part, count - 1) == count && part[count - 1] == 7);
    TEST(memcmp(all, part, (count - 1) * sizeof *all) == 0);
    TEST(vndf_numbers(NULL, part, 1) == 0 && vndf_numbers(vndf_ggx(), part, 1) == 0);
}

static void test_round_trip(size_t kind)
{
    static unsigned char bytes[3][ROOM];
    static float numbers[2][ROOM];
    const char *path = "test_table_round_trip.vndf";
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = oracle_build(oracle_get(kind).name, 4096, NULL, NULL);
    size_t size = vndf_distribution_info(table).bytes;
    TEST(table && vndf_save(table, path, &error) == VNDF_OK);
    vndf_distribution *loaded = vndf_load(path, &error);
    TEST(loaded && vndf_distribution_info(loaded).bytes == size && read_bytes(path, bytes[0], ROOM) == size);
    TEST(vndf_save_memory(table, bytes[1], size, NULL) == VNDF_OK && memcmp(bytes[1], bytes[0], size) == 0);
    TEST(vndf_save_memory(loaded, bytes[2], size, NULL) == VNDF_OK && memcmp(bytes[2], bytes[0], size) == 0);
    size_t count = vndf_numbers(table, numbers[0], ROOM);
    TEST(vndf_numbers(loaded, numbers[1], ROOM) == count &&
         memcmp(numbers[0], numbers[1], count * sizeof(float)) == 0);
    test_numbers(loaded);
    TEST(vndf_save(table, "no-such-folder/table.vndf", &error) == VNDF_ERROR_IO && error.status == VNDF_ERROR_IO);
    TEST_HAS(error.message, "no-such-folder");
    TEST(vndf_save(table, "no-such-folder/table.vndf", NULL) == VNDF_ERROR_IO);
    TEST(vndf_save(table, NULL, &error) == VNDF_ERROR_ARGUMENT);
    vndf_free(table);
    vndf_free(loaded);
    remove(path);
}

static void test_errors(void)
{
    unsigned char byte;
    vndf_error error = {VNDF_OK, ""};
    TEST(vndf_save(NULL, "x.vndf", &error) == VNDF_ERROR_ARGUMENT && !read_bytes("x.vndf", &byte, 1));
    TEST(vndf_save(vndf_ggx(), "x.vndf", &error) == VNDF_ERROR_ARGUMENT && !read_bytes("x.vndf", &byte, 1));
    TEST(!vndf_load("no-such-file.vndf", &error) && error.status == VNDF_ERROR_IO);
    TEST_HAS(error.message, "no-such-file.vndf: cannot be opened: ");
    TEST(!vndf_load(NULL, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_load_memory(NULL, 100, &error) && error.status == VNDF_ERROR_ARGUMENT);
    TEST(!vndf_load_memory("VNDFtab\n", 8, &error) && error.status == VNDF_ERROR_TABLE);
    TEST(!vndf_load_memory("", 0, NULL));
    vndf_free(NULL);
}

int main(void)
{
    test_round_trip(ORACLE_STUDENT); /* of a heavy tail */
    test_round_trip(ORACLE_MEASURED);
    test_round_trip(ORACLE_RING);
    test_errors();
    return test_done();
}
