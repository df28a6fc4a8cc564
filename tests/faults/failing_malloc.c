/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "failing_malloc.h"

#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <link.h>
#include <malloc.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

/* glibc's own functions, since this file replaces malloc and its relatives. */
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t n, size_t size);
extern void *__libc_realloc(void *block, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *block);

enum { SLOTS = 1 << 17, FRAMES = 24 };

/* Entry of a hash table by address: blocks that were allocated while armed. A freed block keeps its slot, with number
 * 0, so that open addressing finds the others. */
typedef struct slot {
  void *block;
  const void *caller;
  uint64_t number;
} slot;

static struct {
  atomic_bool armed;
  bool last;
  uint64_t at;
  const char *in;
  bool (*begun)(void);
  _Atomic uint64_t calls, faults;
  void *trace[FRAMES];
  int depth;
  pthread_mutex_t lock;
  slot live[SLOTS];
} state = {.lock = PTHREAD_MUTEX_INITIALIZER};

static uintptr_t libc_from, libc_to;

static int find_libc(struct dl_phdr_info *about, size_t size, void *context)
{
  (void)size, (void)context;
  if (!strstr(about->dlpi_name, "/libc.so")) return 0;
  libc_from = about->dlpi_addr;
  for (int i = 0; i < about->dlpi_phnum; i++) {
    uintptr_t end = about->dlpi_addr + about->dlpi_phdr[i].p_vaddr + about->dlpi_phdr[i].p_memsz;
    if (end > libc_to) libc_to = end;
  }
  return 1;
}

/* Caller of an allocation; if it is the C library (strdup and others), the function that called the C library. */
static const void *behind(const void *caller)
{
  void *trace[12];
  uintptr_t at = (uintptr_t)caller;
  if (at < libc_from || at >= libc_to) return caller;
  int n = backtrace(trace, 12);
  for (int i = 3; i < n; i++)
    if ((uintptr_t)trace[i] < libc_from || (uintptr_t)trace[i] >= libc_to) return trace[i];
  return caller;
}

void failing_malloc_arm(uint64_t at, int last, const char *in)
{
  void *warm[1];
  if (backtrace(warm, 1) < 0) abort(); /* the first time it loads a library */
  dl_iterate_phdr(find_libc, NULL);
  memset(state.live, 0, sizeof state.live);
  state.at = at, state.last = last, state.in = in;
  state.depth = 0;
  atomic_store(&state.calls, 0);
  atomic_store(&state.faults, 0);
  atomic_store(&state.armed, true);
}

void failing_malloc_arm_from(bool (*begun)(void))
{
  state.begun = begun;
  failing_malloc_arm(1, true, NULL);
}

uint64_t failing_malloc_disarm(uint64_t *faults)
{
  atomic_store(&state.armed, false);
  state.begun = NULL;
  if (faults) *faults = atomic_load(&state.faults);
  return atomic_load(&state.calls);
}

static bool is_in(const void *caller, const char *library)
{
  Dl_info about;
  return dladdr(caller, &about) && about.dli_fname && strstr(about.dli_fname, library);
}

static size_t slot_of(const void *block)
{
  return ((uintptr_t)block >> 4) * UINT64_C(0x9e3779b97f4a7c15) >> 47;
}

static void remember(void *block, const void *caller, uint64_t number)
{
  if (!block || !state.at || !atomic_load(&state.armed)) return;
  const void *whose = behind(caller);
  pthread_mutex_lock(&state.lock);
  size_t i = slot_of(block), tries = 0;
  while (state.live[i].block && state.live[i].block != block && tries++ < SLOTS) i = (i + 1) % SLOTS;
  state.live[i] = (slot){block, whose, number};
  pthread_mutex_unlock(&state.lock);
}

/* Also after it was disarmed: that is when what is left is freed. */
static void forget(const void *block)
{
  if (!block || !state.at) return;
  pthread_mutex_lock(&state.lock);
  for (size_t i = slot_of(block), tries = 0; state.live[i].block && tries < SLOTS; i = (i + 1) % SLOTS, tries++)
    if (state.live[i].block == block) {
      state.live[i].number = 0;
      break;
    }
  pthread_mutex_unlock(&state.lock);
}

/* True: this one fails. */
static bool count(const void *caller, uint64_t *number)
{
  *number = 0;
  if (!atomic_load(&state.armed) || (state.in && !is_in(caller, state.in))) return false;
  if (state.begun && !state.begun()) return false;
  *number = atomic_fetch_add(&state.calls, 1) + 1;
  if (*number != state.at && !(state.last && *number > state.at)) return false;
  if (atomic_fetch_add(&state.faults, 1) == 0) state.depth = backtrace(state.trace, FRAMES);
  errno = ENOMEM;
  return true;
}

