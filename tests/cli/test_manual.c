/* The manual page holds every command; its help says how it is used, and the options of its examples are its own.
 * groff, where it is, reads the page without a complaint, and bash completes what stands in the helps. It notices an
 * example with an option that is gone, and a help that is no table of options. */
#include "harness/run_program.h"

#include <ctype.h>

static char help[RUN_TEXT];

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
    char *man = strdup(run_said(help, "vndf --man"));
    TEST(man && run_put("vndf.1", man));
    TEST(strcmp(run_said(head, "vndf --help"), run_said(help, "vndf help")) == 0);
    for (const char *at = head; man && (at = strstr(at, "\n  ")) != NULL; at++) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at + 3, " "), at + 3);
        if (isalpha((unsigned char)*name) && ++count)
            test_command(man, name);
    }
    TEST(count >= 12);
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
    TEST(system("rm -f said vndf.1 ask.bash 'a table.vndf'") == 0);
    return run_end(folder);
}
