/* What is promised of samples and densities holds where the caller has the processor flush denormals to zero and read
 * them as zero, as renderers do: all that test_stress asks, by single calls. test_batch has their bits for batches. */
#include "evidence/measure/stress.h"
#include "sampler/seen.h"

static void test_subject(const subject *of, size_t index)
{
    if (index >= 2 && index % 3 != 2)
        return;
    set_flushing(1);
    stress_result result = stress_run(of->d, test_amount(73, 37, 19), 1);
    set_flushing(0);
    for (int id = 0; id < STRESS_COUNT; id++)
        if (!(TEST(result.found[id].failed == 0) & TEST(result.found[id].checked > 0)))
            fprintf(stderr, "  %s, %s: worst %g\n", of->name, stress_properties[id].name, result.found[id].worst);
}

int main(int arguments, char **argument)
{
    if (!set_flushing(0))
        puts("SKIPPED: no way to flush denormals is known here");
    return subjects_test(arguments, argument, test_subject);
}
