/* One distribution, one surface and one view shared by eight threads that sample, evaluate and invert give every
 * thread the bits that a single thread gets, for a table and both closed forms. The threads run first: what would
 * be made at the first use, would be made there. test_threads_sanitized.cmake runs this under ThreadSanitizer.
 *
 * Threads are POSIX's where CMake finds them, else C11's. */
#include <stdlib.h>

#include "harness/hash.h"
#include "harness/test.h"

enum { THREADS = 8 };

/* What a thread is given, and its answer. */
typedef struct task {
    const vndf_surface *surface;
    const vndf_view *view; /* shared */
    const char *path;      /* a table that every thread loads as well; may be NULL */
    unsigned long long seed, hash;
    int samples;
} task;

static void run_task(task *t)
{
    unsigned long long state = t->seed;
    t->hash = hash_begin;
    for (int i = 0; i < t->samples; i++) {
        const float x = test_uniform(&state), y = test_uniform(&state), z = test_uniform(&state);
        const float u1 = test_uniform(&state), u2 = test_uniform(&state);
        const vndf_vec3 wi = {2.0f * x - 1.0f, 2.0f * y - 1.0f, 2.0f * z - 1.0f};
        const vndf_view own = vndf_view_from(t->surface, wi);
        vndf_vec3 wm;
        t->hash = hash_sample(t->hash, t->view, u1, u2, &wm);
        t->hash = hash_sample(t->hash, &own, u1, u2, &wm);
        t->hash = hash_others(t->hash, &own, t->surface, wi, wm, x, y);
    }
    vndf_distribution *loaded = t->path ? vndf_load(t->path, NULL) : NULL;
    t->hash = hash_float(t->hash, loaded ? (float)vndf_distribution_info(loaded).bytes : 0.0f);
    vndf_free(loaded);
}

/* ---- threads: start_thread and join_thread give 1 if they could ---------------------------------- */

#if defined(VNDF_TEST_PTHREADS)
#  include <pthread.h>
typedef pthread_t thread;

static void *enter(void *data)
{
    run_task(data);
    return NULL;
}

static int start_thread(thread *t, task *data)
{
    return pthread_create(t, NULL, enter, data) == 0;
}

static int join_thread(thread t)
{
    return pthread_join(t, NULL) == 0;
}
#elif !defined(__STDC_NO_THREADS__) && defined(__STDC_VERSION__)
#  include <threads.h>
typedef thrd_t thread;

static int enter(void *data)
{
    run_task(data);
    return 0;
}

static int start_thread(thread *t, task *data)
{
    return thrd_create(t, enter, data) == thrd_success;
}

static int join_thread(thread t)
{
    return thrd_join(t, NULL) == thrd_success;
}
#else
#  define NO_THREADS
#endif

/* ------------------------------------------------------------------------------------------------- */

#ifdef NO_THREADS
int main(void)
{
    puts("SKIPPED: neither POSIX threads nor those of C11");
    return 0;
}
#else
static void compare(const vndf_distribution *d, const char *name, const char *path)
{
    const vndf_surface surface = {d, 0.3f, 0.1f};
    const vndf_vec3 wi = {0.6f, 0.3f, 0.2f};
    const vndf_view view = vndf_view_from(&surface, wi);
    task tasks[THREADS];
    thread threads[THREADS];
    int started = 0;
    if (!TEST(d != NULL))
        return;
    for (int i = 0; i < THREADS; i++) {
        const task one = {&surface, &view, path, 40u + (unsigned)i, 0, test_quick() ? 4000 : 40000};
        tasks[i] = one;
    }
    while (started < THREADS && start_thread(&threads[started], &tasks[started]))
        started++;
    TEST(started == THREADS);
    for (int i = 0; i < started; i++)
        TEST(join_thread(threads[i]));
    for (int i = 0; i < started; i++) {
        task alone = tasks[i];
        run_task(&alone);
        if (!TEST(alone.hash == tasks[i].hash))
            fprintf(stderr, "  %s: thread %d has %016llx, alone it is %016llx\n", name, i, tasks[i].hash,
                    alone.hash);
        TEST(i == 0 || tasks[i].hash != tasks[0].hash); /* different numbers, different bits */
    }
}

int main(void)
{
    const char *path = VNDF_SOURCE_DIR "/tables/hazy.vndf";
    vndf_error error = {VNDF_OK, ""};
    vndf_distribution *table = vndf_load(path, &error);
    if (!table)
        fprintf(stderr, "%s\n", error.message);
    compare(vndf_ggx(), "ggx", NULL);
    compare(vndf_beckmann(), "beckmann", NULL);
    compare(table, "table", path);
    vndf_free(table);
    return test_done();
}
#endif
