/* Numbers that tests and oracles share. */
#ifndef TESTS_HARNESS_CONSTANTS_H
#define TESTS_HARNESS_CONSTANTS_H

static const double PI = 3.14159265358979323846;

#endif
