// Preloaded by ./dev, so that the memory of compilers lies in large pages.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sys/mman.h>

void *mmap(void *address, size_t size, int protection, int flags, int file, off_t offset)
{
    static void *(*next)(void *, size_t, int, int, int, off_t);
    if (!next) next = (void *(*)(void *, size_t, int, int, int, off_t))dlsym(RTLD_NEXT, "mmap");
    void *memory = next(address, size, protection, flags, file, offset);
    if (memory != MAP_FAILED && (flags & MAP_ANONYMOUS) && size >= 1 << 20) madvise(memory, size, MADV_HUGEPAGE);
    return memory;
}
