/* `vndf report` writes a page that is well-formed and needs nothing else, with the data behind each plot beside
 * it, for a D with a jump and for a CSV; what is not a report is not replaced, and a signal leaves nothing behind.
 * With VNDF_TEST_QUICK one page is written instead of two. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include <dirent.h>
#  include <fcntl.h>
#  include <signal.h>
#  include <stdlib.h>
#  include <sys/resource.h>
#  include <sys/stat.h>
#  include <sys/wait.h>
#  include <time.h>
#  include <unistd.h>

#  include "command.h"
#  include "cli/output.h"

enum { PATH_SIZE = 512, WORDS_OF_RUN = 12, DEPTH_MAX = 64 };

/* ---- running ---- */

typedef struct outcome {
    int status;      /* of waitpid */
    char text[8192]; /* stdout and stderr */
} outcome;

static void read_all(int from, char *text, size_t size)
{
    size_t length = 0;
    ssize_t got;
    while (length + 1 < size && (got = read(from, text + length, size - 1 - length)) > 0)
        length += (size_t)got;
    text[length] = '\0';
}

/* How a run is to fail. */
typedef struct trouble {
    long milliseconds; /* until SIGINT comes; 0: never */
    rlim_t file_limit; /* bytes of a file: a full disk; 0: none */
} trouble;

static const trouble none = {0, 0};

/* `vndf report words...` in a child. */
static outcome run(const char *const *words, trouble t)
{
    outcome result = {-1, ""};
    int channel[2];
    if (!TEST(pipe(channel) == 0))
        return result;
    pid_t child = fork();
    if (child == 0) {
        char *argv[WORDS_OF_RUN + 1] = {NULL};
        int argc = 0;
        for (; words[argc] && argc < WORDS_OF_RUN; argc++)
            argv[argc] = (char *)(size_t)(const void *)words[argc];
        struct rlimit limit = {t.file_limit, t.file_limit};
        output_ignore_size_signal();
        if (t.file_limit)
            setrlimit(RLIMIT_FSIZE, &limit);
        dup2(channel[1], 1);
        dup2(channel[1], 2);
        close(channel[0]);
        int status = command_report(argc, argv);
        fflush(stdout);
        _exit(status);
    }
    close(channel[1]);
    if (t.milliseconds) {
        struct timespec wait = {t.milliseconds / 1000, t.milliseconds % 1000 * 1000000};
        nanosleep(&wait, NULL);
        kill(child, SIGINT);
    }
    read_all(channel[0], result.text, sizeof result.text);
    close(channel[0]);
    waitpid(child, &result.status, 0);
    return result;
}

static int ended_with(const outcome *o, int status)
{
    return WIFEXITED(o->status) && WEXITSTATUS(o->status) == status;
}

/* ---- files ---- */

static char *read_file(const char *folder, const char *name)
{
    char path[PATH_SIZE];
    struct stat status;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file || stat(path, &status) != 0)
        return NULL;
    char *text = calloc(1, (size_t)status.st_size + 1);
    if (text && fread(text, 1, (size_t)status.st_size, file) != (size_t)status.st_size)
        text[0] = '\0';
    fclose(file);
    return text;
}

