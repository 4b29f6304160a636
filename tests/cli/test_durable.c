/* What is said to be written is on the disk: every output of every command, and vndf_save, is flushed and synced
 * before it is renamed over the old file, and whichever step fails - a write, also one long before the end, the
 * flush, the sync, closing, the mode, the rename, a full disk - is told; then the old file is whole and no temporary
 * is left.
 *
 * The linker puts the functions below in the place of the C library's (--wrap), in the library and the program's
 * parts as well as here. */
#if defined(__unix__)
#  define _XOPEN_SOURCE 700
#endif

#include "harness/test.h"

#ifdef VNDF_TEST_WRAP

#  include <dirent.h>
#  include <errno.h>
#  include <fcntl.h>
#  include <stdlib.h>
#  include <sys/resource.h>
#  include <sys/stat.h>
#  include <sys/wait.h>
#  include <unistd.h>

#  include "command.h"
#  include "cli/output.h"
#  include "draw/folder.h"
#  include "harness/run_program.h"
#  include "vndf_build.h"

size_t __real_fwrite(const void *data, size_t size, size_t count, FILE *file);
int __real_fflush(FILE *file);
int __real_ferror(FILE *file);
int __real_fclose(FILE *file);
int __real_fsync(int file);
int __real_fchmod(int file, mode_t mode);
int __real_rename(const char *from, const char *to);
size_t __wrap_fwrite(const void *data, size_t size, size_t count, FILE *file);
int __wrap_fflush(FILE *file);
int __wrap_ferror(FILE *file);
int __wrap_fclose(FILE *file);
int __wrap_fsync(int file);
int __wrap_fchmod(int file, mode_t mode);
int __wrap_rename(const char *from, const char *to);

/* ---- steps that fail, and their order ---- */

enum { WRITE = 1, FLUSH, CLOSE, SYNC, MODE, RENAME, STEPS };

/* The step that fails from now on, once; renames so far; those of a file that was not synced as it is. */
static int failing, renames, unsynced;
static struct stat synced;
static FILE *spoiled;     /* the stream that a write failed of */
static char renamed[512]; /* the last temporary */

static int fails(int step)
{
    if (failing != step)
        return 0;
    failing = 0;
    errno = EDQUOT; /* whose text is no other's */
    return 1;
}

/* On the way to a file, not to memory or a reader. */
static int is_output(FILE *file)
{
    struct stat is;
    return file && fileno(file) >= 0 && fstat(fileno(file), &is) == 0 && S_ISREG(is.st_mode) &&
           (fcntl(fileno(file), F_GETFL) & O_ACCMODE) != O_RDONLY;
}

/* All but the last byte. */
size_t __wrap_fwrite(const void *data, size_t size, size_t count, FILE *file)
{
    if (size == 1 && is_output(file) && fails(WRITE)) {
        spoiled = file;
        return __real_fwrite(data, 1, count - 1, file);
    }
    return __real_fwrite(data, size, count, file);
}

int __wrap_fflush(FILE *file)
{
    if (!is_output(file) || !fails(FLUSH))
        return __real_fflush(file);
    spoiled = file;
    return EOF;
}

int __wrap_ferror(FILE *file)
{
    return file == spoiled || __real_ferror(file);
}

int __wrap_fclose(FILE *file)
{
    int writes = is_output(file), closed = __real_fclose(file);
    spoiled = NULL;
    return writes && fails(CLOSE) ? EOF : closed;
}

int __wrap_fsync(int file)
{
    if (fails(SYNC))
        return -1;
    return __real_fsync(file) == 0 || errno == EINVAL ? fstat(file, &synced) : -1;
}

int __wrap_fchmod(int file, mode_t mode)
{
    return fails(MODE) ? -1 : __real_fchmod(file, mode);
}

int __wrap_rename(const char *from, const char *to)
{
    struct stat is;
    renames++;
    snprintf(renamed, sizeof renamed, "%s", from);
    unsynced += stat(from, &is) != 0 || is.st_ino != synced.st_ino || is.st_size != synced.st_size;
    return fails(RENAME) ? -1 : __real_rename(from, to);
}

/* ---- files ---- */

static char old_text[PAGE_MARK_MAX + 32]; /* which is taken for a page of `vndf report` */
static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";

/* Its mode is one that a new file would not get. */
static void put_old(const char *name)
{
    TEST(run_put(name, old_text) && chmod(name, 0777) == 0);
    failing = 0;
    renames = unsynced = 0;
}

static int has_no_temporary(const char *folder)
{
    int count = 0;
    DIR *directory = opendir(folder);
    for (struct dirent *entry; directory && (entry = readdir(directory)) != NULL;)
        count += strstr(entry->d_name, ".tmp") != NULL;
    if (directory)
        closedir(directory);
    return directory && count == 0;
}

