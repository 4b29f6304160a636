/* No formula keeps a build busy for ever: those found to take longest end, with a table or with an error that
 * says why. The seconds are printed. */
#include <time.h>

#include "harness/test.h"
#include "vndf_build.h"

/* A formula that says `piece` as often as fits. */
static const char *repeat(char text[VNDF_LIMIT_EXPRESSION_LENGTH + 1], const char *head, const char *piece)
{
    size_t used = (size_t)sprintf(text, "%s*(1+1e-12*(%s", head, piece), size = strlen(piece);
    while (used + size + 3 < VNDF_LIMIT_EXPRESSION_LENGTH)
        used += (size_t)sprintf(text + used, "+%s", piece);
    strcpy(text + used, "))");
    return text;
}

static void try_formula(const char *slope, size_t max_bytes)
{
    vndf_error error = {VNDF_OK, ""};
    vndf_build_options options = {.max_bytes = max_bytes};
    vndf_source *source = vndf_source_slope_expression(slope, NULL, 0, &error);
    clock_t from = clock();
    vndf_distribution *table = source ? vndf_build(source, &options, NULL, &error) : NULL;
    double seconds = (double)(clock() - from) / CLOCKS_PER_SEC;
    TEST(table || error.status == VNDF_ERROR_DISTRIBUTION || error.status == VNDF_ERROR_TARGET);
    TEST(table || error.message[0]);
    fprintf(stderr, "%.1f s for %.60s, %lu bytes: %s\n", seconds, slope, (unsigned long)max_bytes,
            table ? "a table" : error.message);
    vndf_free(table);
    vndf_source_free(source);
}

int main(void)
{
    static char text[VNDF_LIMIT_EXPRESSION_LENGTH + 1];
    try_formula("exp(-r)*(1+0.9*sin(300*r))", 16384);
    try_formula("exp(-r)*(1+0.9*sin(2000*r))", 1 << 20);
    try_formula(repeat(text, "exp(-r)", "lgamma(2+sin(r))"), 1 << 20);
    try_formula(repeat(text, "exp(-r)*(1+0.9*sin(60*r))", "lgamma(2+r)"), 1 << 20);
    try_formula(repeat(text, "exp(-r)", "r^(1+r)/(1+r^r)"), 1 << 20);
    return test_done();
}
