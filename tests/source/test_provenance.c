/* Every source says in words of `vndf build` what made it; of a formula and a family these words make the same source
 * again, and a table keeps them. Words out of files are not misread, and a program may bring its own. */
#include "core/checksum.h"
#include "source/sources.h"

static double one(double x, void *user)
{
    (void)x;
    return user ? 0 : 1;
}

/* The words, and whether they make a source again, with the same bits. */
static void test_source(vndf_source *source, const char *words, int again)
{
    vndf_error error = {VNDF_OK, ""};
    if (!TEST(source && strcmp(vndf_source_description(source), words) == 0 && source->rebuildable == again))
        fprintf(stderr, "  %s\n", vndf_source_description(source));
    vndf_source *other = vndf_source_from_description(words, &error);
    if (again && made(other, &error, words))
        TEST(strcmp(vndf_source_description(other), words) == 0);
    for (double r = 0; again && r < 3; r += 0.1)
        TEST(vndf_source_p22(other, r) == vndf_source_p22(source, r));
    if (!again)
        refused(other, &error, VNDF_ERROR_ARGUMENT, "keeps only its name");
    else
        vndf_source_free(other);
    vndf_source_free(source);
}

static void test_descriptions(void)
{
    const vndf_parameter third = {"x", 1.0 / 3};
    const char *csv = "slope,p22\n0,1\n1,0\n";
    const double x[2] = {0, 1}, value[2] = {4, 1};
    const unsigned char bytes[32] = {[14] = 0xf0, 0x3f, [22] = 0x10, 0x40, [30] = 0xf0, 0x3f}; /* little-endian */
    char words[80];
    TEST(vndf_crc32(0, "123456789", 9) == 0xCBF43926u && vndf_crc32(0, "", 0) == 0);
    TEST(vndf_crc32(vndf_crc32(0, "1234", 4), "56789", 5) == 0xCBF43926u);
    test_source(vndf_source_ndf_expression("c^x", &third, 1, NULL), "--ndf 'c^x' --set x=0.3333333333333333", 1);
    test_source(slope_of("1 /\n2"), "--slope '1 / 2'", 1);
    test_source(slope_of(" 1\t"), "--slope ' 1 '", 1);
    test_source(family_of("sgd:alum-bronze/r"), "--family sgd:alum-bronze/r", 1);
    test_source(family_of("mix:(1,2,ggx)+(1,1,epd:3)"), "--family 'mix:(1,2,ggx)+(1,1,epd:3)'", 1);
    test_source(vndf_source_ndf_callback(one, NULL, "it's mine", NULL), "--ndf-callback 'it'\\''s mine'", 0);
    test_source(vndf_source_slope_callback(one, NULL, NULL, NULL), "--slope-callback unnamed", 0);
    test_source(vndf_source_slope_callback(one, NULL, "", NULL), "--slope-callback ''", 0);
    sprintf(words, "--csv 'my gloss.csv' (crc32 %08lx)", (unsigned long)vndf_crc32(0, csv, strlen(csv)));
    test_source(vndf_source_csv_text("my gloss.csv", csv, strlen(csv), NULL), words, 0);
    sprintf(words, "--rows unnamed (crc32 %08lx)", (unsigned long)vndf_crc32(0, bytes, sizeof bytes));
    test_source(vndf_source_rows(VNDF_ROWS_OVER_SLOPE, VNDF_ROWS_OF_P22, x, value, 2, NULL, NULL), words, 0);
}

/* A program may bring words of its own. */
static void test_own_words(void)
{
    static char words[VNDF_LIMIT_NAME_LENGTH + 2];
    static const char *const bad[][2] = {
        {"", "a description of 0 characters"},
        {"--height a\nb", "column 11 of the description: a control character"},
        {"--height a\177", "column 11 of the description: a control character"},
        {"--height 'a", "column 10: a quote in this word is not closed"},
        {"--family ggx", "begins as that of a formula or a family"},
        {"'--slope' 1", "begins as that of a formula or a family"},
        {NULL, "the description is NULL"},
        {words, "a description of 4097 characters; 1 to 4096"},
    };
    vndf_error error = {VNDF_OK, ""};
    vndf_source *source = vndf_source_slope_callback(one, NULL, "f", NULL), *family = family_of("ggx");
    memset(words, 'x', VNDF_LIMIT_NAME_LENGTH + 1);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        TEST(vndf_source_describe(source, bad[i][0], &error) == VNDF_ERROR_ARGUMENT &&
             TEST_HAS(error.message, bad[i][1]));
    TEST(vndf_source_describe(NULL, "a", &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_source_describe(family, "--height a", &error) == VNDF_ERROR_ARGUMENT);
    TEST_HAS(error.message, "the description '--family ggx' makes this source again");
    words[VNDF_LIMIT_NAME_LENGTH] = '\0';
    TEST(vndf_source_describe(source, words, NULL) == VNDF_OK);
    TEST(strcmp(vndf_source_description(source), words) == 0);
    words[1] = ' '; /* notes, of which test_table_damage has more */
    TEST(vndf_source_note(source, words, &error) == VNDF_ERROR_ARGUMENT);
    words[VNDF_LIMIT_NOTES - 1] = '\n';
    TEST(vndf_source_note(source, words, NULL) == VNDF_OK);
    strcpy(words + VNDF_LIMIT_NOTES, "y");
    TEST(vndf_source_note(source, words, &error) == VNDF_ERROR_ARGUMENT && TEST_HAS(error.message, "limit"));
    TEST(vndf_source_note(source, NULL, NULL) == VNDF_ERROR_ARGUMENT);
    vndf_source_free(source);
    vndf_source_free(family);
}

int main(void)
{
    test_descriptions();
    test_own_words();
    return test_done();
}
