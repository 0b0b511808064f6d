// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// Preloaded into a program (LD_PRELOAD), makes a file operation fail or ends the program there.
//   FAULT_FOLDER  operations on files below it are counted, over all processes
//   FAULT_AT      number of the operation, from 1 on
//   FAULT_KIND    ENOSPC: it and all later ones fail, as on a full disk; EIO: it alone fails;
//                 KILL: the program is killed before it; here removals count too
//   FAULT_LOG     file that receives the operation's name and file
// Messages in a log.txt are left alone.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long* g_count = NULL;  // shared with forked processes
static long g_at = 0;
static const char* g_folder = NULL;
static const char* g_kind = "";

__attribute__((constructor)) static void begin(void) {
  const char* at = getenv("FAULT_AT");
  const char* kind = getenv("FAULT_KIND");
  g_folder = getenv("FAULT_FOLDER");
  if (at == NULL || kind == NULL || g_folder == NULL) return;
  g_at = atol(at);
  g_kind = kind;
  void* page =
      mmap(NULL, sizeof(atomic_long), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page != MAP_FAILED) g_count = page;
}

static void* next(const char* name) {
  return dlsym(RTLD_NEXT, name);
}

static void note(const char* operation, const char* path) {
  const char* log = getenv("FAULT_LOG");
  if (log == NULL) return;
  int (*real_open)(const char*, int, ...) = (int (*)(const char*, int, ...))next("open");
  ssize_t (*real_write)(int, const void*, size_t) =
      (ssize_t(*)(int, const void*, size_t))next("write");
  const int file = real_open(log, O_WRONLY | O_CREAT | O_APPEND, 0666);
  if (file < 0) return;
  char line[PATH_MAX + 64];
  const int length = snprintf(line, sizeof(line), "%s %s\n", operation, path);
  if (length > 0 && real_write(file, line, (size_t)length) < 0) errno = EIO;
  close(file);
}

// The error of an operation on a file; 0 if it is to be done.
static int fault(const char* operation, const char* path, int removal) {
  if (g_count == NULL || path == NULL) return 0;
  const size_t length = strlen(g_folder);
  if (strncmp(path, g_folder, length) != 0) return 0;
  const char* name = strrchr(path, '/');
  if (name != NULL && strcmp(name, "/log.txt") == 0) return 0;
  const int kills = strcmp(g_kind, "KILL") == 0;
  if (removal && !kills) return 0;
  const long number = atomic_fetch_add(g_count, 1) + 1;
  const int full = strcmp(g_kind, "ENOSPC") == 0;
  if (number < g_at || (number > g_at && !full)) return 0;
  if (number == g_at) note(operation, path);
  if (kills) kill(getpid(), SIGKILL);
  return full ? ENOSPC : EIO;
}

static int fault_of_open(const char* operation, int file, int removal) {
  if (g_count == NULL) return 0;
  char link[64];
  char path[PATH_MAX];
  snprintf(link, sizeof(link), "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof(path) - 1);
  if (length < 0) return 0;
  path[length] = '\0';
  return fault(operation, path, removal);
}

static int fault_of_file(const char* operation, int file) {
  return fault_of_open(operation, file, 0);
}

// Fails with the error of the operation, if it has one.
#define FAIL_IF(error_of, failure) \
  do {                             \
    const int error = (error_of);  \
    if (error != 0) {              \
      errno = error;               \
      return (failure);            \
    }                              \
  } while (0)

static int writes(int flags) {
  return (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0;
}

#define DEFINE_OPEN(name)                                                    \
  int name(const char* path, int flags, ...) {                               \
    va_list arguments;                                                       \
    va_start(arguments, flags);                                              \
    const mode_t mode = (flags & O_CREAT) ? va_arg(arguments, mode_t) : 0;   \
    va_end(arguments);                                                       \
    if (writes(flags)) FAIL_IF(fault("open", path, 0), -1);                  \
    return ((int (*)(const char*, int, ...))next(#name))(path, flags, mode); \
  }
DEFINE_OPEN(open)
DEFINE_OPEN(open64)

#define DEFINE_FOPEN(name)                                                    \
  FILE* name(const char* path, const char* mode) {                            \
    if (strpbrk(mode, "wa+") != NULL) FAIL_IF(fault("fopen", path, 0), NULL); \
    return ((FILE * (*)(const char*, const char*)) next(#name))(path, mode);  \
  }
DEFINE_FOPEN(fopen)
DEFINE_FOPEN(fopen64)

ssize_t write(int file, const void* bytes, size_t size) {
  FAIL_IF(fault_of_file("write", file), -1);
  return ((ssize_t(*)(int, const void*, size_t))next("write"))(file, bytes, size);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  FAIL_IF(fault_of_file("writev", file), -1);
  return ((ssize_t(*)(int, const struct iovec*, int))next("writev"))(file, parts, count);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  FAIL_IF(fault_of_file("fwrite", fileno(file)), 0);
  return ((size_t(*)(const void*, size_t, size_t, FILE*))next("fwrite"))(bytes, size, count, file);
}

int fsync(int file) {
  FAIL_IF(fault_of_file("fsync", file), -1);
  return ((int (*)(int))next("fsync"))(file);
}

int ftruncate(int file, off_t size) {
  FAIL_IF(fault_of_file("ftruncate", file), -1);
  return ((int (*)(int, off_t))next("ftruncate"))(file, size);
}

int rename(const char* from, const char* to) {
  FAIL_IF(fault("rename", to, 0), -1);
  return ((int (*)(const char*, const char*))next("rename"))(from, to);
}

int mkdir(const char* path, mode_t mode) {
  FAIL_IF(fault("mkdir", path, 0), -1);
  return ((int (*)(const char*, mode_t))next("mkdir"))(path, mode);
}

int remove(const char* path) {
  FAIL_IF(fault("remove", path, 1), -1);
  return ((int (*)(const char*))next("remove"))(path);
}

int unlink(const char* path) {
  FAIL_IF(fault("unlink", path, 1), -1);
  return ((int (*)(const char*))next("unlink"))(path);
}

// A name in an open folder.
int unlinkat(int folder, const char* name, int flags) {
  if (g_count != NULL && name[0] != '/' && folder != AT_FDCWD) {
    FAIL_IF(fault_of_open("unlinkat", folder, 1), -1);
  } else {
    FAIL_IF(fault("unlinkat", name, 1), -1);
  }
  return ((int (*)(int, const char*, int))next("unlinkat"))(folder, name, flags);
}
