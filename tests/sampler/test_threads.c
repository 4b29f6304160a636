/* One distribution and one view, shared by eight threads that sample, evaluate, invert and load, give every thread
 * the bits that it gets alone. The threads run first: what would be made at the first use, would be made there.
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

static const char path[] = VNDF_SOURCE_DIR "/tables/hazy.vndf";

typedef struct task {
    const vndf_distribution *d; /* shared, as the view */
    const vndf_view *view;
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
    vndf_free(vndf_load(path, NULL));
    return NULL;
}

static void compare(const vndf_distribution *d, const char *name)
{
    const vndf_surface surface = {d, 0.3f, 0.1f};
    const vndf_view view = vndf_view_from(&surface, (vndf_vec3){0.6f, 0.3f, 0.2f});
    task tasks[THREADS];
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        tasks[i] = (task){d, &view, 40u + (unsigned)i, 0};
        if (!TEST(pthread_create(&threads[i], NULL, run_task, &tasks[i]) == 0))
            exit(test_done());
    }
    for (int i = 0; i < THREADS; i++)
        TEST(pthread_join(threads[i], NULL) == 0);
    for (int i = 0; i < THREADS; i++) {
        task alone = tasks[i];
        run_task(&alone);
        if (!(TEST(alone.hash == tasks[i].hash) & TEST(i == 0 || alone.hash != tasks[0].hash)))
            fprintf(stderr, "  %s: thread %d\n", name, i);
    }
}

int main(void)
{
    vndf_distribution *table = vndf_load(path, NULL);
    compare(vndf_ggx(), "ggx");
    compare(vndf_beckmann(), "beckmann");
    if (TEST(table != NULL))
        compare(table, "table");
    vndf_free(table);
    return test_done();
}
#endif
