/* What test_chi_square.c asks, with many samples of every view of one subject: test_long_chi_square SUBJECT SAMPLES. */
#include "sampler/chi_square_case.h"

int main(int arguments, char **argument)
{
    size_t samples = arguments > 2 ? strtoul(argument[2], NULL, 10) : (size_t)1 << 20;
    return chi_square_main(arguments, argument, samples, 1);
}
