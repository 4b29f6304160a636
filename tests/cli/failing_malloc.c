/* In the place of glibc's, by LD_PRELOAD: allocation number FAIL_AT, from 1, of this process fails, those of the C
 * library itself among them. How many there were is written to descriptor 9. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *block, size_t size);

static long count, failing;

static int fails(void)
{
    errno = ENOMEM;
    return __atomic_add_fetch(&count, 1, __ATOMIC_SEQ_CST) == failing;
}

void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    return fails() ? NULL : __libc_calloc(n, size);
}

void *realloc(void *block, size_t size)
{
    return fails() ? NULL : __libc_realloc(block, size);
}

/* Children are left alone. */
__attribute__((constructor)) static void begin(void)
{
    const char *at = getenv("FAIL_AT");
    failing = at ? atol(at) : 0;
    unsetenv("LD_PRELOAD");
}

__attribute__((destructor)) static void tell(void)
{
    dprintf(9, "%ld", count);
}
