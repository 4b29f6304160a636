/* No command replaces what it reads: an output that is one of its inputs, under whatever name - its own,
 * another path, a symbolic link, a hard link, stdin, stdout - is refused with a line that says so, and the
 * input stays as it was. */
#if defined(__unix__) || defined(__APPLE__)
#  define _XOPEN_SOURCE 700
#  define HAS_PROCESSES 1
#endif

#include "harness/test.h"

#ifdef HAS_PROCESSES

#  include "harness/run_program.h"

/* Words in which OUTPUT stands for a name of the input. */
#  define OUTPUT "OUTPUT"

typedef struct subject {
    const char *input;
    const char *words[RUN_WORDS];
} subject;

static const subject subjects[] = {
    {"gloss.csv", {"build", "--csv", "gloss.csv", "-o", OUTPUT}},
    {"gloss.csv", {"masking", "--csv", "gloss.csv", "-o", OUTPUT}},
    {"table.csv", {"masking", "ggx", "table.csv", "-o", OUTPUT}},
    {"table.csv", {"albedo", "table.csv", "-o", OUTPUT}},
    {"table.csv", {"albedo", "table.csv", "--c", OUTPUT}},
    {"table.csv", {"albedo", "table.csv", "--save", OUTPUT}},
    {"table.csv", {"sample", "table.csv", "--theta", "60", "-n", "10", "-o", OUTPUT}},
    {"table.svg", {"plot", "table.svg", "-o", OUTPUT}},
    {"gloss.csv", {"bench", "--csv-data", "gloss.csv", "--only", "ggx", "--seconds", "0.1", "--csv", OUTPUT}},
    {"gloss.csv", {"bench", "--csv-data", "gloss.csv", "--only", "ggx", "--seconds", "0.1", "--markdown", OUTPUT}},
    {"table.csv", {"bench", "effects", "--distribution", "table.csv", "--seconds", "0.01", "--csv", OUTPUT}},
    {"table.csv", {"bench", "effects", "--distribution", "table.csv", "--seconds", "0.01", "--markdown", OUTPUT}},
    {"all.png", {"render", "all.png", "--spp", "1", "-o", OUTPUT}},
    {"table.png", {"render", "all.png", "--spp", "1", "-o", OUTPUT}},
    {"mesh.png", {"render", "all.png", "--spp", "1", "-o", OUTPUT}},
    {"map.pfm", {"render", "all.png", "--spp", "1", "-o", OUTPUT}},
    {"sky.pfm", {"render", "all.png", "--spp", "1", "-o", OUTPUT}},
    {"before.pfm", {"render", "all.png", "--spp", "1", "-o", OUTPUT, "--against", "before.pfm"}},
};

enum { SUBJECTS = sizeof subjects / sizeof *subjects };

/* ---- inputs ---- */

static const char gloss[] = "slope,p22\n0,1\n0.5,0.8\n1,0.3\n2,0.01\n";

/* A scene that reads a file of each kind; the names end as outputs do. */
static const char scene[] = "film width 8 height 8\ncamera from 0 0 5 to 0 0 0\nimage map file map.pfm\n"
                            "image sky file sky.pfm\nenvironment image sky\n"
                            "material gold conductor of gold distribution table table.png alpha 0.2 "
                            "alpha-map map\n"
                            "mesh file mesh.png material gold\n";

static int copy_table(const char *name)
{
    size_t size;
    char *bytes = run_file(VNDF_SOURCE_DIR "/tables/student-t-2.5-small.vndf", &size);
    FILE *file = fopen(name, "wb");
    int good = bytes && file && fwrite(bytes, 1, size, file) == size;
    free(bytes);
    return file && fclose(file) == 0 && good;
}

static int put_pfm(const char *name)
{
    const unsigned char one[12] = {0, 0, 128, 63, 0, 0, 128, 63, 0, 0, 128, 63};
    FILE *file = fopen(name, "wb");
    int good = file && fputs("PF\n1 1\n-1.0\n", file) >= 0 && fwrite(one, 1, sizeof one, file) == sizeof one;
    return file && fclose(file) == 0 && good;
}