/* Without . and .. */
static int count_entries(const char *folder)
{
    DIR *directory = opendir(folder);
    const struct dirent *entry;
    int count = 0;
    if (!directory)
        return -1;
    while ((entry = readdir(directory)) != NULL)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return count;
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

/* The number of fields of the line at *at, moved past it; 0 if quotes do not match. */
static int count_fields(const char **at)
{
    int fields = 1, quoted = 0;
    for (; **at && (quoted || **at != '\n'); ++*at) {
        quoted ^= **at == '"';
        fields += !quoted && **at == ',';
    }
    *at += **at == '\n';
    return quoted ? 0 : fields;
}

/* A header and rows of as many fields, the last of each row a number or empty. */
static int is_table(const char *text)
{
    const char *at = text;
    int columns = count_fields(&at), rows = 0;
    while (*at) {
        if (count_fields(&at) != columns)
            return 0;
        const char *last = at - 1;
        while (last > text && last[-1] != ',')
            last--;
        char *end;
        strtod(last, &end);
        if (*end != '\n' && strncmp(last, "inf", 3) != 0)
            return 0;
        rows++;
    }
    return columns > 1 && rows > 0;
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

/* As a number, not in "nanoseconds". */
static int has_nan(const char *text)
{
    while ((text = skip(text, "nan")) != NULL)
        if (*text != 'o')
            return 1;
    return 0;
}

static void check_page(const char *folder)
{
    static const char *const sections[] = {"advice", "frontier", "bytes", "theta", "normals", "variance", "time"};
    char *page = read_file(folder, "index.html"), *alone = read_file(folder, "frontier.svg");
    if (!TEST(page && alone))
        return;
    TEST(strncmp(page, "<!DOCTYPE html>\n", 16) == 0);
    TEST(is_well_formed(page + 16));
    TEST(is_well_formed(alone));
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) {
        char head[64];
        snprintf(head, sizeof head, "<section id=\"%s\">", sections[i]);
        TEST_HAS(page, head);
    }
    TEST_HAS(page, "ship the table of");
    TEST(!strstr(page, "<script") && !strstr(page, "src=") && !strstr(page, "url(") && !strstr(page, "@import"));
    TEST(!has_nan(page) && !has_nan(alone));
    TEST(count_linked(folder, page) == 9);
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
    TEST(!is_table("a,b\n1,x\n"));
    TEST(!is_table("a,b\n\"1,2\n"));
}

static void test_page(const char *folder, const char *option, const char *value)
{
    const char *words[] = {option, value, "--seconds", "1", folder, NULL};
    outcome o = run(words, none);
    TEST(ended_with(&o, STATUS_GOOD));
    TEST_HAS(o.text, "/index.html\n");
    TEST(count_entries(folder) == 11);
    check_page(folder);
}

static void test_replaced(const char *folder)
{
    const char *words[] = {"--csv", VNDF_SOURCE_DIR "/tables/example.csv", "--seconds=1", folder, NULL};
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/note.txt", folder);
    close(open(path, O_WRONLY | O_CREAT, 0666));
    outcome o = run(words, none);
    TEST(ended_with(&o, STATUS_GOOD));
    TEST_HAS(o.text, "replaced the report in ");
    TEST(count_entries(folder) == 12); /* the note is still there */
    check_page(folder);
}

static void test_refused(const char *folder)
{
    const char *foreign[] = {folder, NULL}, *file[] = {VNDF_SOURCE_DIR "/tables/example.csv", NULL};
    const char *two[] = {"--ndf", "c", "--slope", "exp(-r)", "x", NULL}, *nothing[] = {NULL};
    const char *bad[] = {"--slope", "exp(-r", "no-such-folder", NULL}, *deep[] = {"no-such-folder/x", NULL};
    const char *set[] = {"--family", "ggx", "--set", "k=1", "x", NULL};
    const char *const *all[] = {foreign, file, two, nothing, bad, set};
    const char *const reasons[] = {"has files in it, and no page of",
                                   "is no folder",
                                   "more than one of",
                                   "DIR is missing",
                                   "column",
                                   "--set is for"};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        outcome o = run(all[i], none);
        TEST(ended_with(&o, STATUS_USE));
        TEST_HAS(o.text, reasons[i]);
    }
    outcome o = run(deep, none);
    TEST(ended_with(&o, STATUS_USE)); /* before anything is measured */
    TEST_HAS(o.text, "no-such-folder");
    TEST(count_entries("no-such-folder") == -1 && count_entries("x") == -1);
    TEST(count_entries(folder) == 1);
}

static void test_interrupted(const char *folder)
{
    const char *words[] = {"--seconds", "60", folder, NULL};
    outcome o = run(words, (trouble){1000, 0});
    TEST(WIFSIGNALED(o.status) && WTERMSIG(o.status) == SIGINT);
    TEST_HAS(o.text, "interrupted");
    TEST(count_entries(folder) == -1);
}

/* The page is larger than that, most of the data is not. */
static void test_full_disk(const char *folder)
{
    const char *words[] = {"--family", "ggx", "--seconds", "1", folder, NULL};
    outcome o = run(words, (trouble){0, 100000});
    TEST(ended_with(&o, STATUS_USE));
    TEST_HAS(o.text, "cannot write");
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
