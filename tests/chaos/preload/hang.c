/* Makes calls on files below a folder wait while a flag is there, as the kernel does while a file server is away.
 *
 * HANG_BELOW names the folder, HANG_WHILE the flag's file; `tests.chaos.hang` compiles and preloads this library.
 */

#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static int below(const char *path) {
    const char *folder = getenv("HANG_BELOW");
    size_t length = folder ? strlen(folder) : 0;
    return path && length && strncmp(path, folder, length) == 0 && (path[length] == '/' || path[length] == 0);
}

/* The calls are made raw: the library's own would come here again, or to another preloaded library. */
static void wait_while_away(const char *path) {
    const char *flag = getenv("HANG_WHILE");
    if (!flag || !below(path))
        return;
    while (syscall(SYS_faccessat, AT_FDCWD, flag, F_OK) == 0) {
        struct timespec pause = {0, 20000000};
        syscall(SYS_nanosleep, &pause, NULL);
    }
}

static void wait_for_descriptor(int descriptor) {
    char name[64], path[4096];
    snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
    long length = syscall(SYS_readlinkat, AT_FDCWD, name, path, sizeof path - 1);
    if (length > 0) {
        path[length] = 0;
        wait_while_away(path);
    }
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

#define OF_PATH(type, name, parameters, path, arguments) \
    type name parameters { \
        wait_while_away(path); \
        return NEXT(name) arguments; \
    }

#define OF_DESCRIPTOR(type, name, parameters, descriptor, arguments) \
    type name parameters { \
        wait_for_descriptor(descriptor); \
        return NEXT(name) arguments; \
    }

#define OPENING(name, parameters, path, before) \
    int name parameters { \
        va_list more; \
        va_start(more, flags); \
        mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(more, mode_t) : 0; \
        va_end(more); \
        wait_while_away(path); \
        return NEXT(name)(before, flags, mode); \
    }

#define COMMA ,

OPENING(open, (const char *path, int flags, ...), path, path)
OPENING(open64, (const char *path, int flags, ...), path, path)
OPENING(openat, (int folder, const char *path, int flags, ...), path, folder COMMA path)
OPENING(openat64, (int folder, const char *path, int flags, ...), path, folder COMMA path)
OF_PATH(int, stat, (const char *path, struct stat *found), path, (path, found))
OF_PATH(int, stat64, (const char *path, struct stat64 *found), path, (path, found))
OF_PATH(int, lstat, (const char *path, struct stat *found), path, (path, found))
OF_PATH(int, lstat64, (const char *path, struct stat64 *found), path, (path, found))
OF_PATH(int, fstatat, (int folder, const char *path, struct stat *found, int flags), path, (folder, path, found, flags))
OF_PATH(int, fstatat64, (int folder, const char *path, struct stat64 *found, int flags), path,
        (folder, path, found, flags))
OF_PATH(int, statvfs, (const char *path, struct statvfs *found), path, (path, found))
OF_PATH(int, statvfs64, (const char *path, struct statvfs64 *found), path, (path, found))
OF_PATH(int, access, (const char *path, int mode), path, (path, mode))
OF_PATH(int, mkdir, (const char *path, mode_t mode), path, (path, mode))
OF_PATH(int, rmdir, (const char *path), path, (path))
OF_PATH(int, unlink, (const char *path), path, (path))
OF_PATH(int, rename, (const char *from, const char *to), from, (from, to))
OF_PATH(DIR *, opendir, (const char *path), path, (path))
OF_DESCRIPTOR(int, fsync, (int descriptor), descriptor, (descriptor))
OF_DESCRIPTOR(ssize_t, read, (int descriptor, void *buffer, size_t length), descriptor, (descriptor, buffer, length))
OF_DESCRIPTOR(ssize_t, write, (int descriptor, const void *buffer, size_t length), descriptor,
              (descriptor, buffer, length))