static int put_inputs(void)
{
    return run_put("gloss.csv", gloss) && run_put("all.png", scene) &&
           run_put("mesh.png", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n") && copy_table("table.csv") &&
           copy_table("table.svg") && copy_table("table.png") && put_pfm("map.pfm") && put_pfm("sky.pfm") &&
           put_pfm("before.pfm");
}

/* ---- other names of a file ---- */

enum { ITSELF, BY_FOLDER, BY_LINK, BY_LINKS, BY_HARD_LINK, NAMES };

/* With the ending of the input, by which commands judge. */
static int make_name(char name[64], int kind, const char *input)
{
    const char *ending = strrchr(input, '.');
    if (kind == ITSELF || kind == BY_FOLDER) {
        snprintf(name, 64, "%s%s", kind == ITSELF ? "" : "folder/../", input);
        return 1;
    }
    snprintf(name, 64, "other%s", ending);
    if (kind == BY_HARD_LINK)
        return link(input, name) == 0;
    if (kind == BY_LINK)
        return symlink(input, name) == 0;
    char back[64];
    snprintf(back, sizeof back, "../%s", input);
    return symlink("folder/link", name) == 0 && symlink(back, "folder/link") == 0;
}

static void remove_name(const char *name, int kind)
{
    if (kind >= BY_LINK)
        remove(name);
    if (kind == BY_LINKS)
        remove("folder/link");
}

/* ---- trials ---- */

static int is_refused(const run_outcome *o)
{
    return TEST(o->status == 2) & TEST(strstr(o->text, "put of this command") || strstr(o->text, "is kept;"));
}

static int stays(const char *input)
{
    return TEST(run_same(input, "before"));
}

static void keep(const char *input)
{
    size_t size;
    char *bytes = run_file(input, &size);
    FILE *file = fopen("before", "wb");
    TEST(bytes && file && fwrite(bytes, 1, size, file) == size);
    if (file)
        fclose(file);
    free(bytes);
}

static void try_name(const subject *s, int kind)
{
    const char *words[RUN_WORDS] = {NULL};
    char name[64];
    TEST(make_name(name, kind, s->input));
    for (int i = 0; i < RUN_WORDS && s->words[i]; i++)
        words[i] = strcmp(s->words[i], OUTPUT) == 0 ? name : s->words[i];
    const run_outcome *o = run_program(&run_plain, words);
    if (!(is_refused(o) & stays(s->input)))
        run_tell(words, o);
    remove_name(name, kind);
}

/* Under another name the same words are good. */
static void test_other(void)
{
    static const char *const words[] = {"render", "all.png", "--spp", "1", "-o", "fine.png", NULL};
    const run_outcome *o = run_program(&run_plain, words);
    if (!TEST(o->status == 0) || !TEST(remove("fine.png") == 0))
        run_tell(words, o);
}

/* What is appended to stdout would change an input, too. */
static void test_stdout(void)
{
    static const char *const words[][RUN_WORDS] = {{"info", "before"},
                                                   {"sample", "before", "--theta", "60", "-n", "10", "-o", "-"},
                                                   {"eval", "before", "--theta", "60"},
                                                   {"plot", "before", "-o", "-"},
                                                   {"plot", "ggx", "-o", "before"}};
    const run_setting appends = {.append = "before"}, filters = {.in = "normals", .append = "normals"};
    keep("table.csv");
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const run_outcome *o = run_program(&appends, words[i]);
        if (!(TEST(o->status == 2) & TEST(run_same("before", "table.csv"))))
            run_tell(words[i], o);
    }
    static const char *const filter[] = {"eval", "ggx", "--theta", "60", NULL};
    TEST(run_put("normals", "0,0,1\n") && is_refused(run_program(&filters, filter)));
    TEST(run_has("normals", "0,0,1\n"));
    remove("normals");
}

/* Two outputs are two files. */
static void test_outputs(void)
{
    static const char *const names[][2] = {{"a", "a"}, {"a", "./a"}, {"a", "folder/../a"}, {"a", "link"}};
    TEST(symlink("a", "link") == 0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *words[] = {"bench", "--only",    "ggx",        "--seconds", "0.1",
                               "--csv", names[i][0], "--markdown", names[i][1], NULL};
        const run_outcome *o = run_program(&run_plain, words);
        if (!(TEST(o->status == 2) & TEST_HAS(o->text, "both name 'a'")))
            run_tell(words, o);
    }
    TEST(remove("link") == 0 && access("a", F_OK) != 0);
}

int main(void)
{
    char folder[] = "same_file.XXXXXX";
    if (!TEST(mkdtemp(folder) != NULL && chdir(folder) == 0))
        return test_done();
    TEST(put_inputs() && mkdir("folder", 0777) == 0);
    for (int i = 0; i < SUBJECTS; i++) {
        keep(subjects[i].input);
        for (int kind = 0; kind < NAMES; kind++)
            try_name(&subjects[i], kind);
    }
    test_other();
    test_stdout();
    test_outputs();
    TEST(system("rm gloss.csv all.png mesh.png table.csv table.svg table.png map.pfm sky.pfm before before.pfm") ==
         0);
    TEST(rmdir("folder") == 0 && chdir("..") == 0 && rmdir(folder) == 0); /* nothing is left */
    return test_done();
}

#else

int main(void)
{
    puts("SKIPPED: no fork and links here");
    return 0;
}

#endif
