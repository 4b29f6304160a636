/* Figures have names and units: build and info print the same lines, --json the same numbers in JSON, -q nothing; the
 * verdict is the last of them, and a table that is worth little is told of on stderr too; check fails a table whose
 * certificate says less than is true. It notices a figure without a unit, JSON that does not parse, a verdict that
 * praises a poor table, and a check that forgives. */
#include "harness/run_program.h"

#include "harness/damage.h"

/* Whether brackets are closed, a comma stands between them, nothing behind the last one, and nothing is nan or inf. */
static int is_json(const char *text)
{
    int depth = 0, is_good = *text == '{' || *text == '[';
    for (char before = ' '; *text; before = strchr(" \n", *text) ? before : *text, text++) {
        if (*text == '"')
            for (text++; *text && *text != '"'; text++)
                text += *text == '\\';
        is_good &= !strchr("}]", *text) || before != ',';
        is_good &= !strchr("{[", *text) || strchr(" {[,:", before) != NULL;
        is_good &= strncmp(text, "nan", 3) != 0 && strncmp(text, "inf", 3) != 0 && *text;
        depth += (*text == '{' || *text == '[') - (*text == '}' || *text == ']');
    }
    return is_good && depth == 0;
}

/* Whether a line `key value unit` stands in JSON as "key": value, and its unit as "key": "unit". */
static int is_in(const char *json, const char *line)
{
    char key[64], value[512], as[700];
    if (sscanf(line, "%63s %511[^\n]", key, value) != 2)
        return 0;
    snprintf(as, sizeof as, "\"%s\": ", key);
    const char *at = strstr(json, as);
    at = at ? at + strlen(as) : "";
    const size_t number = strcspn(value, " ");
    snprintf(as, sizeof as, "\"%s\": \"%s\"", key, value[number] ? value + number + 1 : "");
    switch (*at) {
    case '[': return strcmp(key, "knot") == 0; /* of figures that stand elsewhere */
    case '"': return strncmp(at + 1, value, strlen(value)) == 0;
    case 't': return strcmp(value, "yes") == 0;
    case 'f': return strcmp(value, "no") == 0;
    default: return strncmp(at, value, number) == 0 && strstr(json, as);
    }
}

static char text[RUN_TEXT], json[RUN_TEXT];

/* `keys`, between blanks, stand in what info prints. */
static void test_both(const char *name, const char *keys)
{
    char key[64], line[66];
    int length = 0;
    TEST(is_json(run_said(json, "vndf info %s --json", name)));
    for (const char *at = run_said(text, "vndf info %s", name); *at; at += strcspn(at, "\n") + 1)
        if (!TEST(is_in(json, at)))
            fprintf(stderr, "  '%.100s' in %s\n", at, json);
    for (; sscanf(keys, "%63s%n", key, &length) == 1; keys += length) {
        snprintf(line, sizeof line, "\n%s ", key);
        TEST_HAS(text, line);
    }
    TEST(*run_said(json, "vndf info %s -q", name) == '\0');
}

static double number_behind(const char *key)
{
    const char *at = strstr(text, key);
    return at ? strtod(at + strlen(key), NULL) : NAN;
}

/* check says the same in a line and in JSON. */
static void test_check(void)
{
    run_said(text, "vndf check t --samples 20000");
    TEST(strstr(text, "\ncertificate of tv_above ") && strstr(text, "\nchi_square alpha_x 1 ") &&
         strstr(text, "\nresult good\n"));
    TEST(is_json(run_said(text, "vndf check t --samples 20000 --hard --json")));
    TEST_HAS(text, "\"chi_square\": [\n    {\"alpha_x\": 1, \"alpha_y\": 1, \"theta\": 0, ");
    TEST(strstr(text, "\"of\": \"facing\"") && strstr(text, "\"result\": \"good\""));
    TEST(*run_said(text, "vndf check ggx --samples 1000 -q") == '\0');
}

/* A certificate that says 0.62 of what is true fails, whichever figure says it. */
static void test_false(void)
{
    static const int figures[] = {0, 2, 4, 6, 8}; /* tv, tv_above, max_weight, area_error, ndf_error */
    static unsigned char bytes[DAMAGE_BYTES_MAX];
    vndf_distribution *table = vndf_load("t", NULL);
    const vndf_certificate claim = vndf_distribution_info(table).certificate;
    const float *number = &claim.tv;
    size_t size = read_bytes("t", bytes, sizeof bytes), at = 0;
    while (at + sizeof claim < size && memcmp(bytes + at, &claim, sizeof claim) != 0)
        at++;
    for (int i = 0; i < 5; i++) {
        const float less = 0.62f * number[figures[i]];
        memcpy(bytes + at, &claim, sizeof claim);
        memcpy(bytes + at + sizeof less * (size_t)figures[i], &less, sizeof less);
        mend_checksum(bytes, size);
        FILE *file = fopen("false", "wb");
        TEST(file && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
        run_line(1, "result FAILED", "vndf check false --samples 1000");
    }
    vndf_free(table);
}

int main(void)
{
    static const char keys[] =
        "tv tv_theta tv_above tv_above_theta max_weight weight_bounded area_error consistency ndf_error hidden finest "
        "horizon_power floor_above floor verdict tool bytes memory cells moments normalization scale";
    char folder[] = "figures.XXXXXX";
    struct stat is;
    if (!run_begin(folder))
        return test_done();
    run_said(text, "vndf build --slope 'exp(-k*r)' --set k=2 --max-bytes 4096 -o t");
    TEST_HAS(text, "source --slope 'exp(-k*r)' --set k=2\n");
    TEST(stat("t", &is) == 0 && number_behind("\nbytes ") == (double)is.st_size && is.st_size <= 4096);
    TEST(strcmp(text, run_said(json, "vndf info t")) == 0 && strcmp(text, run_said(json, "vndf info - <t")) == 0);
    run_said(json, "vndf build --family student-t --parameter 1.8..3 --knots 2 --max-bytes 2048 -q -o two.vndfs");
    test_both("ggx", strstr(keys, "tool"));
    test_both("t", keys);
    run_said(text, "vndf build --family phong --parameter 2..200 --knots 2 --max-bytes 2048 -q -o far.vndfs");
    TEST_HAS(text, "doubtful: mixtures are worth little: try more --knots");
    test_both("two.vndfs", "knots low high linear_in distance grazing tables_tv knot verdict");
    TEST(run_put("rows.csv", "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n"));
    TEST_HAS(run_said(text, "vndf build --csv - -o c <rows.csv"), "source --csv stdin (crc32 ");
    run_said(text, "vndf build --slope 'exp(-r)*(1+0.9*sin(300*r))' --max-bytes 2048 -o - 2>&1 >m");
    TEST_HAS(text, "vndf build: within ");
    TEST(strstr(text, "doubtful: worth little at ") && strstr(text, "try a larger --max-bytes"));
    test_check();
    test_false();
    TEST(system("rm t m c false rows.csv two.vndfs far.vndfs") == 0);
    return run_end(folder);
}
