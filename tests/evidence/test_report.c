/* `vndf report` writes a page that is well-formed and needs nothing else, with the data behind each plot beside
 * it, for a D with a jump and for a CSV; what is not a report is not replaced, and a signal leaves nothing behind.
 * With VNDF_TEST_QUICK one page is written instead of two. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include "command.h"
#  include "harness/run_program.h"

enum { PATH_SIZE = 512, DEPTH_MAX = 64 };

/* ---- files ---- */

static char *read_file(const char *folder, const char *name)
{
    char path[PATH_SIZE];
    size_t size;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return run_file(path, &size);
}

static void make_file(const char *folder, const char *name)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    close(open(path, O_WRONLY | O_CREAT, 0666));
}

static void remove_folder(const char *folder)
{
    DIR *directory = opendir(folder);
    const struct dirent *entry;
    while (directory && (entry = readdir(directory)) != NULL) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        unlink(path);
    }
    if (directory)
        closedir(directory);
    rmdir(folder);
}

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

/* ---- the data ---- */

/* A header and rows of as many fields; commas inside quotes divide none. */
static int is_table(const char *text)
{
    int columns = 0, fields = 1, quoted = 0, rows = 0;
    for (; *text; text++) {
        quoted ^= *text == '"';
        fields += !quoted && *text == ',';
        if (quoted || *text != '\n')
            continue;
        if (columns && fields != columns)
            return 0;
        columns = fields;
        fields = 1;
        rows++;
    }
    return columns > 1 && rows > 1 && !quoted;
}

/* Every file that the page links is there, and those named .csv parse. */
static int count_linked(const char *folder, const char *page)
{
    char name[64];
    int count = 0;
    for (const char *at = page; (at = strstr(at, "href=\"")) != NULL; at++) {
        if (sscanf(at + 6, "%63[^\"]", name) != 1 || name[0] == '#' || strncmp(name, "data:", 5) == 0)
            continue;
        char *text = read_file(folder, name);
        int is_csv = strstr(name, ".csv") != NULL;
        if (!TEST(text && (!is_csv || is_table(text))))
            fprintf(stderr, "  %s is no table\n", name);
        count += is_csv;
        free(text);
    }
    return count;
}

static void check_page(const char *folder)
{
    static const char *const parts[] = {
        "<h2 id=\"advice\">", "<h2 id=\"frontier\">", "<h2 id=\"time\">", "<h2 id=\"normals\">", ": ship ",
        "moments.</strong>",  ">advised</text>",      "student-t:2.5"};
    static const char *const never[] = {"<script", "src=", "url(", "@import", ">nan<", "nan\"", "nan "};
    char *page = read_file(folder, "index.html"), *alone = read_file(folder, "frontier.svg");
    if (!TEST(page && alone))
        return;
    TEST(strncmp(page, "<!DOCTYPE html>\n", 16) == 0 && is_well_formed(page + 16) && is_well_formed(alone));
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        TEST_HAS(page, parts[i]);
    for (size_t i = 0; i < sizeof never / sizeof *never; i++)
        TEST(!strstr(page, never[i]));
    TEST(count_linked(folder, page) == 2);
    free(page);
    free(alone);
}

/* ---- the tests ---- */

static void test_checkers(void)
{
    TEST(is_well_formed("<p class=\"a\">x &amp; y<br><b/></p>"));
    TEST(!is_well_formed("<p><b></p></b>"));
    TEST(!is_well_formed("<p>"));
    TEST(!is_well_formed("</p>"));
    TEST(!is_well_formed("<p class=a></p>"));
    TEST(!is_well_formed("<p>x & y</p>"));
    TEST(!is_well_formed("<p a=\"<\"></p>"));
    TEST(is_table("a,b\n\"x,\"\"y\"\"\",1e-3\n"));
    TEST(!is_table("a,b\n"));
    TEST(!is_table("a,b\n1\n"));
    TEST(!is_table("a,b\n\"1,2\n"));
}

static void test_page(const char *folder, const char *option, const char *value)
{
    const char *words[] = {"report", option, value, "--seconds", "1", folder, NULL};
    const run_outcome *o = run_program(&run_plain, words);
    TEST(o->status == STATUS_GOOD);
    TEST_HAS(o->text, "/index.html\n");
    TEST(run_count(folder, "") == 4);
    check_page(folder);
}

static void test_replaced(const char *folder)
{
    const char *words[] = {"report", "--csv", VNDF_SOURCE_DIR "/tables/example.csv", "--seconds=1", folder, NULL};
    make_file(folder, "note.txt");
    const run_outcome *o = run_program(&run_plain, words);
    TEST(o->status == STATUS_GOOD);
    TEST_HAS(o->text, "replaced the report in ");
    TEST(run_count(folder, "") == 5); /* the note is still there */
    check_page(folder);
}

static void test_refused(const char *folder)
{
    const struct {
        const char *reason, *words[8];
    } cases[] = {
        {"has files in it, and no page of", {"report", folder}},
        {"is no folder", {"report", VNDF_SOURCE_DIR "/tables/example.csv"}},
        {"more than one of", {"report", "--ndf", "c", "--slope", "exp(-r)", "x"}},
        {"DIR is missing", {"report"}},
        {"column", {"report", "--slope", "exp(-r", "no-such-folder"}},
        {"--set is for", {"report", "--family", "ggx", "--set", "k=1", "x"}},
        {"no-such-folder", {"report", "no-such-folder/x"}}, /* before anything is measured */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const run_outcome *o = run_program(&run_plain, cases[i].words);
        TEST(o->status == STATUS_USE);
        TEST_HAS(o->text, cases[i].reason);
    }
    TEST(run_count("no-such-folder", "") == -1 && run_count("x", "") == -1);
    TEST(run_count(folder, "") == 1);
}

static void test_interrupted(const char *folder)
{
    const char *words[] = {"report", "--seconds", "60", folder, NULL};
    run_child c = run_start(&run_plain, words);
    run_pause(1000);
    kill(c.pid, SIGINT);
    const run_outcome *o = run_finish(c);
    TEST(o->signal == SIGINT);
    TEST_HAS(o->text, "interrupted");
    TEST(run_count(folder, "") == -1);
}

/* The page is larger than that, most of the data is not. */
static void test_full_disk(const char *folder)
{
    const char *words[] = {"report", "--family", "ggx", "--seconds", "1", folder, NULL};
    const run_setting full = {.file_limit = 100000};
    const run_outcome *o = run_program(&full, words);
    TEST(o->status == STATUS_USE);
    TEST_HAS(o->text, "cannot write");
    TEST(run_count(folder, "") == -1);
}

int main(void)
{
    char scratch[] = "report-XXXXXX", path[PATH_SIZE];
    int quick = test_quick();
    if (!TEST(mkdtemp(scratch) != NULL))
        return test_done();
    test_checkers();
    snprintf(path, sizeof path, "%s/page", scratch);
    test_interrupted(path);
    if (!quick)
        test_full_disk(path);
    test_page(path, "--ndf", "step(c-0.5)*(1+theta)");
    if (!quick)
        test_replaced(path);
    remove_folder(path);
    mkdir(path, 0777);
    make_file(path, "other.txt");
    test_refused(path);
    remove_folder(path);
    rmdir(scratch);
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: no processes on this system");
    return 0;
}

#endif
