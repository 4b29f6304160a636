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

static int count_entries(const char *folder)
{
    return run_count(folder, "");
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

static const char *skip(const char *text, const char *past)
{
    const char *found = strstr(text, past);
    return found ? found + strlen(past) : NULL;
}

static int is_void(const char *name)
{
    return strcmp(name, "meta") == 0 || strcmp(name, "br") == 0;
}

/* Past the attributes of a tag: name="value", no < inside. *closed: it ends in />. NULL if that is not so. */
static const char *skip_attributes(const char *at, int *closed)
{
    *closed = 0;
    for (;;) {
        at += strspn(at, " \n");
        if (*at == '>')
            return at + 1;
        if (at[0] == '/' && at[1] == '>') {
            *closed = 1;
            return at + 2;
        }
        size_t name = strspn(at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789:-");
        if (name == 0 || at[name] != '=' || at[name + 1] != '"')
            return NULL;
        at += name + 2;
        at += strcspn(at, "\"<");
        if (*at++ != '"')
            return NULL;
    }
}

typedef char tag_name[16];

static const char *read_name(const char *at, tag_name name)
{
    size_t length = strspn(at, "abcdefghijklmnopqrstuvwxyz123456");
    if (length == 0 || length >= sizeof(tag_name))
        return NULL;
    memcpy(name, at, length);
    name[length] = '\0';
    return at + length;
}

/* Past the tag at `at`; opens and closes on the stack. NULL if it does not fit. */
static const char *take_tag(const char *at, tag_name stack[DEPTH_MAX], int *depth)
{
    int closed, closing = at[1] == '/';
    tag_name name;
    at = read_name(at + 1 + closing, name);
    if (at && closing)
        return *depth > 0 && strcmp(stack[--*depth], name) == 0 && *at == '>' ? at + 1 : NULL;
    at = at ? skip_attributes(at, &closed) : NULL;
    if (at && strcmp(name, "style") == 0)
        return skip(at, "</style>");
    if (at && !closed && !is_void(name)) {
        if (*depth == DEPTH_MAX)
            return NULL;
        strcpy(stack[(*depth)++], name);
    }
    return at;
}

/* Every tag closed in its order, every attribute in quotes, every & an entity. */
static int is_well_formed(const char *text)
{
    tag_name stack[DEPTH_MAX];
    int depth = 0;
    while (text && *(text += strcspn(text, "<&")) != '\0') {
        if (*text == '<')
            text = take_tag(text, stack, &depth);
        else
            text += strspn(text + 1, "abcdefghijklmnopqrstuvwxyz#0123456789") + 1;
        if (text && text[-1] != '>' && *text != ';')
            text = NULL;
    }
    return text && depth == 0;
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

/* Every file that the page links is there; those named .csv parse, and their text stands in the page. */
static int count_linked(const char *folder, const char *page)
{
    int count = 0;
    for (const char *at = page; (at = skip(at, "href=\"")) != NULL;) {
        char name[64] = "";
        size_t length = strcspn(at, "\"");
        if (*at == '#' || strncmp(at, "data:", 5) == 0 || length >= sizeof name)
            continue;
        memcpy(name, at, length);
        char *text = read_file(folder, name);
        TEST(text != NULL);
        int is_csv = strcmp(name + strlen(name) - 4, ".csv") == 0;
        if (text && is_csv && !TEST(is_table(text)))
            fprintf(stderr, "%s is no table\n", name);
        count += is_csv;
        free(text);
    }
    return count;
}

static void check_page(const char *folder)
{
    static const char *const sections[] = {"advice", "frontier", "theta", "time", "normals"};
    char *page = read_file(folder, "index.html"), *alone = read_file(folder, "frontier.svg");
    if (!TEST(page && alone))
        return;
    TEST(strncmp(page, "<!DOCTYPE html>\n", 16) == 0);
    TEST(is_well_formed(page + 16));
    TEST(is_well_formed(alone));
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) {
        char head[64];
        snprintf(head, sizeof head, "<h2 id=\"%s\">", sections[i]);
        TEST_HAS(page, head);
    }
    TEST_HAS(page, ": ship ");
    TEST_HAS(page, "moments.</strong>");
    TEST_HAS(page, ">advised</text>");
    TEST(!strstr(page, "<script") && !strstr(page, "src=") && !strstr(page, "url(") && !strstr(page, "@import"));
    TEST(!strstr(page, ">nan<") && !strstr(page, "nan\"") && !strstr(page, "nan "));
    TEST(count_linked(folder, page) == 4);
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
    TEST(count_entries(folder) == 6);
    check_page(folder);
}

static void test_replaced(const char *folder)
{
    const char *words[] = {"report", "--csv", VNDF_SOURCE_DIR "/tables/example.csv", "--seconds=1", folder, NULL};
    char path[PATH_SIZE + 16];
    snprintf(path, sizeof path, "%s/note.txt", folder);
    close(open(path, O_WRONLY | O_CREAT, 0666));
    const run_outcome *o = run_program(&run_plain, words);
    TEST(o->status == STATUS_GOOD);
    TEST_HAS(o->text, "replaced the report in ");
    TEST(count_entries(folder) == 7); /* the note is still there */
    check_page(folder);
}

static void test_refused(const char *folder)
{
    const char *foreign[] = {"report", folder, NULL},
               *file[] = {"report", VNDF_SOURCE_DIR "/tables/example.csv", NULL};
    const char *two[] = {"report", "--ndf", "c", "--slope", "exp(-r)", "x", NULL}, *nothing[] = {"report", NULL};
    const char *bad[] = {"report", "--slope", "exp(-r", "no-such-folder", NULL},
               *deep[] = {"report", "no-such-folder/x", NULL};
    const char *set[] = {"report", "--family", "ggx", "--set", "k=1", "x", NULL};
    const char *const *all[] = {foreign, file, two, nothing, bad, set};
    const char *const reasons[] = {"has files in it, and no page of",
                                   "is no folder",
                                   "more than one of",
                                   "DIR is missing",
                                   "column",
                                   "--set is for"};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const run_outcome *o = run_program(&run_plain, all[i]);
        TEST(o->status == STATUS_USE);
        TEST_HAS(o->text, reasons[i]);
    }
    const run_outcome *o = run_program(&run_plain, deep);
    TEST(o->status == STATUS_USE); /* before anything is measured */
    TEST_HAS(o->text, "no-such-folder");
    TEST(count_entries("no-such-folder") == -1 && count_entries("x") == -1);
    TEST(count_entries(folder) == 1);
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
    TEST(count_entries(folder) == -1);
}

/* The page is larger than that, most of the data is not. */
static void test_full_disk(const char *folder)
{
    const char *words[] = {"report", "--family", "ggx", "--seconds", "1", folder, NULL};
    const run_setting full = {.file_limit = 100000};
    const run_outcome *o = run_program(&full, words);
    TEST(o->status == STATUS_USE);
    TEST_HAS(o->text, "cannot write");
    TEST(count_entries(folder) == -1);
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
    strcat(path, "/other.txt");
    close(open(path, O_WRONLY | O_CREAT, 0666));
    *strrchr(path, '/') = '\0';
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
