/* An `if` on what lanes differ in is refused where the kernel is printed for Python, by the build: C, which
 * has one lane, takes it, and it once broke every test of Mitsuba after all those of C had passed. What all
 * lanes share is printed. */
#include "export/translate.h"
#include "harness/test.h"

/* The program itself with the text as its argument; its status. */
static int printed(const char *program, const char *condition)
{
    char command[1000];
    snprintf(command, sizeof command, "\"%s\" \"%s\" 2>lane_conditions.txt", program, condition);
    return system(command);
}

static int print(const char *condition)
{
    static kernel from;
    char text[500];
    translation t = {.to = language_named("python")};
    const word shape = {WORD_NAME, "shape", 5, 0, 0};
    snprintf(text, sizeof text,
             "enum { MOST = 3 };\n\ntypedef struct table {\n    real scale;\n    int at, cells;\n} table;\n\n"
             "HERE real shape(table t, real x, whole i, mask far, int below)\n{\n"
             "    int steps = t.cells;\n    real y = x;\n    if (%s)\n        y = x + 1.0f;\n    return y;\n}\n",
             condition);
    return !kernel_read(&from, text) || !translation_prefix(&t, "vndf") || !translation_want(&t, &from, &shape) ||
           (translate(&t, stdout, &from), kernel_free(&from), 0);
}

int main(int argc, char **argv)
{
    static const char *const shared[] = {"below",    "!below",       "t.cells > 0 && any(far)",
                                         "any(far)", "steps > MOST", "t.at == 0"};
    static const char *const lanes[] = {"x > 0.0f",       "far",         "i > 2",         "less(x, y)",
                                        "below && x > y", "!(x > 0.0f)", "t.scale > 0.0f"};
    if (argc == 2)
        return print(argv[1]);
    for (size_t i = 0; i < sizeof shared / sizeof *shared; i++)
        TEST(printed(argv[0], shared[i]) == 0);
    for (size_t i = 0; i < sizeof lanes / sizeof *lanes; i++)
        TEST(printed(argv[0], lanes[i]) != 0);
    return test_done();
}
