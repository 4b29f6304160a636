/* Figures have names and units: build and info print the same lines, --json the same numbers in JSON, -q nothing; the
 * verdict is the last of them, and a table that is worth little is told of on stderr too. It notices a figure without a
 * unit, JSON that does not parse, and a verdict that praises a poor table. */
#include "harness/run_program.h"

/* ---- JSON ---- */

static const char *skip(const char *at)
{
    return at + strspn(at, " \n");
}

/* Behind a value of JSON; where it is none, at a place that no value ends at. */
static const char *json_end(const char *at)
{
    static const char bad[] = "?";
    const char open = *at;
    char *end;
    if (open == '"') {
        for (at++; *at != '"'; at++)
            if ((unsigned char)*at < 0x20 || (*at == '\\' && !*++at))
                return bad;
        return skip(at + 1);
    }
    for (int i = 0; i < 3; i++) {
        static const char *const words[] = {"true", "false", "null"};
        if (strncmp(at, words[i], strlen(words[i])) == 0)
            return skip(at + strlen(words[i]));
    }
    if (open != '{' && open != '[') {
        strtod(at, &end);
        return strspn(at, "-0123456789") > 0 ? skip(end) : bad; /* strtod takes nan, too */
    }
    for (at = skip(at + 1); *at != open + 2;) { /* } and ] */
        if (open == '{') {
            at = *at == '"' ? json_end(at) : bad;
            if (*at++ != ':')
                return bad;
        }
        at = json_end(skip(at));
        if (*at == ',' && at[1] != '}' && at[1] != ']')
            at = skip(at + 1);
        else if (*at != open + 2)
            return bad;
    }
    return skip(at + 1);
}

/* ---- the same in both ---- */

/* Whether a line `key value unit` stands in JSON as "key": value, and its unit as "key": "unit". */
static int is_in(const char *json, const char *line)
{
    char key[64], value[512], unit[64], as[600], its[200] = "\"";
    int length = 0;
    if (sscanf(line, "%63s %n", key, &length) != 1 || sscanf(line + length, "%511[^\n]", value) != 1)
        return 0;
    if (strcmp(key, "knot") == 0) /* a record, of figures that stand elsewhere */
        return 1;
    if (strstr("source tool linear_in verdict", key))
        snprintf(as, sizeof as, "\"%s\": \"%s\"", key, value);
    else if (strcmp(key, "weight_bounded") == 0)
        snprintf(as, sizeof as, "\"%s\": %s", key, strcmp(value, "yes") == 0 ? "true" : "false");
    else if (sscanf(line + length, "%511s %63[^\n]", value, unit) == 2) {
        snprintf(as, sizeof as, "\"%s\": %s", key, value);
        snprintf(its, sizeof its, "\"%s\": \"%s\"", key, unit);
    } else
        return 0;
    return strstr(json, as) && strstr(json, its);
}

/* `names`, between blanks, stand in the text. */
static void test_both(const char *name, const char *names)
{
    char *text = PRINTED(NULL, "info", name), *json = PRINTED(NULL, "info", name, "--json"), key[64], line[80];
    char *quiet = PRINTED(NULL, "info", name, "-q");
    int length = 0;
    TEST(*quiet == '\0' && *json_end(json) == '\0');
    for (const char *at = text; *at; at += strcspn(at, "\n") + 1)
        if (!TEST(is_in(json, at)))
            fprintf(stderr, "  '%.100s' in %s\n", at, json);
    for (; sscanf(names, "%63s%n", key, &length) == 1; names += length) {
        snprintf(line, sizeof line, "\n%s ", key);
        TEST_HAS(text, line);
    }
    free(text);
    free(json);
    free(quiet);
}

