/* `vndf bench`: the rows that are asked for and no others, with every number in CSV and JSON, and tables that fit a
 * terminal. Times themselves are not judged; few seconds make as few turns as there may be. It notices a row too many,
 * a column that is lost, a batch that is not timed, results that are wrong. */
#include "harness/run_program.h"

static const char head[] =
    "distribution,method,kind,alpha_x,alpha_y,memory,file_bytes,moments,wrong,ns,portable_ns,avx2_ns,avx512_ns,"
    "shared_ns,eval_ns,pdf_ns,spread,ratio,tv,tv_below,max_weight,stratified,efficiency_60,efficiency_85,"
    "efficiency_light,mean,noise,lost,variance,efficiency\n";

/* Columns. */
enum { ALPHA_Y = 4, MEMORY, FILE_BYTES, MOMENTS, WRONG, NS, BATCH, RATIO = 17, TV, BELOW, WEIGHT };
enum { MEAN = 25, LOST = 27, COLUMNS = 30 };

#define LIST(...)       \
  (const char *const[]) \
  {                     \
    __VA_ARGS__, NULL   \
  }

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

/* The first line of the rows that these words print as CSV: they begin with `rows`, in this order, each has all fields,
 * a time, and is right. */
static const char *rows_of(const char *words, const char *const *rows)
{
    static char text[RUN_TEXT];
    run_said(text, "vndf bench %s -o -", words);
    if (!TEST(strncmp(text, head, sizeof head - 1) == 0))
        return text;
    for (const char *at = text + sizeof head - 1; *at; at = strchr(at, '\n') + 1) {
        const char *last = field(at, COLUMNS - 1);
        if (strstr(*rows ? *rows : "", ",call,")) /* which is timed alone */
            TEST(*field(at, TV) == ',');
        if (!(TEST(*rows && strncmp(at, *rows, strlen(*rows)) == 0) &
              TEST(last[-1] == ',' && *field(last, 1) == '\n') &
              TEST(strncmp(field(at, WRONG), "0,", 2) == 0 && number(at, NS) > 0)))
            fprintf(stderr, "  not %s: %.*s\n", *rows ? *rows : "asked for", (int)strcspn(at, "\n"), at);
        rows += *rows != NULL;
    }
    TEST(!*rows);
    return text + sizeof head - 1;
}

static void test_normals(void)
{
    const char *row = rows_of(
        "--seconds 0.1 --only ggx",
        LIST("\"ggx\",\"spherical caps (2023)\",published,,,0,,,", "\"ggx\",\"all normals (2007)\",published,",
             "\"ggx\",\"closed form\",closed,,,0,,,", "\"ggx\",\"closed form: 16 a view\",call,",
             "\"ggx\",\"closed form: affine\",call,", "\"ggx\",\"closed form: mixture\",call,",
             "\"ggx\",\"closed form: 8 lobes\",call,", "\"ggx\",\"closed form, exported C\",exported,"));
    TEST(number(row, RATIO) == 1 && number(row, TV) < 1e-6 && number(row, BATCH) > 0);
    row = rows_of("--seconds 0.1 --slope 'exp(-a*r)' --set a=3 --only '8 KiB, 4 moments'",
                  LIST("\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments\",table,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: weight\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: pdf\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: invert\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: ndf\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: lambda\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: 16 a view\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: affine\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: mixture\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments: 8 lobes\",call,",
                       "\"--slope 'exp(-a*r)' --set a=3\",\"table 8 KiB, 4 moments, exported C\",exported,"));
    TEST(number(row, MEMORY) > number(row, FILE_BYTES) && number(row, FILE_BYTES) > 7900);
    TEST(number(row, MOMENTS) == 4 && number(row, WEIGHT) > 1 && number(row, BATCH) > 0);
    TEST(number(row, BELOW) > number(row, TV) && number(row, TV) > 1e-5);
}

static void test_effects(void)
{
    const char *row = rows_of("--effects --seconds 0.01 --only masking --alpha 0.3,0.2",
                              LIST("\"ggx\",\"separable masking\",effects,0.3,0.2,,,,",
                                   "\"ggx\",\"V-cavity masking\",", "\"ggx\",\"no masking\",",
                                   "\"beckmann\",\"separable", "\"beckmann\",\"V-cav", "\"beckmann\",\"no m",
                                   "\"student-t:2.5\",\"sep", "\"student-t:2.5\",\"V-", "\"student-t:2.5\",\"no"));
    TEST(number(row, ALPHA_Y) == 0.2 && number(row, BATCH) > 0);
    static char text[RUN_TEXT];
    int count = -1; /* the head */
    double bare = 0;
    run_said(text, "vndf bench --effects --seconds 0.01 -o -");
    for (const char *at = text; *at; at += strcspn(at, "\n") + 1, count++) {
        const int is_table = strncmp(at, "\"student", 8) == 0,
                  is_bounded = strncmp(field(at, 1), "\"bounded", 8) == 0;
        const double mean = number(at, MEAN), most = number(at, WEIGHT), lost = number(at, LOST);
        const int is_bare = is_bounded || strncmp(field(at, 1), "\"bare", 5) == 0;
        const int is_by_hand = strncmp(field(at, 1), "\"bare reflection, by hand\"", 26) == 0; /* behind bare */
        bare = is_by_hand ? bare : mean;
        if (count >= 0 && !TEST(number(at, WRONG) == 0 && mean > 0 && mean < 2.25 &&
                                fabs(mean / bare - 1) < 1e-5 && (!is_bounded || lost <= (is_table ? 0 : 0.06)) &&
                                (!is_bare || most <= (is_table ? 1.3 : 1.00001))))
            fprintf(stderr, "  %.*s\n", (int)strcspn(at, "\n"), at);
    }
    TEST(count == 3 * 24 + 1);
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
