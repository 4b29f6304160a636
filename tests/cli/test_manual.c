/* The manual page holds every command; its help says how it is used, the options of its examples are its own, and its
 * examples run, one after the other, with a surface of noise for surface.pfm: those that take longer than a second or
 * two, or another language, are left out, and named. groff, where it is, reads the page without a complaint, and bash
 * completes what stands in the helps. It notices an example with an option that is gone, or that asks for what no table
 * reaches, and a help that is no table of options. */
#include "harness/run_program.h"

#include <ctype.h>

static char help[RUN_TEXT];

/* Runs lines that begin with "example: ", and those below them that begin with as many blanks. */
static void test_examples(void)
{
    static const char *const long_ones[] = {"check", "report", "bench", "bake", "render", "judge"};
    int is_example = 0, is_left_out;
    char line[256];
    for (const char *at = help, *end; *at && (end = strchr(at, '\n')) != NULL; at = end + 1) {
        snprintf(line, sizeof line, "%.*s", (int)(end - at), at);
        is_example = strncmp(line, "example: ", 9) == 0 || (is_example && strspn(line, " ") == 9);
        is_left_out = is_example && strncmp(line + 9, "vndf ", 5) != 0;
        for (size_t i = 0; is_example && i < sizeof long_ones / sizeof *long_ones; i++)
            is_left_out |= strncmp(line + 14, long_ones[i], strlen(long_ones[i])) == 0;
        if (is_left_out)
            fprintf(stderr, "left out: %s\n", line + 9);
        else if (is_example)
            run_line(0, "", "%s", line + 9);
    }
}

static void test_command(const char *man, const char *name)
{
    char line[96], option[64], item[3][72];
    snprintf(line, sizeof line, "\n.SH \"vndf %s\"", name);
    TEST_HAS(man, line);
    run_said(help, "vndf help %s", name);
    TEST(strncmp(help, "usage: vndf ", 12) == 0);
    TEST_HAS(help, "\n  -q               prints neither figures nor progress\n");
    const char *example = strstr(help, "\nexample: ");
    for (TEST(example != NULL); example && (example = strstr(example, " --")) != NULL; example++)
        if (sscanf(example, " %63[-a-z0-9]", option) == 1) {
            snprintf(item[0], sizeof item[0], "\n  %s ", option);
            snprintf(item[1], sizeof item[1], "\n    %s ", option);
            snprintf(item[2], sizeof item[2], ", %s ", option);
            if (!TEST(strstr(help, item[0]) || strstr(help, item[1]) || strstr(help, item[2])))
                fprintf(stderr, "  %s of %s\n", option, name);
        }
    test_examples();
}

static const char ask_bash[] =
    "source " VNDF_SOURCE_DIR "/tools/package/vndf.bash\n"
    "ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _vndf \"$VNDF\"; printf '%s,' \"${COMPREPLY[@]}\"; echo; }\n"
    "ask vndf bui\nask vndf build --mom\nask vndf sample 'a ta'\nask vndf build no\nask vndf build --kn\n"
    "ask vndf bench --the\nask vndf help plo\n";

int main(void)
{
    char folder[] = "manual.XXXXXX", head[RUN_TEXT], name[64];
    int count = 0;
    if (!run_begin(folder))
        return test_done();
    FILE *surface = fopen("surface.pfm", "wb");
    unsigned long long state = 1;
    for (int i = 0; i < 64 * 64; i++)
        fprintf(surface, "%d%c", (int)(test_random_bits(&state) >> 48), i % 64 == 63 ? '\n' : ' ');
    fclose(surface);
    TEST(system("ln -s " VNDF_SOURCE_DIR "/tables " VNDF_SOURCE_DIR "/tools .") == 0);
    char *man = strdup(run_said(help, "vndf --man"));
    TEST(strcmp(run_said(head, "vndf --help"), run_said(help, "vndf help")) == 0);
    for (const char *at = head; man && (at = strstr(at, "\n  ")) != NULL; at++) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at + 3, " "), at + 3);
        if (isalpha((unsigned char)*name) && ++count)
            test_command(man, name);
    }
    TEST(count >= 12);
    TEST(system("rm -f *") == 0 && man && run_put("vndf.1", man));
    free(man);
    /* What is complained of stands first. */
    TEST(run_put("ask.bash", ask_bash) && run_put("a table.vndf", ""));
    if (system("command -v groff >said") == 0) {
        TEST(run_said(help, "groff -man -ww -Tascii -P-cbou vndf.1 >said; cat said")[0] == 'V');
        TEST(strstr(help, "vndf build") && strstr(help, "(1+0.8*cos(6*r))"));
    }
    if (system("command -v bash >said") == 0)
        TEST(strcmp(run_said(help, "bash ask.bash"),
                    "build,\n--moments,\na table.vndf,\n,\n--knots,\n--theta,\nplot,\n") == 0);
    TEST(system("rm -f *") == 0);
    return run_end(folder);
}
