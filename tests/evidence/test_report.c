/* `vndf report` writes a page that is well-formed and needs nothing else, with its data beside it, for a D with a jump
 * and for a CSV; a signal or a full disk leaves nothing behind (what is refused: test_cli). With VNDF_TEST_QUICK one
 * page is written instead of two. */
#include "harness/run_program.h"

#include "command.h"

/* ---- the page ---- */

/* Every tag closed in its order, every attribute in quotes, every & an entity. */
static int is_well_formed(const char *at)
{
    enum { DEPTH_MAX = 64 };
    char stack[DEPTH_MAX][16], name[16];
    int depth = 0, good = 1;
    while (good && *(at += strcspn(at, "<&")) != '\0') {
        const int is_end = at[1] == '/';
        if (*at == '&') {
            at += 1 + strspn(at + 1, "abcdefghijklmnopqrstuvwxyz#0123456789");
            good = *at == ';';
            continue;
        }
        if (sscanf(at + 1 + is_end, "%15[a-z0-9]", name) != 1 || depth == DEPTH_MAX)
            return 0;
        at = strstr(at, name) + strlen(name);
        for (int is_quoted = 0; good && (is_quoted || *at != '>'); at++) {
            is_quoted ^= *at == '"';
            good = *at != '<' && *at != '\0' && (is_quoted || *at != '=' || at[1] == '"');
        }
        if (is_end)
            good &= depth > 0 && strcmp(stack[--depth], name) == 0;
        else if (at[-1] != '/' && strcmp(name, "meta") != 0 && strcmp(name, "br") != 0)
            strcpy(stack[depth++], name);
        if (!is_end && strcmp(name, "style") == 0 && !(at = strstr(at, "</style>")))
            return 0;
    }
    return good && depth == 0;
}

/* The files that a page links are there, begin as they have to, and hold what they have to, which is in quotes. */
static void check_page(void)
{
    static const char *const files[][13] = {
        {"page/index.html", "<!DOCTYPE html>\n", "<h2 id=\"advice\">", "<h2 id=\"frontier\">", "<h2 id=\"time\">",
         "<h2 id=\"normals\">", ": ship ", ">advised</text>", "<tr class=\"chosen\"><td>",
         "<tr class=\"group\"><th class=\"text\" colspan=\"9\">", "href=\"tables.csv\"", "href=\"methods.csv\"",
         "href=\"frontier.svg\""},
        {"page/frontier.svg", "<svg "},
        {"page/tables.csv", "distribution,file (bytes),moments,"},
        {"page/methods.csv", "distribution,method,"}};
    static const char *const never[] = {"<script", "src=", "url(", "@import", ">nan<", "nan\"", "nan "};
    for (int i = 0; i < 4; i++) {
        size_t size;
        char *text = run_file(files[i][0], &size);
        if (!TEST(text && strncmp(text, files[i][1], strlen(files[i][1])) == 0))
            return;
        TEST(i > 1 || is_well_formed(i ? text : text + strlen(files[0][1])));
        for (size_t k = 2; k < 13 && files[i][k]; k++)
            TEST_HAS(text, files[i][k]);
        double low, high; /* ticks of an axis that goes up */
        const char *tick = "end\"><tspan x=\"%*f\" y=\"%lf\">%*[^<]</tspan><tspan x=\"%*f\" y=\"%lf\"",
                   *at = strstr(text, "end\"><tspan");
        TEST(i > 1 || (at && sscanf(at, tick, &low, &high) == 2 && low > high + 1));
        for (size_t k = 0; i == 0 && k < sizeof never / sizeof *never; k++)
            TEST(!strstr(text, never[k]));
        free(text);
    }
}

/* What is advised is what `vndf build` makes. */
static void test_advice(void)
{
    char row[64], text[RUN_TEXT];
    size_t size;
    run_said(text, "vndf build --ndf 'step(c-0.5)*(1+theta)' -o built");
    snprintf(row, sizeof row, ",%lu,4,", strtoul(strstr(text, "\nbytes ") + 7, NULL, 10));
    char *tables = run_file("page/tables.csv", &size);
    TEST_HAS(tables, row);
    free(tables);
    remove("built");
}

/* ---- what stops it ---- */

static void test_stopped(void)
{
    run_line(128 + SIGINT, "interrupted", "(sleep 1; kill -s INT $$) &\nexec \"$VNDF\" report --seconds 60 page");
    TEST(run_count("page", "") == -1);
    if (test_quick())
        return;
    /* The page is larger than that, most of the data is not. */
    run_line(STATUS_USE, "cannot write", "ulimit -f 200; vndf report --family ggx --seconds 1 page");
    TEST(run_count("page", "") == -1);
}

int main(void)
{
    char scratch[] = "report-XXXXXX";
    static char text[RUN_TEXT];
    if (!run_begin(scratch))
        return test_done();
    test_stopped();
    TEST_HAS(run_said(text, "vndf report --ndf 'step(c-0.5)*(1+theta)' --seconds 1 page"), "page/index.html\n");
    TEST(run_count("page", "") == 4);
    check_page();
    test_advice();
    TEST(run_put("page/note.txt", "")); /* it is still there when the page is replaced */
    run_said(text, "cp '" VNDF_SOURCE_DIR "/tables/example.csv' 'a&<b>.csv'"); /* a name that HTML has to escape */
    if (!test_quick()) {
        TEST_HAS(run_said(text, "vndf report --csv 'a&<b>.csv' --with beckmann --seconds=1 page"),
                 "replaced the report in ");
        check_page();
    }
    TEST(run_count("page", "") == 5 && system("rm -r page *.csv") == 0);
    return run_end(scratch);
}
