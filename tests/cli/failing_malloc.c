/* In the place of glibc's, by LD_PRELOAD: allocation number FAIL_AT, from 1, of this process fails, those of the C
 * library itself among them. How many there were is written to descriptor 9. And the step of saving that FAIL_STEP
 * names fails each time. */
#define _DEFAULT_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

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

static int is_step(const char *name)
{
    const char *step = getenv("FAIL_STEP");
    errno = EDQUOT;
    return step && strcmp(step, name) == 0;
}

int fsync(int file)
{
    return is_step("fsync") ? -1 : (int)syscall(SYS_fsync, file);
}

int rename(const char *from, const char *to)
{
    return is_step("rename") ? -1 : renameat(AT_FDCWD, from, AT_FDCWD, to);
}

int _IO_fclose(FILE *file);

int fclose(FILE *file)
{
    const int closed = _IO_fclose(file);
    return is_step("fclose") ? EOF : closed;
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
