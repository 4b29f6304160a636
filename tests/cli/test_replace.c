/* A file that is replaced keeps its mode and owner; behind symbolic links it is the file at their end, there
 * or not, that is written, and the links stay; what a crash left under a temporary's name is neither
 * overwritten nor in the way; names of 255 bytes are good; and what goes to stdout by `-o -` is the file's
 * bytes and nothing else. So it is for all outputs of the program and for vndf_save. With VNDF_TEST_QUICK `build`,
 * which saves by vndf_save, is left out. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include <dirent.h>
#  include <errno.h>

#  include "harness/run_program.h"
#  include "vndf_build.h"

enum { NOBODY = 65534, LONGEST = 255 };

static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";
static const char old_text[] = "the old file\n";

/* ---- writers ---- */

/* Words in which OUTPUT stands for the file; none: vndf_save, of the library. */
#  define OUTPUT "OUTPUT"

typedef struct writer {
    const char *ending;
    const char *words[RUN_WORDS];
} writer;

static const writer writers[] = {
    {".vndf", {NULL}},
    {".csv", {"sample", table, "--theta", "60", "-n", "5000", "-o", OUTPUT}},
    {".svg", {"plot", table, "--theta", "60", "-o", OUTPUT}},
    {".csv", {"masking", table, "-o", OUTPUT}},
    {".csv", {"albedo", "ggx", "--columns", "8", "--rows", "8", "-o", OUTPUT}},
    {".h", {"albedo", "ggx", "--columns", "8", "--rows", "8", "--c", OUTPUT}},
    {".albedo", {"albedo", "ggx", "--columns", "8", "--rows", "8", "--save", OUTPUT}},
    {".png", {"render", "ball.scene", "--spp", "1", "-o", OUTPUT}},
    {".md", {"bench", "--only", "ggx", "--seconds", "0.1", "--markdown", OUTPUT}},
    {".vndf", {"build", "--family", "ggx", "--max-bytes", "2048", "-o", OUTPUT}}, /* by vndf_save, and slow */
};

enum { WRITERS = sizeof writers / sizeof *writers };

static run_outcome saved;

static const run_outcome *save(const char *name, const char *left)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *loaded = vndf_load(table, &error);
    TEST(!left || run_leave(left));
    saved.status = loaded && vndf_save(loaded, name, &error) == VNDF_OK ? 0 : 2;
    snprintf(saved.text, sizeof saved.text, "%s", error.message);
    vndf_free(loaded);
    return &saved;
}

static const run_outcome *write_to(const writer *w, const run_setting *s, const char *name)
{
    const char *words[RUN_WORDS] = {NULL};
    for (int i = 0; i < RUN_WORDS && w->words[i]; i++)
        words[i] = strcmp(w->words[i], OUTPUT) == 0 ? name : w->words[i];
    return words[0] ? run_program(s, words) : save(name, s->left);
}

/* ---- what is there ---- */

static int is_written(const char *name)
{
    size_t size;
    char *text = run_file(name, &size);
    int good = text && size > 100 && memcmp(text, old_text, strlen(old_text)) != 0;
    free(text);
    return good;
}

static int is_link(const char *name)
{
    struct stat is;
    return lstat(name, &is) == 0 && S_ISLNK(is.st_mode);
}

static int has_mode(const char *name, mode_t mode)
{
    struct stat is;
    return stat(name, &is) == 0 && (is.st_mode & 07777) == mode;
}

/* Names in the folder that hold ".tmp"; the last of them. */
static int temporaries(const char *folder, char last[LONGEST + 1])
{
    int count = 0;
    DIR *directory = opendir(folder);
    for (struct dirent *entry; directory && (entry = readdir(directory)) != NULL;)
        if (strstr(entry->d_name, ".tmp")) {
            snprintf(last, LONGEST + 1, "%s", entry->d_name);
            count++;
        }
    if (directory)
        closedir(directory);
    return count;
}

static int leaves_nothing(void)
{
    char name[LONGEST + 1];
    return temporaries(".", name) == 0 && temporaries("folder", name) == 0;
}