static int is_alone(void)
{
    return has_no_temporary(".") && has_no_temporary("page");
}

static int is_untouched(const char *name)
{
    struct stat is;
    return run_has(name, old_text) && stat(name, &is) == 0 && (is.st_mode & 0777) == 0777 && is_alone();
}

/* ---- the library ---- */

static void test_save(void)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *loaded = vndf_load(table, &error);
    put_old("old.vndf");
    TEST(vndf_save(loaded, "old.vndf", &error) == VNDF_OK && renames == 1 && unsynced == 0);
    TEST(run_same("old.vndf", table));
    for (int step = WRITE; step < STEPS; step++) {
        put_old("old.vndf");
        failing = step;
        vndf_status status = vndf_save(loaded, "old.vndf", &error);
        if (!(TEST(status == VNDF_ERROR_IO && failing == 0) & TEST_HAS(error.message, strerror(EDQUOT)) &
              TEST(is_untouched("old.vndf"))))
            fprintf(stderr, "  step %d: %s\n", step, error.message);
    }
    failing = 0;
    vndf_free(loaded);
    remove("old.vndf");
}

/* ---- outputs of the program ---- */

static run_outcome heard; /* of a child */

static int in_child(int (*run)(const void *given), const void *given)
{
    int status = -1, ends[2];
    if (!TEST(pipe(ends) == 0))
        return -1;
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        close(ends[0]);
        close(ends[1]);
        _exit(run(given));
    }
    close(ends[1]);
    run_read(ends[0], &heard);
    close(ends[0]);
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static int tells(const char *why)
{
    int good = strstr(heard.text, why) != NULL;
    if (!good)
        fprintf(stderr, "  said: %s\n", heard.text);
    return good;
}

static int write_output(const char *name)
{
    output_file output;
    if (!output_open(&output, "test", name))
        return STATUS_USE;
    fputs("new\n", output.file);
    return output_commit(&output);
}

static int try_output(const void *given)
{
    failing = *(const int *)given;
    int status = write_output("old.txt");
    return failing ? 64 : status; /* it was not asked for */
}

static void test_output(void)
{
    put_old("old.txt");
    TEST(write_output("old.txt") == STATUS_GOOD && renames == 1 && unsynced == 0 && run_has("old.txt", "new\n"));
    for (int step = FLUSH; step < STEPS; step++) {
        put_old("old.txt");
        if (!(TEST(in_child(try_output, &step) == STATUS_USE) & TEST(tells(strerror(EDQUOT))) &
              TEST(is_untouched("old.txt"))))
            fprintf(stderr, "  step %d\n", step);
    }
    remove("old.txt");
}

/* ---- long names of other letters ---- */

/* A temporary's name is cut between characters, since some systems have no other names: "n", then characters
 * of two bytes. */
static int is_cut_well(void)
{
    size_t length = strcspn(renamed, ".");
    return length % 2 == 1 && length > 50 && length < 200 && renamed[length - 1] == '\xA9';
}

static void test_characters(void)
{
    char name[256] = "n";
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *loaded = vndf_load(table, &error);
    for (size_t i = 1; i + 1 < sizeof name; i += 2)
        memcpy(name + i, "\xC3\xA9", 2);
    name[255] = '\0';
    TEST(strlen(name) == 255 && vndf_save(loaded, name, &error) == VNDF_OK && is_cut_well());
    TEST(write_output(name) == STATUS_GOOD && is_cut_well());
    vndf_free(loaded);
    remove(name);
}

/* ---- errors long before the end ---- */

static void limit_files(rlim_t bytes)
{
    struct rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
}

/* The disk is full for a while; by the end all would go well. */
static void write_through_error(FILE *file)
{
    for (int i = 0; i < 20000; i++) {
        limit_files(i == 10 ? 1000 : RLIM_INFINITY);
        fprintf(file, "line %d\n", i);
        if (i == 10)
            fprintf(file, "%9000d", i);
        if (i == 10)
            fflush(file);
    }
}

static int error_in_output(const void *given)
{
    output_file output;
    output_ignore_size_signal();
    if (!output_open(&output, "test", given))
        return 64;
    write_through_error(output.file);
    return output_commit(&output);
}

static int error_in_stdout(const void *given)
{
    output_ignore_size_signal();
    if (!freopen(given, "w", stdout))
        return 64;
    write_through_error(stdout);
    return output_finish_stdout("test");
}

