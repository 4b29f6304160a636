/* What test_chi_square.c asks, with 64 Mi samples of every view. */
#include "sampler/chi_square_case.h"

int main(int arguments, char **argument)
{
    return chi_square_main(arguments, argument, (size_t)1 << (test_quick() ? 20 : 26));
}
