/* Whichever of stdin, stdout and stderr are closed, for every command: what it writes to files is whole and holds
 * nothing else, and the exit status is 2 exactly where it has something to print or to read there.
 * Commands that take seconds are left to more_descriptors. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include "harness/run_program.h"

enum { IN = 1, OUT = 2, ALL = 7, RARELY = 8 };

/* A file that a command writes. */
typedef struct written {
    const char *name;
    const char *begins, *ends; /* where it is not the same in each run; NULL: it is */
} written;

typedef struct subject {
    int needs; /* IN, OUT: the descriptors that it reads or prints to; RARELY: it takes long */
    const char *words[RUN_WORDS];
    written file[2];
} subject;

static const char table[] = VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf";

static const subject subjects[] = {
    {OUT, {"--help"}, {{0}}},
    {OUT, {"--version"}, {{0}}},
    {OUT, {"build", "--family", "ggx", "--max-bytes", "2048", "-o", "new.vndf"}, {{.name = "new.vndf"}}},
    {OUT | RARELY, {"build", "--family", "ggx", "--max-bytes", "2048", "-o", "-"}, {{0}}},
    {OUT, {"build", "--list"}, {{0}}},
    {OUT, {"info", table}, {{0}}},
    {OUT, {"check", "ggx", "--samples", "1000"}, {{0}}},
    {0, {"sample", table, "--theta", "60", "-n", "5000", "-o", "new.csv"}, {{.name = "new.csv"}}},
    {0, {"sample", table, "--theta", "60", "-n", "5000", "-o", "new.f32"}, {{.name = "new.f32"}}},
    {OUT, {"sample", table, "--theta", "60", "-n", "5000", "-o", "-"}, {{0}}},
    {IN | OUT, {"eval", table, "--theta", "60"}, {{0}}},
    {0, {"plot", table, "-o", "new.svg"}, {{.name = "new.svg"}}},
    {OUT, {"plot", table, "-o", "-"}, {{0}}},
    {OUT, {"masking", table, "-o", "new.csv"}, {{.name = "new.csv"}}},
    {OUT, {"masking", table, "-o", "-"}, {{0}}},
    {OUT,
     {"albedo", "ggx", "--columns", "8", "--rows", "8", "-o", "new.csv", "--c", "new.h"},
     {{.name = "new.csv"}, {.name = "new.h"}}},
    {OUT, {"albedo", "ggx", "--columns", "8", "--rows", "8", "-o", "-"}, {{0}}},
    {OUT,
     {"bench", "--only", "ggx", "--seconds", "0.1", "--csv", "new.csv", "--markdown", "new.md"},
     {{"new.csv", "method,distribution,", "\n"}, {"new.md", "| ", ".\n"}}},
    {OUT | RARELY,
     {"bench", "effects", "--distribution", "ggx", "--only", "bare reflection", "--seconds", "0.01", "--csv",
      "new.csv"},
     {{"new.csv", "set,distribution,", "\n"}}},
    {OUT, {"render", "ball.scene", "--spp", "2", "-o", "new.png"}, {{.name = "new.png"}}},
    {OUT, {"render", "ball.scene", "--spp", "2", "-o", "new.pfm"}, {{.name = "new.pfm"}}},
    {OUT, {"render", "ball.scene", "--spp", "2", "-o", "-"}, {{0}}},
    {OUT, {"render", "--grammar"}, {{0}}},
    {OUT,
     {"render", "ball.scene", "--spp", "2", "--compare", "visible,all", "-o", "new.png"},
     {{.name = "new.png"}}},
    {OUT | RARELY,
     {"report", "page", "--seconds", "1"},
     {{"page/index.html", "<!DOCTYPE html>", "</html>\n"}, {"page/frontier.svg", "<svg ", "</svg>\n"}}},
};

enum { SUBJECTS = sizeof subjects / sizeof *subjects };

/* ---- files ---- */

static void remove_files(const subject *s)
{
    for (int i = 0; i < 2; i++)
        if (s->file[i].name)
            remove(s->file[i].name);
    if (system("rm -rf page") != 0)
        TEST(0);
}

static int begins_and_ends(const written *w)
{
    size_t size, head = strlen(w->begins), tail = strlen(w->ends);
    char *text = run_file(w->name, &size);
    int good = text && size > head + tail && memcmp(text, w->begins, head) == 0 &&
               memcmp(text + size - tail, w->ends, tail) == 0;
    free(text);
    return good;
}

static void keep_name(char name[16], int i)
{
    snprintf(name, 16, "kept.%d", i);
}

/* As it is when all descriptors are open. */
static void keep_files(const subject *s)
{
    for (int i = 0; i < 2; i++) {
        char kept[16];
        keep_name(kept, i);
        if (s->file[i].name && !s->file[i].begins)
            TEST(rename(s->file[i].name, kept) == 0);
    }
}

static int are_whole(const subject *s)
{
    int good = 1;
    for (int i = 0; i < 2; i++) {
        const written *w = &s->file[i];
        char kept[16];
        keep_name(kept, i);
        if (w->name)
            good &= w->begins ? TEST(begins_and_ends(w)) : TEST(run_same(w->name, kept));
    }
    return good;
}

/* ---- the trials ---- */

static void try_closed(const subject *s, unsigned closed)
{
    const run_setting setting = {.closed = closed, .in = "normals.csv"};
    int expected = (closed & (unsigned)s->needs & (IN | OUT)) ? 2 : 0;
    const run_outcome *o = run_program(&setting, s->words);
    int good = TEST(o->status == expected) & are_whole(s);
    if (closed == OUT && expected)
        good &= TEST_HAS(o->text, "cannot write to stdout: Bad file descriptor");
    if (closed == IN && expected)
        good &= TEST_HAS(o->text, "cannot read stdin: Bad file descriptor");
    if (!good) {
        fprintf(stderr, "closed: %u\n", closed);
        run_tell(s->words, o);
    }
    remove_files(s);
}

/* With all open first, for what the files have to be. */
static void try_subject(const subject *s)
{
    const run_setting open = {.in = "normals.csv"};
    if (s->needs & RARELY) {
        if (test_long())
            try_closed(s, ALL);
        return;
    }
    const run_outcome *o = run_program(&open, s->words);
    if (!TEST(o->status == 0))
        run_tell(s->words, o);
    keep_files(s);
    remove_files(s);
    for (unsigned closed = IN; closed <= ALL; closed++)
        try_closed(s, closed);
}

/* What is said to nobody changes nothing. */
static void test_complaints(void)
{
    static const char *const wrong[][RUN_WORDS] = {
        {NULL}, {"info", "missing.vndf"}, {"sample", "ggx"}, {"build", "--family", "nonsense", "-o", "new.vndf"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (unsigned closed = 0; closed <= ALL; closed++) {
            const run_setting setting = {.closed = closed};
            TEST(run_program(&setting, wrong[i])->status == 2);
        }
    TEST(access("new.vndf", F_OK) != 0);
}

int main(void)
{
    char folder[] = "descriptors.XXXXXX";
    if (!TEST(mkdtemp(folder) != NULL && chdir(folder) == 0))
        return test_done();
    TEST(run_put("ball.scene", run_scene) && run_put("normals.csv", "0.6,0,0.8\n0,0,1\n"));
    for (int i = 0; i < SUBJECTS; i++)
        try_subject(&subjects[i]);
    test_complaints();
    TEST(system("rm -f kept.0 kept.1 ball.scene normals.csv") == 0);
    TEST(chdir("..") == 0 && rmdir(folder) == 0); /* nothing is left */
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: no fork and descriptors here");
    return 0;
}

#endif