#define TAKE(call)                                                                                                     \
  uint64_t number;                                                                                                     \
  const void *caller = __builtin_return_address(0);                                                                    \
  if (count(caller, &number)) return NULL;                                                                             \
  void *block = call;                                                                                                  \
  remember(block, caller, number);                                                                                     \
  return block

void *malloc(size_t size)
{
  TAKE(__libc_malloc(size));
}

void *calloc(size_t n, size_t size)
{
  TAKE(__libc_calloc(n, size));
}

void *aligned_alloc(size_t alignment, size_t size)
{
  TAKE(__libc_memalign(alignment, size));
}

void *memalign(size_t alignment, size_t size)
{
  TAKE(__libc_memalign(alignment, size));
}

int posix_memalign(void **to, size_t alignment, size_t size)
{
  uint64_t number;
  const void *caller = __builtin_return_address(0);
  if (count(caller, &number)) return ENOMEM;
  *to = __libc_memalign(alignment, size);
  remember(*to, caller, number);
  return *to ? 0 : ENOMEM;
}

void *realloc(void *old, size_t size)
{
  uint64_t number;
  const void *caller = __builtin_return_address(0);
  if (count(caller, &number)) return NULL;
  forget(old);
  void *block = __libc_realloc(old, size);
  remember(block, caller, number);
  return block;
}

/* The library asks for address space to see whether there is memory (gg_base_memory_is_room). */
void *mmap(void *at, size_t size, int allows, int kind, int file, off_t from)
{
  uint64_t number;
  if (count(__builtin_return_address(0), &number)) return MAP_FAILED;
  return (void *)syscall(SYS_mmap, at, size, allows, kind, file, from);
}

void free(void *block)
{
  forget(block);
  __libc_free(block);
}

void failing_malloc_where(FILE *to)
{
  for (int i = 2; i < state.depth; i++) {
    Dl_info about;
    if (!dladdr(state.trace[i], &about) || !about.dli_fname) continue;
    const char *slash = strrchr(about.dli_fname, '/');
    fprintf(to, " %s+%#lx", slash ? slash + 1 : about.dli_fname,
            (unsigned long)((const char *)state.trace[i] - (const char *)about.dli_fbase));
    if (about.dli_sname) fprintf(to, "(%s)", about.dli_sname);
  }
  fprintf(to, "\n");
}

static bool is_called(const void *caller, const char *name)
{
  Dl_info about;
  return dladdr(caller, &about) && about.dli_sname && strstr(about.dli_sname, name);
}

int failing_malloc_was_in(const char *library)
{
  for (int i = 2; i < state.depth; i++)
    if (is_in(state.trace[i], library) || is_called(state.trace[i], library)) return 1;
  return 0;
}

/* HDF5 and FFTW keep blocks for the next time, and the loader a library that the C library turns to where the file of
 * users' names cannot be read; GSL's matrices leave their head behind where their body fails; libyaml
 * 0.2.5 the members of a map or list where its list of nodes cannot grow for it, and the document that it gives up is
 * nobody else's. */
static bool is_of_a_cache(const void *caller)
{
  const char *const loads = "yaml_parser_load";
  return is_in(caller, "ld-linux") || is_in(caller, "libhdf5") || is_in(caller, "libfftw") || is_in(caller, "libgsl") ||
         (is_called(caller, loads) && failing_malloc_was_in(loads));
}

size_t failing_malloc_left(FILE *to, size_t *cached)
{
  size_t n = 0;
  if (cached) *cached = 0;
  for (size_t i = 0; i < SLOTS; i++) {
    const slot *s = &state.live[i];
    Dl_info about;
    if (!s->block || !s->number) continue;
    if (is_of_a_cache(s->caller)) {
      if (cached) ++*cached;
      continue;
    }
    n++;
    if (to && n <= 20 && dladdr(s->caller, &about))
      fprintf(to, "  left: number %llu, %zu bytes, by %s+%#lx%s%s\n", (unsigned long long)s->number,
              malloc_usable_size(s->block), about.dli_fname,
              (unsigned long)((const char *)s->caller - (const char *)about.dli_fbase), about.dli_sname ? " " : "",
              about.dli_sname ? about.dli_sname : "");
  }
  return n;
}

/* Put before the C library of a whole program. */
static void report(void)
{
  const char *path = getenv("MALLOC_REPORT");
  uint64_t faults, calls = failing_malloc_disarm(&faults);
  FILE *to = path ? fopen(path, "w") : NULL;
  if (!to) return;
  fprintf(to, "%llu %llu", (unsigned long long)calls, (unsigned long long)faults);
  failing_malloc_where(to);
  fclose(to);
}

__attribute__((constructor)) static void begin(void)
{
  const char *at = getenv("MALLOC_FAIL_AT");
  if (!at) return;
  atexit(report);
  failing_malloc_arm(strtoull(at, NULL, 10), getenv("MALLOC_FAIL_LAST") != NULL, getenv("MALLOC_FAIL_IN"));
}
