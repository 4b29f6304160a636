/* No input is too hard: every property of tools/evidence/measure/stress.c holds over its product of directions,
 * roughnesses and uniform numbers, for every shipped table, the closed forms, and distributions that are pathological:
 * jumps, a hole at the pole, a narrow ring, an unbounded peak, a tail at the edge of integrability, two scales a
 * hundred apart, and a scale of 1e-9. more_stress takes every other view, as `vndf check --hard` takes all, but of
 * pathological ones every tenth; stress takes every 19th and every 37th. With the name of a shipped table it looks at
 * that one alone. (Matrices and mean slopes: edges.) */
#include "harness/test.h"
#include "evidence/measure/measure.h"
#include "oracle/oracle.h"

static const char *const pathological[] = {
    "step(1-r)",       "exp(-r)*step(r-2)", "exp(-((r-1)/0.02)^2)",          "r^-1.5*exp(-r)",
    "r^-1.75*exp(-r)", "(1+r*r)^-1.55",     "exp(-r*r)+1e4*exp(-(100*r)^2)", "exp(-1e9*r)"};

static void test_distribution(const vndf_distribution *d, const char *name, size_t every)
{
    if (!TEST(d != NULL))
        return;
    const stress_result result = stress_run(d, test_amount(37, every == 1 ? 19 : 37, 2 * every), 1);
    fprintf(stderr, "%-50s %6zu bytes, %zu samples\n", name, vndf_distribution_info(d).bytes, result.samples);
    TEST(result.samples > 30000);
    for (int id = 0; id < STRESS_COUNT; id++) {
        const stress_finding *found = &result.found[id];
        if (TEST(found->failed == 0) & TEST(found->checked > 0))
            continue;
        fprintf(stderr, "  %s: %zu of %zu fail, worst %g at", stress_properties[id].name, found->failed,
                found->checked, found->worst);
        for (int i = 0; i < STRESS_NUMBERS; i++)
            fprintf(stderr, " %s %.9g", stress_numbers[i], (double)found->number[i]);
        fputc('\n', stderr);
    }
}

static void test_shipped(const char *name)
{
    vndf_distribution *table = oracle_shipped(name);
    test_distribution(table, name, 1);
    vndf_free(table);
}

/* Those that have a recipe. */
static void test_all_shipped(void)
{
    FILE *recipes = fopen(VNDF_SOURCE_DIR "/tables/recipes.txt", "r");
    char line[4096];
    int count = 0;
    while (recipes && fgets(line, sizeof line, recipes))
        if (line[0] != '#' && line[0] != '\n') {
            *strstr(line, ".vndf ") = '\0';
            test_shipped(line);
            count++;
        }
    if (recipes)
        fclose(recipes);
    TEST(count > 10);
}

/* Each at one of two sizes, in a long run at both. */
static void test_pathological(void)
{
    for (size_t i = 0; i < 2 * (sizeof pathological / sizeof *pathological); i++) {
        vndf_distribution *table;
        if (!test_long() && i / 2 % 2 != i % 2)
            continue;
        table = oracle_build(pathological[i / 2], i % 2 ? 2048 : 0, NULL, NULL);
        test_distribution(table, pathological[i / 2], 5);
        vndf_free(table);
    }
}

int main(int arguments, char **argument)
{
    if (arguments > 1) {
        test_shipped(argument[1]);
        return test_done();
    }
    test_distribution(vndf_ggx(), "closed ggx", 1);
    test_distribution(vndf_beckmann(), "closed beckmann", 1);
    test_pathological();
    test_all_shipped();
    return test_done();
}
