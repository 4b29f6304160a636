/* The manual page and the completion hold every command; its help says how it is used, and the options of its examples
 * are its own. groff and bash, where they are, read what is written without a complaint, and bash completes what stands
 * in it. It notices an item of a help that is not read as the option that it names. */
#include "harness/run_program.h"

#include <ctype.h>

static char *man, *completion;

/* "build", or "bench effects" */
static void test_command(const char *name)
{
    char begin[96], words[2][32] = {"", ""}, option[64];
    snprintf(begin, sizeof begin, "\n.SH \"vndf %s\"", name);
    TEST_HAS(man, begin);
    sscanf(name, "%31s %31s", words[0], words[1]);
    char *help = PRINTED(NULL, "help", words[0], words[1][0] ? words[1] : NULL);
    TEST(strncmp(help, "usage: vndf ", 12) == 0);
    TEST_HAS(help, "\n  -q               prints neither figures nor progress\n");
    snprintf(begin, sizeof begin, "    '%s') words='", name);
    const char *known = strstr(completion, begin), *example = strstr(help, "\nexample: ");
    for (TEST(known && example); known && example && (example = strstr(example, " --")) != NULL; example++)
        if (sscanf(example, " %63[-a-z0-9]", option) == 1) {
            const char *found = strstr(known, option);
            if (!TEST(found && found < strchr(known, '\n') && found[strlen(option)] == ' '))
                fprintf(stderr, "  %s of %s\n", option, name);
        }
    free(help);
}

/* Says nothing on stderr, if it is here: what it prints is in the file "said". */
static int reads(const char *program, const char *words)
{
    char line[256];
    size_t size;
    snprintf(line, sizeof line, "command -v %s >/dev/null 2>&1", program);
    if (system(line) != 0) {
        printf("without %s\n", program);
        return 0;
    }
    snprintf(line, sizeof line, "%s %s >said 2>complaint", program, words);
    TEST(system(line) == 0);
    char *complaint = run_file("complaint", &size);
    TEST(complaint && size == 0);
    free(complaint);
    return remove("complaint") == 0;
}

static const char ask_bash[] = "source ./completion.bash\n"
                               "ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _vndf; "
                               "printf '%s,' \"${COMPREPLY[@]}\"; echo; }\n"
                               "ask vndf bui\nask vndf build --mom\nask vndf sample 'a ta'\nask vndf build no\n"
                               "ask vndf bench effects --the\nask vndf bench --the\nask vndf help plo\n";

int main(void)
{
    char folder[] = "manual.XXXXXX", head[RUN_TEXT], name[64];
    size_t size;
    int count = 0;
    if (!run_begin(folder))
        return test_done();
    free(PRINTED(NULL, "help", "--man", "-o", "vndf.1"));
    free(PRINTED(NULL, "help", "--completion", "bash", "-o", "completion.bash"));
    man = run_file("vndf.1", &size);
    completion = run_file("completion.bash", &size);
    strcpy(head, run_expect(0, NULL, RUN_LIST("--help"))->text);
    TEST(strcmp(head, run_expect(0, NULL, RUN_LIST("help"))->text) == 0);
    for (const char *at = head; man && completion && (at = strstr(at, "\n  ")) != NULL; at++) {
        const int is_effects = strncmp(at + 3, "bench effects", 13) == 0;
        snprintf(name, sizeof name, "%.*s", is_effects ? 13 : (int)strcspn(at + 3, " "), at + 3);
        if (isalpha((unsigned char)*name) && ++count)
            test_command(name);
    }
    TEST(count >= 13);
    TEST(run_put("ask.bash", ask_bash) && run_put("a table.vndf", ""));
    if (reads("groff", "-man -ww -Tascii -P-cbou vndf.1"))
        TEST(system("grep -q 'vndf build' said && grep -q '(1+0.8\\*cos(6\\*r))' said") == 0);
    if (reads("bash", "ask.bash"))
        TEST(run_has("said", "build,\n--moments,\na table.vndf,\n,\n--theta,\n,\nplot,\n"));
    free(man);
    free(completion);
    TEST(system("rm -f said vndf.1 completion.bash ask.bash 'a table.vndf'") == 0);
    return run_end(folder);
}