static int succeeds(const writer *w, const char *name)
{
    const run_outcome *o = write_to(w, &run_plain, name);
    int good = TEST(o->status == 0) & TEST(leaves_nothing());
    if (!good)
        run_tell(w->words, o);
    return good;
}

/* ---- trials ---- */

static void test_mode(const writer *w, const char *name)
{
    static const mode_t modes[] = {0600, 0644, 0666, 0400, 0751};
    umask(022);
    TEST(succeeds(w, name) && has_mode(name, 0644));
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        umask(i % 2 ? 077 : 022);
        TEST(run_put(name, old_text) && chmod(name, modes[i]) == 0);
        TEST(succeeds(w, name) && is_written(name) && has_mode(name, modes[i]));
        remove(name);
    }
    umask(022);
}

/* Root may give a file to another, so it has to stay the other's. */
static void test_owner(const writer *w, const char *name)
{
    struct stat is;
    if (geteuid() != 0)
        return;
    TEST(run_put(name, old_text) && chown(name, NOBODY, NOBODY) == 0 && chmod(name, 0600) == 0);
    TEST(succeeds(w, name) && stat(name, &is) == 0);
    TEST(is.st_uid == NOBODY && is.st_gid == NOBODY && (is.st_mode & 07777) == 0600);
    remove(name);
}

/* A link into a folder, whose end is relative to that folder, and one to the first link. */
static void test_links(const writer *w, const char *name)
{
    char back[LONGEST + 8];
    snprintf(back, sizeof back, "../%s", "real");
    TEST(run_put("real", old_text) && chmod("real", 0640) == 0);
    TEST(symlink("folder/second", name) == 0 && symlink(back, "folder/second") == 0);
    TEST(succeeds(w, name) && is_link(name) && is_link("folder/second") && !is_link("real"));
    TEST(is_written("real") && has_mode("real", 0640));
    remove("real");
    TEST(succeeds(w, name) && is_link(name) && is_written("real")); /* it led to nothing */
    remove("real");
    remove("folder/second");
    remove(name);
}

static void test_loop(const writer *w, const char *name)
{
    TEST(symlink(name, "second") == 0 && symlink("second", name) == 0);
    const run_outcome *o = write_to(w, &run_plain, name);
    if (!(TEST(o->status == 2) & TEST_HAS(o->text, strerror(ELOOP)) & TEST(is_link(name) && leaves_nothing())))
        run_tell(w->words, o);
    remove("second");
    remove(name);
}

static void test_left(const writer *w, const char *name)
{
    char temporary[LONGEST + 1] = "";
    const run_setting leaves = {.left = name};
    TEST(run_put(name, old_text));
    const run_outcome *o = write_to(w, &leaves, name);
    if (!(TEST(o->status == 0 && is_written(name)) & TEST(temporaries(".", temporary) == 1) &
          TEST(run_has(temporary, "left"))))
        run_tell(w->words, o);
    remove(temporary);
    remove(name);
}

/* Of letters, and of characters of two bytes. */
static void test_long_name(const writer *w)
{
    char name[LONGEST + 2];
    size_t ending = strlen(w->ending), length = LONGEST - ending;
    memset(name, 'n', length);
    memcpy(name + length, w->ending, ending + 1);
    TEST(strlen(name) == LONGEST && succeeds(w, name) && is_written(name));
    remove(name);
    for (size_t i = 1; i + 1 < length; i += 2)
        memcpy(name + i, "\xC3\xA9", 2);
    TEST(strlen(name) == LONGEST && succeeds(w, name) && succeeds(w, name) && is_written(name));
    remove(name);
    memmove(name + 1, name, LONGEST + 1);
    const run_outcome *o = write_to(w, &run_plain, name);
    TEST(o->status == 2 && strstr(o->text, strerror(ENAMETOOLONG)) && leaves_nothing());
}

/* A device and a pipe would be gone. */
static void test_no_file(const writer *w)
{
    static const char *const names[] = {"folder", "pipe", ""};
    TEST(mkfifo("pipe", 0666) == 0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const run_outcome *o = write_to(w, &run_plain, names[i]);
        if (!(TEST(o->status == 2) & TEST(leaves_nothing())))
            run_tell(w->words, o);
    }
    struct stat is;
    TEST(stat("pipe", &is) == 0 && S_ISFIFO(is.st_mode) && remove("pipe") == 0);
}