static void test_earlier_error(void)
{
    put_old("old.txt");
    TEST(in_child(error_in_output, "old.txt") == STATUS_USE);
    TEST(tells("cannot write 'old.txt'") && is_untouched("old.txt"));
    TEST(in_child(error_in_stdout, "old.txt") == STATUS_USE);
    TEST(tells("cannot write to stdout"));
    remove("old.txt");
}

/* ---- commands ---- */

typedef struct command {
    int (*run)(int argc, char **argv);
    const char *name; /* the file that is there already */
    const char *words[RUN_WORDS];
    int files; /* written in all, at least */
} command;

/* Two files of a folder, as `vndf report` writes them. */
static int write_page(int argc, char **argv)
{
    static char text[200];
    const page_file files[] = {{"index.html", text, sizeof text}, {"a.svg", text, sizeof text}};
    memset(text, 'x', sizeof text);
    if (argc != 1 || folder_examine("vndf report", argv[0]) == FOLDER_REFUSED)
        return STATUS_USE;
    unsigned held = output_hold_signals();
    int status = folder_write("vndf report", argv[0], files, 2, held);
    output_release_signals(held);
    return status;
}

static const command commands[] = {
    {command_build, "old.vndf", {"--family", "ggx", "--max-bytes", "2048", "-o", "old.vndf"}, 1},
    {command_sample, "old.csv", {table, "--theta", "60", "-n", "5000", "-o", "old.csv"}, 1},
    {command_sample, "old.f32", {table, "--theta", "60", "-n", "5000", "-o", "old.f32"}, 1},
    {command_plot, "old.svg", {table, "--theta", "60", "-o", "old.svg"}, 1},
    {command_masking, "old.csv", {table, "-o", "old.csv"}, 1},
    {command_albedo, "old.csv", {table, "--columns", "8", "--rows", "8", "-o", "old.csv"}, 1},
    {command_albedo, "old.h", {table, "--columns", "8", "--rows", "8", "--c", "old.h"}, 1},
    {command_albedo, "old.albedo", {table, "--columns", "8", "--rows", "8", "--save", "old.albedo"}, 1},
    {command_bench, "old.md", {"--only", "ggx", "--seconds", "0.1", "--markdown", "old.md"}, 1},
    {command_render, "old.png", {"ball.scene", "--spp", "1", "-o", "old.png"}, 1},
    {command_render, "old.pfm", {"ball.scene", "--spp", "1", "-o", "old.pfm"}, 1},
    {write_page, "page/index.html", {"page"}, 2},
};

enum { COMMANDS = sizeof commands / sizeof *commands };

typedef struct trial {
    const command *command;
    int failing;
    rlim_t limit; /* of a file's bytes */
} trial;

static int try_command(const void *given)
{
    const trial *t = given;
    char *argv[RUN_WORDS] = {NULL};
    int argc = 0;
    for (; t->command->words[argc]; argc++)
        argv[argc] = (char *)(size_t)(const void *)t->command->words[argc];
    if (!freopen("/dev/null", "w", stdout))
        return 64;
    output_ignore_size_signal();
    limit_files(t->limit);
    failing = t->failing;
    int status = t->command->run(argc, argv);
    int synced_all = unsynced == 0 && (status != STATUS_GOOD || renames >= t->command->files);
    return synced_all ? status : 65;
}

static void test_command(const command *c)
{
    const trial trials[] = {
        {c, 0, RLIM_INFINITY}, {c, SYNC, RLIM_INFINITY}, {c, FLUSH, RLIM_INFINITY}, {c, 0, 30}};
    static const char *const why[] = {"", "quota", "cannot write", "too large"};
    for (size_t i = 0; i < sizeof trials / sizeof *trials; i++) {
        put_old(c->name);
        int status = in_child(try_command, &trials[i]);
        int good = TEST(status == (i ? STATUS_USE : STATUS_GOOD)) & TEST(tells(why[i]));
        if (!(good & TEST(i ? is_untouched(c->name) : !run_has(c->name, old_text) && is_alone())))
            fprintf(stderr, "  %s, trial %zu: status %d\n", c->name, i, status);
    }
    remove(c->name);
}

int main(void)
{
    char folder[] = "durable.XXXXXX";
    if (!TEST(mkdtemp(folder) != NULL && chdir(folder) == 0))
        return test_done();
    page_mark(old_text, "vndf report");
    umask(022);
    TEST(run_put("ball.scene", run_scene) && mkdir("page", 0777) == 0);
    test_save();
    test_output();
    test_characters();
    test_earlier_error();
    for (int i = 0; i < COMMANDS; i++)
        test_command(&commands[i]);
    TEST(system("rm -r page ball.scene") == 0);
    TEST(chdir("..") == 0 && rmdir(folder) == 0); /* nothing is left */
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: the linker has no --wrap here, no step can be made to fail");
    return 0;
}

#endif
