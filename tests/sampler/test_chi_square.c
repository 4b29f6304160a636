/* Samples follow the density that vndf_pdf states, and that density has the integral 1: for closed forms and tables,
 * smooth roughness and rough, anisotropic, sheared and leaning surfaces and mixtures, from straight above to below the
 * horizon. It notices a cell, an arc or a lobe that is drawn too often, and a density that is not the one drawn. Seeds
 * are fixed; the level, 0.01, is that of all tests together. test_long_chi_square.c is the same with more samples. */
#include "sampler/chi_square_case.h"

int main(int arguments, char **argument)
{
    return chi_square_main(arguments, argument, test_amount(20000, 100000, 1000000), test_amount(2, 2, 1));
}