/* ---- stdout ---- */

static void test_stdout(void)
{
    static const struct {
        const char *words[RUN_WORDS]; /* but for -o */
        const char *file, *more[2];   /* OUT, and what it takes to have the same of - */
    } same[] = {
        {{"build", "--family", "ggx", "--max-bytes", "2048"}, "a.vndf", {NULL}},
        {{"sample", table, "--theta", "60", "-n", "3000"}, "a.csv", {NULL}},
        {{"sample", table, "--theta", "60", "-n", "3000"}, "a.f32", {"--format", "f32"}},
        {{"plot", table, "--theta", "60"}, "a.svg", {NULL}},
        {{"masking", table}, "a.csv", {NULL}},
        {{"render", "ball.scene", "--spp", "1"}, "a.png", {NULL}},
        {{"render", "ball.scene", "--spp", "1", "--sampler", "perfect"}, "a.pfm", {"--format", "pfm"}},
    };
    const run_setting to_file = {.append = "stdout"};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        const char *words[RUN_WORDS] = {NULL};
        int n = 0;
        for (; same[i].words[n]; n++)
            words[n] = same[i].words[n];
        words[n++] = "-o";
        words[n] = same[i].file;
        TEST(run_program(&run_plain, words)->status == 0 && run_put("stdout", ""));
        words[n++] = "-";
        memcpy(words + n, same[i].more, sizeof same[i].more);
        const run_outcome *o = run_program(&to_file, words);
        if (!(TEST(o->status == 0 && o->text[0] == '\0') & TEST(run_same("stdout", same[i].file))))
            run_tell(words, o);
        TEST(remove(same[i].file) == 0 && remove("stdout") == 0);
    }
}

/* A folder is no stream, and a picture is no place for other text. */
static void test_no_stdout(void)
{
    static const char *const words[][RUN_WORDS] = {{"report", "-"}, {"render", "ball.scene", "--json", "-o", "-"}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const run_outcome *o = run_program(&run_plain, words[i]);
        if (!(TEST(o->status == 2) & TEST_HAS(o->text, "stdout")))
            run_tell(words[i], o);
    }
    TEST(access("-", F_OK) != 0);
}

static void test_memory(void)
{
    unsigned char bytes[4096];
    size_t size;
    vndf_error error = {VNDF_OK, ""};
    char *file = run_file(table, &size);
    vndf_distribution *loaded = vndf_load(table, &error);
    TEST(size <= sizeof bytes && vndf_distribution_info(loaded).bytes == size);
    TEST(vndf_save_memory(loaded, bytes, size, &error) == VNDF_OK && file && memcmp(bytes, file, size) == 0);
    TEST(vndf_save_memory(loaded, bytes, size - 1, &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_save_memory(loaded, bytes, size + 1, &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_save_memory(loaded, NULL, size, &error) == VNDF_ERROR_ARGUMENT);
    TEST(vndf_save_memory(vndf_ggx(), bytes, size, &error) == VNDF_ERROR_ARGUMENT);
    vndf_free(loaded);
    free(file);
}

int main(void)
{
    char folder[] = "replace.XXXXXX";
    if (!TEST(mkdtemp(folder) != NULL && chdir(folder) == 0))
        return test_done();
    TEST(run_put("ball.scene", run_scene) && mkdir("folder", 0777) == 0);
    for (int i = 0; i < (test_quick() ? WRITERS - 1 : WRITERS); i++) {
        char name[16];
        snprintf(name, sizeof name, "a%s", writers[i].ending);
        test_mode(&writers[i], name);
        test_owner(&writers[i], name);
        test_links(&writers[i], name);
        test_loop(&writers[i], name);
        test_left(&writers[i], name);
        test_long_name(&writers[i]);
        test_no_file(&writers[i]);
    }
    test_stdout();
    test_no_stdout();
    test_memory();
    TEST(remove("ball.scene") == 0 && rmdir("folder") == 0);
    TEST(chdir("..") == 0 && rmdir(folder) == 0); /* nothing is left */
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: no modes and links here");
    return 0;
}

#endif
