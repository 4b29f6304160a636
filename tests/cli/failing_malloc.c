/* In the place of the C library's, by LD_PRELOAD: allocation number FAIL_AT, from 1, of this process fails, those of the
 * C library itself among them. How many there were is written to the file FAIL_COUNT. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

static long count, failing = -1;

static int fails(void)
{
    if (failing < 0) {
        const char *at = getenv("FAIL_AT");
        failing = at ? atol(at) : 0;
        unsetenv("LD_PRELOAD"); /* children are left alone */
    }
    errno = ENOMEM;
    return __atomic_add_fetch(&count, 1, __ATOMIC_SEQ_CST) == failing;
}

void *malloc(size_t size)
{
    static void *(*real)(size_t);
    *(void **)&real = real ? *(void **)&real : dlsym(RTLD_NEXT, "malloc");
    return fails() ? NULL : real(size);
}

void *calloc(size_t n, size_t size)
{
    static void *(*real)(size_t, size_t);
    *(void **)&real = real ? *(void **)&real : dlsym(RTLD_NEXT, "calloc");
    return fails() ? NULL : real(n, size);
}

void *realloc(void *block, size_t size)
{
    static void *(*real)(void *, size_t);
    *(void **)&real = real ? *(void **)&real : dlsym(RTLD_NEXT, "realloc");
    return fails() ? NULL : real(block, size);
}

__attribute__((destructor)) static void tell(void)
{
    const char *name = getenv("FAIL_COUNT");
    FILE *to = name ? fopen(name, "w") : NULL;
    if (to && fprintf(to, "%ld", count) > 0)
        fclose(to);
}