static double number_behind(const char *text, const char *key)
{
    const char *at = strstr(text, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

/* ---- what tables are worth ---- */

static void test_verdicts(void)
{
    static const char *const moments[] = {"2", "3", "4"};
    double before = 1;
    for (int i = 0; i < 3; i++) {
        char *text = PRINTED(NULL, "build", "--slope", "exp(-r)", "--max-bytes", "4096", "--moments", moments[i],
                             "-o", "m");
        double above = number_behind(text, "\ntv_above ");
        TEST(number_behind(text, "\nmoments ") == 2 + i && above < before);
        before = above;
        TEST_NEAR(number_behind(text, "\nverdict within "), 100 * above, 0.05 * 100 * above);
        TEST(strcmp(text + strlen(text) - 15, "; good to ship\n") == 0);
        free(text);
    }
    char *poor =
        PRINTED(NULL, "build", "--slope", "exp(-r)*(1+0.9*sin(300*r))", "--max-bytes", "2048", "-q", "-o", "m");
    TEST_HAS(poor, "vndf build: within ");
    TEST_HAS(poor, "worth little at ");
    TEST_HAS(poor, "try a larger --max-bytes");
    free(poor);
}

/* check says the same in a line and in JSON, of a table and of a claim that does not hold. */
static void test_check(void)
{
    char *text = PRINTED(NULL, "check", "t", "--samples", "20000"), *quiet;
    char *json = PRINTED(NULL, "check", "t", "--samples", "20000", "--hard", "--json");
    TEST(strstr(text, "\ncertificate of tv_above ") && strstr(text, "\nchi_square alpha_x 1 ") &&
         strstr(text, "\nresult good\n"));
    TEST(*json_end(json) == '\0');
    TEST_HAS(json, "\"chi_square\": [\n    {\"alpha_x\": 1, \"alpha_y\": 1, \"theta\": 0, ");
    TEST_HAS(json, "\"of\": \"facing\"");
    TEST_HAS(json, "\"result\": \"good\"");
    quiet = PRINTED(NULL, "check", "ggx", "--samples", "1000", "-q");
    TEST(quiet && *quiet == '\0');
    free(text);
    free(json);
    free(quiet);
}

/* Rows: from straight above GGX of alpha 1 keeps 1 - log 2; a file has a line for each angle and roughness. */
static void test_albedo(void)
{
    char *text = PRINTED(NULL, "albedo", "ggx", "--alpha", "0,1", "--theta", "0,90");
    char *csv =
        PRINTED(NULL, "albedo", "ggx", "--eta", "1.5", "--alpha", "0.2,1", "--theta", "0,45,80", "-o", "-");
    const char *row = strstr(text, "\n      0 ");
    double first = NAN, second = NAN;
    int lines = 0;
    TEST_HAS(text, "ggx, mirror\n");
    TEST(row && sscanf(row, " 0 %lf %lf", &first, &second) == 2);
    TEST_NEAR(first, 1, 1e-4);
    TEST_NEAR(second, 1 - log(2), 1e-3);
    TEST_HAS(text, "\n     90   1.00000   1.00000\naverage");
    for (const char *at = csv; *at; at += strcspn(at, "\n") + 1)
        lines++;
    TEST(lines == 13 &&
         strncmp(csv, "distribution,eta,side,alpha,theta,albedo,average\n\"ggx\",1.5,1,0.2,0,", 66) == 0);
    TEST_HAS(csv, "\n\"ggx\",1.5,-1,1,80,0.");
    free(text);
    free(csv);
}

int main(void)
{
    char folder[] = "figures.XXXXXX", *built, *told, *csv;
    if (!run_begin(folder))
        return test_done();
    built = PRINTED(NULL, "build", "--slope", "exp(-k*r)", "--set", "k=2", "--break", "2", "--max-bytes", "4096",
                    "-o", "t");
    told = PRINTED(NULL, "info", "t");
    csv = PRINTED("t", "info", "-");
    TEST(strcmp(built, told) == 0 && strcmp(csv, told) == 0);
    TEST_HAS(built, "source --slope 'exp(-k*r)' --set k=2 --break 2\n");
    struct stat is;
    TEST(stat("t", &is) == 0 && number_behind(built, "\nbytes ") == (double)is.st_size && is.st_size <= 4096);
    free(built);
    free(told);
    free(csv);
    free(PRINTED(NULL, "build", "--family", "student-t", "--parameter", "1.8..3", "--knots", "2", "--max-bytes",
                 "2048", "-q", "-o", "two.vndfs"));
    test_both("ggx", "tool bytes memory cells moments normalization scale");
    test_both("t",
              "tool bytes memory cells moments normalization scale tv tv_theta tv_above tv_above_theta max_weight "
              "weight_bounded area_error consistency ndf_error hidden finest horizon_power verdict");
    test_both("two.vndfs", "knots low high linear_in distance grazing tables_tv knot verdict");
    TEST(run_put("rows.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n"));
    csv = PRINTED("rows.csv", "build", "--csv", "-", "-o", "c");
    TEST_HAS(csv, "source --csv stdin (crc32 ");
    free(csv);
    TEST(run_put("rows.csv", "0,0,1\n0,0.6,0.8\n"));
    csv = PRINTED("rows.csv", "eval", "ggx", "--theta", "0", "--json");
    TEST(*json_end(csv) == '\0');
    TEST_HAS(csv, "{\"ndf\": 0.3183098");
    TEST_HAS(csv, "\"values.pdf\": \"per steradian\"");
    free(csv);
    test_verdicts();
    test_check();
    test_albedo();
    TEST(remove("t") == 0 && remove("m") == 0 && remove("c") == 0 && remove("rows.csv") == 0);
    TEST(remove("two.vndfs") == 0);
    return run_end(folder);
}
