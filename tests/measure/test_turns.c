/* Turns are taken as they are promised: the first is taken twice and counted once, no fewer than the least and no more
 * than the most, quartiles are those of each series, a series without numbers has none, and a turn may stop it. */
#include "harness/test.h"
#include "measure/turns.h"

enum { SERIES = 3 };

typedef struct record {
    size_t taken, last, stop_at; /* stop_at: the call that stops; 0: none */
} record;

/* Numbers 0, -turn, none; the first call, which warms up, gives one that would show. */
static int take(void *user, size_t turn, double *number)
{
    record *r = user;
    TEST(isnan(number[0]) && isnan(number[1]) && isnan(number[2]));
    r->last = turn;
    number[0] = r->taken == 0 ? 1000 : (double)((turn * 7) % 11);
    number[1] = -(double)turn;
    return ++r->taken != r->stop_at;
}

static void test_quartiles(void)
{
    record r = {0, 0, 0};
    turns_quartiles found[SERIES];
    const turns_plan plan = {.series = SERIES, .least = 11, .most = 11, .take = take, .user = &r};
    TEST(turns_run(&plan, found) == VNDF_OK);
    TEST(r.taken == 12 && r.last == 10);
    TEST_NEAR(found[0].low, 2, 0); /* of 0 to 10, in another order */
    TEST_NEAR(found[0].median, 5, 0);
    TEST_NEAR(found[0].high, 8, 0);
    TEST_NEAR(found[1].median, -5, 0);
    TEST(isnan(found[2].low) && isnan(found[2].median) && isnan(found[2].high));
}

static void test_counts(void)
{
    record hurried = {0, 0, 0}, patient = {0, 0, 0};
    turns_quartiles found[SERIES];
    turns_plan plan = {.series = SERIES, .least = 7, .most = 20, .seconds = -1, .take = take, .user = &hurried};
    TEST(turns_run(&plan, found) == VNDF_OK && hurried.taken == 8);
    plan.seconds = 1e9;
    plan.user = &patient;
    TEST(turns_run(&plan, found) == VNDF_OK && patient.taken == 21);
}

static void test_stops(void)
{
    for (size_t at = 1; at < 5; at++) {
        record r = {0, 0, at};
        turns_quartiles found[SERIES];
        const turns_plan plan = {.series = SERIES, .least = 7, .most = 7, .take = take, .user = &r};
        TEST(turns_run(&plan, found) == VNDF_ERROR_ARGUMENT && r.taken == at);
    }
}

static void count_run(void *user)
{
    ++*(int *)user;
}

static void test_seconds(void)
{
    int runs = 0;
    double seconds = turns_seconds(count_run, &runs);
    TEST(runs > 2 && runs <= 101); /* too short for the clock: repeated */
    TEST(seconds >= 0 && seconds < 1);
}

int main(void)
{
    test_quartiles();
    test_counts();
    test_stops();
    test_seconds();
    return test_done();
}
