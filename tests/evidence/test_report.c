/* `vndf report` writes a page that is well-formed and needs nothing else, with its data beside it, for a D with a jump
 * and for a CSV; what is not a report is not replaced, and a signal or a full disk leaves nothing behind. With
 * VNDF_TEST_QUICK one page is written instead of two. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include "command.h"
#  include "harness/run_program.h"

/* ---- the page ---- */

/* Past the attributes of a tag, at its >: name="value", no < inside. NULL if that is not so. */
static const char *skip_attributes(const char *at)
{
    for (; *at != '>'; at++) {
        if (*at == '"')
            at += 1 + strcspn(at + 1, "\"<");
        if (*at == '\0' || *at == '<' || (*at == '=' && at[1] != '"'))
            return NULL;
    }
    return at;
}

/* Every tag closed in its order, every attribute in quotes, every & an entity. */
static int is_well_formed(const char *at)
{
    enum { DEPTH_MAX = 64 };
    char stack[DEPTH_MAX][16], name[16];
    int depth = 0;
    while (*(at += strcspn(at, "<&")) != '\0') {
        if (*at == '&') {
            at += 1 + strspn(at + 1, "abcdefghijklmnopqrstuvwxyz#0123456789");
            if (*at != ';')
                return 0;
            continue;
        }
        int is_end = at[1] == '/';
        if (sscanf(at + 1 + is_end, "%15[a-z0-9]", name) != 1 || depth == DEPTH_MAX)
            return 0;
        at = skip_attributes(at + 1 + is_end + strlen(name));
        if (!at || (is_end && (depth == 0 || strcmp(stack[--depth], name) != 0)))
            return 0;
        if (!is_end && at[-1] != '/' && strcmp(name, "meta") != 0 && strcmp(name, "br") != 0)
            strcpy(stack[depth++], name);
        if (!is_end && strcmp(name, "style") == 0 && !(at = strstr(at, "</style>")))
            return 0;
    }
    return depth == 0;
}

/* A file in the folder of the page, to be freed. */
static char *read_page_file(const char *name)
{
    char path[128];
    size_t size;
    snprintf(path, sizeof path, "page/%s", name);
    return run_file(path, &size);
}

/* The files that a page links are there, and begin as they have to. */
static void check_page(void)
{
    static const char *const parts[] = {"<h2 id=\"advice\">",
                                        "<h2 id=\"frontier\">",
                                        "<h2 id=\"time\">",
                                        "<h2 id=\"normals\">",
                                        ": ship ",
                                        "moments.</strong>",
                                        ">advised</text>",
                                        "student-t:2.5",
                                        "href=\"tables.csv\"",
                                        "href=\"methods.csv\"",
                                        "href=\"frontier.svg\""};
    static const char *const never[] = {"<script", "src=", "url(", "@import", ">nan<", "nan\"", "nan "};
    char *page = read_page_file("index.html"), *alone = read_page_file("frontier.svg"),
         *tables = read_page_file("tables.csv"), *methods = read_page_file("methods.csv");
    if (!TEST(page && alone && tables && methods))
        return;
    TEST(strncmp(page, "<!DOCTYPE html>\n", 16) == 0 && is_well_formed(page + 16) && is_well_formed(alone));
    TEST(strncmp(tables, "file (bytes),moments,", 21) == 0 && strncmp(methods, "method,distribution,", 20) == 0);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        TEST_HAS(page, parts[i]);
    for (size_t i = 0; i < sizeof never / sizeof *never; i++)
        TEST(!strstr(page, never[i]));
    free(page);
    free(alone);
    free(tables);
    free(methods);
}

/* ---- the tests ---- */

static void test_checker(void)
{
    static const char *const bad[] = {"<p><b></p></b>",  "<p>",          "</p>",
                                      "<p class=a></p>", "<p>x & y</p>", "<p a=\"<\"></p>"};
    TEST(is_well_formed("<p class=\"a\">x &amp; y<br><b/></p>"));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        TEST(!is_well_formed(bad[i]));
}

static void test_replaced(void)
{
    TEST(run_put("page/note.txt", "") && run_count("page", "") == 5);
    const run_outcome *o =
        run_line(&run_plain, "report --csv " VNDF_SOURCE_DIR "/tables/example.csv --seconds=1 page");
    TEST(o->status == STATUS_GOOD);
    TEST_HAS(o->text, "replaced the report in ");
    TEST(run_count("page", "") == 5); /* the note is still there */
    check_page();
}

static void test_refused(void)
{
    static const char *const cases[][2] = {
        {"has files in it, and no page of", "report other"},
        {"is no folder", "report " VNDF_SOURCE_DIR "/tables/example.csv"},
        {"--ndf and --slope are given", "report --ndf c --slope exp(-r) x"},
        {"DIR is missing", "report"},
        {"column", "report --slope exp(-r x"},
        {"--set is for", "report --family ggx --set k=1 x"},
        {"no-such-folder", "report no-such-folder/x"}, /* before anything is measured */
    };
    TEST(mkdir("other", 0777) == 0 && run_put("other/file.txt", ""));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const run_outcome *o = run_line(&run_plain, cases[i][1]);
        TEST(o->status == STATUS_USE);
        TEST_HAS(o->text, cases[i][0]);
    }
    TEST(run_count("x", "") == -1 && run_count("other", "") == 1);
    TEST(remove("other/file.txt") == 0 && rmdir("other") == 0);
}

static void test_interrupted(void)
{
    run_child c = run_start(&run_plain, RUN_LIST("report", "--seconds", "60", "page"));
    run_pause(1000);
    kill(c.pid, SIGINT);
    const run_outcome *o = run_finish(c);
    TEST(o->signal == SIGINT);
    TEST_HAS(o->text, "interrupted");
    TEST(run_count("page", "") == -1);
}

/* The page is larger than that, most of the data is not. */
static void test_full_disk(void)
{
    const run_setting full = {.file_limit = 100000};
    const run_outcome *o = run_line(&full, "report --family ggx --seconds 1 page");
    TEST(o->status == STATUS_USE);
    TEST_HAS(o->text, "cannot write");
    TEST(run_count("page", "") == -1);
}

int main(void)
{
    char scratch[] = "report-XXXXXX";
    if (!run_begin(scratch))
        return test_done();
    test_checker();
    test_interrupted();
    test_refused();
    if (!test_quick())
        test_full_disk();
    const run_outcome *o = run_line(&run_plain, "report --ndf step(c-0.5)*(1+theta) --seconds 1 page");
    TEST(o->status == STATUS_GOOD && run_count("page", "") == 4);
    TEST_HAS(o->text, "page/index.html\n");
    check_page();
    if (!test_quick())
        test_replaced();
    static const char *const files[] = {"index.html", "tables.csv", "methods.csv", "frontier.svg", "note.txt"};
    for (size_t i = 0; i < sizeof files / sizeof *files && chdir("page") == 0; i++)
        TEST((remove(files[i]) == 0 || i == 4) && chdir("..") == 0);
    TEST(rmdir("page") == 0);
    return run_end(scratch);
}

#else

int main(void)
{
    puts("SKIPPED: no processes on this system");
    return 0;
}

#endif
