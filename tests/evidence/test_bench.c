/* `vndf bench`: the rows that are asked for and no others, with every number in CSV and JSON, and tables that fit a
 * terminal. Times themselves are not judged; few seconds make as few turns as there may be. It notices a row too many,
 * a column that is lost, a batch that is not timed, results that are wrong. */
#include "harness/run_program.h"

static const char head[] =
    "distribution,method,kind,alpha_x,alpha_y,memory,file_bytes,moments,wrong,ns,portable_ns,avx2_ns,avx512_ns,"
    "shared_ns,eval_ns,pdf_ns,spread,ratio,tv,tv_below,max_weight,stratified,efficiency_60,efficiency_85,"
    "efficiency_light,mean,noise,lost,variance,efficiency\n";

/* Columns. */
enum { ALPHA_Y = 4, MEMORY, FILE_BYTES, MOMENTS, WRONG, NS, BATCH, RATIO = 17, TV, BELOW, WEIGHT, SOBOL };
enum { MEAN = 25, LOST = 27, COLUMNS = 30 };

/* Where a field of a line of CSV begins: commas between quotes are text. */
static const char *field(const char *line, int column)
{
    for (int is_text = 0; column > 0 && *line != '\n' && *line; line++) {
        is_text ^= *line == '"';
        column -= *line == ',' && !is_text;
    }
    return line;
}

static double number(const char *line, int column)
{
    return strtod(field(line, column), NULL);
}

/* The first line of the rows that these words print as CSV: they are of these methods, in this order, each has all
 * fields, a time, and is right. */
static const char *rows_of(const char *words, const char *methods)
{
    static char text[RUN_TEXT];
    char found[1024] = "";
    run_said(text, "vndf bench %s -o -", words);
    if (!TEST(strncmp(text, head, sizeof head - 1) == 0))
        return text;
    for (const char *at = text + sizeof head - 1; *at; at = strchr(at, '\n') + 1) {
        const char *method = field(at, 1) + 1, *last = field(at, COLUMNS - 1);
        const int length = (int)strcspn(method, "\"");
        if (strncmp(method + length, "\",call,", 7) == 0) /* which is timed alone */
            TEST(*field(at, TV) == ',');
        if (!(TEST(last[-1] == ',' && *field(last, 1) == '\n') &
              TEST(strncmp(field(at, WRONG), "0,", 2) == 0 && number(at, NS) > 0)))
            fprintf(stderr, "  %.*s\n", (int)strcspn(at, "\n"), at);
        snprintf(found + strlen(found), sizeof found - strlen(found), "%.*s|", length, method);
    }
    if (!TEST(strcmp(found, methods) == 0))
        fprintf(stderr, "  %s\n  not %s\n", found, methods);
    return text + sizeof head - 1;
}

#define TABLE "table 8 KiB, 4 moments"

static void test_normals(void)
{
    const char *row = rows_of("--seconds 0.1 --only ggx",
                              "spherical caps (2023)|all normals (2007)|closed form|closed form: affine|"
                              "closed form: mixture|closed form, exported C|");
    TEST(number(row, RATIO) == 1 && number(row, TV) < 1e-6 && number(row, BATCH) > 0);
    TEST(strncmp(row, "\"ggx\",\"spherical caps (2023)\",published,,,0,,,", 45) == 0);
    row = rows_of("--seconds 0.1 --slope 'exp(-a*r)' --set a=3 --only '" TABLE "'",
                  TABLE "|" TABLE ": weight|" TABLE ": pdf|" TABLE ": invert|" TABLE ": ndf|" TABLE
                        ": lambda|" TABLE ": affine|" TABLE ": mixture|" TABLE ", exported C|");
    TEST_HAS(row, "\"--slope 'exp(-a*r)' --set a=3\",\"" TABLE "\",table,");
    TEST(number(row, MEMORY) > number(row, FILE_BYTES) && number(row, FILE_BYTES) > 7900);
    TEST(number(row, MOMENTS) == 4 && number(row, WEIGHT) > 1 && number(row, BATCH) > 0);
    TEST(number(row, SOBOL) > 0.1 && number(row, SOBOL) < 1.6); /* of caps */
    TEST(number(row, BELOW) > number(row, TV) && fabs(number(row, TV) - 2.44e-4) < 2e-5);
}

static void test_effects(void)
{
    static const char three[] = "separable masking|V-cavity masking|no masking|";
    char methods[200];
    snprintf(methods, sizeof methods, "%s%s%s", three, three, three); /* of GGX, Beckmann and a table */
    const char *row = rows_of("--effects --seconds 0.01 --only masking --alpha 0.3,0.2", methods);
    TEST(number(row, ALPHA_Y) == 0.2 && number(row, BATCH) > 0);
    static char text[RUN_TEXT];
    int count = -1; /* the head */
    run_said(text, "vndf bench --effects --seconds 0.01 -o -");
    for (const char *at = text; *at; at += strcspn(at, "\n") + 1, count++) {
        const int is_table = strncmp(at, "\"student", 8) == 0,
                  is_bounded = strncmp(field(at, 1), "\"bounded", 8) == 0;
        const double mean = number(at, MEAN), most = number(at, WEIGHT), lost = number(at, LOST);
        const int is_bare = is_bounded || strncmp(field(at, 1), "\"bare", 5) == 0;
        if (count >= 0 && !TEST(number(at, WRONG) == 0 && mean > 0 && mean < 2.25 &&
                                (!is_bounded || lost <= (is_table ? 0 : 0.06)) &&
                                (!is_bare || most <= (is_table ? 1.3 : 1.00001))))
            fprintf(stderr, "  %.*s\n", (int)strcspn(at, "\n"), at);
    }
    TEST(count == 3 * 24);
    TEST_HAS(text, "\"walk, both lobes\"");
}

/* Text and Markdown leave out columns without a number, and -q prints nothing. */
static void test_tables(void)
{
    static char text[RUN_TEXT];
    run_said(text, "vndf bench --seconds 0.1 --only moments -o rows.md");
    for (const char *at = text; *at; at += strcspn(at, "\n") + 1)
        TEST(strcspn(at, "\n") <= 100);
    TEST(strstr(text, "  table 2 KiB, 4 moments ") && !strstr(text, "caps (2023)") && !strstr(text, "eval"));
    size_t size;
    char *markdown = run_file("rows.md", &size);
    TEST(markdown && strstr(markdown, "| student-t:2.5 | table 8 KiB, 4 moments | ") &&
         strstr(markdown, " | ratio | TV | below | weight | Sobol' | eff 60 |") && !strstr(markdown, "| eval |"));
    free(markdown);
    TEST(remove("rows.md") == 0);
    TEST(*run_said(text, "vndf bench --only caps --seconds 0.1 -q") == '\0');
    TEST_HAS(run_said(text, "vndf bench --only caps --seconds 0.1 --json"),
             "\"kind\": \"published\", \"alpha_x\": null, \"alpha_y\": null, \"memory\": 0, ");
}

int main(void)
{
    char folder[] = "bench.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    test_normals();
    test_effects();
    test_tables();
    return run_end(folder);
}
