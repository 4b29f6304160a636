/* One distribution and one view, shared by eight threads that sample, evaluate, invert and load, give every thread the
 * bits that it gets alone. The threads run first: what would be made at the first use, would be made there.
 * threads_valgrind looks for data races. */
#include "harness/hash.h"

#if !defined(VNDF_TEST_PTHREADS)
int main(void)
{
    puts("SKIPPED: no POSIX threads");
    return 0;
}
#else
#  include <pthread.h>

enum { THREADS = 8 };

typedef struct task {
    const vndf_view *view; /* shared, as the distribution */
    const vndf_distribution *d;
    const char *path; /* a table that every thread loads as well; may be NULL */
    unsigned long long seed, hash;
} task;

static void *run_task(void *data)
{
    task *t = data;
    unsigned long long state = t->seed;
    t->hash = hash_begin;
    for (unsigned long i = 0; i < (test_quick() ? 8000 : 60000); i++) {
        vndf_vec3 wm;
        t->hash = hash_step(t->hash, t->d, i, &state);
        t->hash = hash_sample(t->hash, t->view, test_uniform(&state), test_uniform(&state), &wm);
    }
    vndf_distribution *loaded = t->path ? vndf_load(t->path, NULL) : NULL;
    t->hash = hash_float(t->hash, loaded ? (float)vndf_distribution_info(loaded).bytes : 0.0f);
    vndf_free(loaded);
    return NULL;
}

static void compare(const vndf_distribution *d, const char *name, const char *path)
{
    const vndf_surface surface = {d, 0.3f, 0.1f};
    const vndf_view view = vndf_view_from(&surface, (vndf_vec3){0.6f, 0.3f, 0.2f});
    task tasks[THREADS];
    pthread_t threads[THREADS];
    int started = 0;
    for (int i = 0; i < THREADS; i++)
        tasks[i] = (task){&view, d, path, 40u + (unsigned)i, 0};
    while (started < THREADS && pthread_create(&threads[started], NULL, run_task, &tasks[started]) == 0)
        started++;
    TEST(started == THREADS);
    for (int i = 0; i < started; i++)
        TEST(pthread_join(threads[i], NULL) == 0);
    for (int i = 0; i < started; i++) {
        task alone = tasks[i];
        run_task(&alone);
        if (!TEST(alone.hash == tasks[i].hash))
            fprintf(stderr, "  %s: thread %d\n", name, i);
        TEST(i == 0 || tasks[i].hash != tasks[0].hash); /* different numbers, different bits */
    }
}

int main(void)
{
    const char *path = VNDF_SOURCE_DIR "/tables/hazy.vndf";
    vndf_distribution *table = vndf_load(path, NULL);
    compare(vndf_ggx(), "ggx", NULL);
    compare(vndf_beckmann(), "beckmann", NULL);
    if (TEST(table != NULL))
        compare(table, "table", path);
    vndf_free(table);
    return test_done();
}
#endif
