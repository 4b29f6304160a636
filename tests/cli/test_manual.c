/* The manual page and the completion hold every command and every option of its help, and no others; troff and bash,
 * where they are, read them without a complaint, and bash completes what stands in them. It notices an option without
 * an item in the help, and an item that is no option. */
#include "harness/run_program.h"

#include <ctype.h>

static char *man, *completion;

#define RUN(status, ...) run_expect(status, NULL, RUN_LIST(__VA_ARGS__))

/* Whether the help says something of an option on a line "  TERM  text", or below it. */
static int has_item(const char *help, const char *option)
{
    size_t length = strlen(option);
    for (const char *at = help; (at = strstr(at, option)) != NULL; at += length) {
        const char *line = at;
        while (line > help && line[-1] != '\n')
            line--;
        if (strncmp(line, "  ", 2) == 0 && strchr(" ,\n", at[length]) && (at == line + 2 || at[-1] == ' '))
            return 1;
    }
    return 0;
}

/* The options that bash knows for a command, between blanks. */
static void known_options(const char *command, char known[2048])
{
    char begin[160];
    snprintf(begin, sizeof begin, "    '%s') ", command);
    const char *at = strstr(completion, begin), *options = at ? strstr(at, "words='") : NULL;
    snprintf(known, 2048, " %.*s ", options ? (int)strcspn(options + 7, "'") : 0, options ? options + 7 : "");
    TEST(strlen(known) > 4);
}

/* `mode` may be NULL. */
static void test_command(const char *name, const char *mode)
{
    char known[2048], option[64], escaped[128], command[128], heading[160] = "\n.SH \"VNDF ";
    snprintf(command, sizeof command, "%s%s%s", name, mode ? " " : "", mode ? mode : "");
    const char *help = mode ? RUN(0, name, mode, "--help")->text : RUN(0, name, "--help")->text;
    size_t at = strlen(heading);
    for (const char *c = command; *c; c++)
        heading[at++] = (char)toupper((unsigned char)*c);
    TEST_HAS(man, heading);
    TEST_HAS(help, "usage: vndf ");
    TEST_HAS(help, "\nexample: ");
    known_options(command, known);
    for (const char *word = known; sscanf(word, "%63s", option) == 1;
         word = strstr(word, option) + strlen(option)) {
        at = 0;
        for (const char *c = option; *c; c++)
            at += (size_t)snprintf(escaped + at, sizeof escaped - at, *c == '-' ? "\\-" : "%c", *c);
        if (!TEST(strcmp(option, "--help") == 0 || (has_item(help, option) && strstr(man, escaped))))
            fprintf(stderr, "  %s of %s\n", option, command);
    }
    for (const char *item = help; (item = strstr(item, "\n  -")) != NULL; item++) {
        snprintf(option, sizeof option, " %.*s ", (int)strcspn(item + 3, " ,=\n"), item + 3);
        if (!TEST(strstr(known, option)))
            fprintf(stderr, "  %s has%sin its help alone\n", command, option);
    }
}

static void test_every_command(void)
{
    static char head[RUN_TEXT];
    int count = 0;
    char name[64];
    strcpy(head, RUN(0, "--help")->text);
    TEST(strcmp(head, RUN(0, "help")->text) == 0);
    for (const char *at = head; (at = strstr(at, "\n  ")) != NULL; at++)
        if (sscanf(at + 3, "%63[a-z]", name) == 1) {
            test_command(name, NULL);
            TEST_HAS(RUN(2, name, "--no-such-option")->text, "there is no option '--no-such-option'");
            count++;
        }
    test_command("bench", "effects");
    TEST(count >= 12);
    TEST_HAS(RUN(0, "help", "bench", "effects")->text, "usage: vndf bench effects");
    TEST_HAS(RUN(0, "--version")->text, "vndf ");
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

static void test_readers(void)
{
    size_t size;
    if (reads("groff", "-man -ww -Tascii -P-cbou vndf.1")) {
        char *page = run_file("said", &size);
        TEST_HAS(page, "VNDF BUILD");
        TEST_HAS(page, "exp(-k*r)*(1+0.8*cos(6*r))");
        free(page);
    }
    TEST(run_put("ask.bash", "source ./completion.bash\n"
                             "ask() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _vndf; "
                             "printf '%s,' \"${COMPREPLY[@]}\"; echo; }\n"
                             "ask vndf bui\nask vndf build --mom\nask vndf sample 'a ta'\nask vndf build no\n"
                             "ask vndf bench effects --the\nask vndf bench --the\nask vndf help plo\n") &&
         run_put("a table.vndf", ""));
    if (reads("bash", "ask.bash"))
        TEST(run_has("said", "build,\n--moments,\na table.vndf,\n,\n--theta,\n,\nplot,\n"));
    remove("said");
    TEST(remove("ask.bash") == 0 && remove("a table.vndf") == 0);
}

int main(void)
{
    char folder[] = "manual.XXXXXX";
    size_t size;
    if (!run_begin(folder))
        return test_done();
    RUN(0, "help", "--man", "-o", "vndf.1");
    RUN(0, "help", "--completion", "bash", "-o", "completion.bash");
    man = run_file("vndf.1", &size);
    completion = run_file("completion.bash", &size);
    if (TEST(man && completion)) {
        test_every_command();
        test_readers();
    }
    free(man);
    free(completion);
    TEST(remove("vndf.1") == 0 && remove("completion.bash") == 0);
    return run_end(folder);
}
