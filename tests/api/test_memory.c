/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every call of the public interface with its k-th allocation failing, whoever asked for it: our own code, HDF5, GSL,
 * FFTW, libyaml, jansson or the C library. Each try is a process of its own, so that a crash is one finding. It ends
 * with GG_OK and the whole answer, or with an error that says so; nothing leaks; no file is left half-written. (Blocks
 * that HDF5 and FFTW keep for themselves are not called leaks: they keep them on success, too.)
 *
 * Here some k of each call, five times as many at night. By hand: MEMORY_TRIES=0 all, MEMORY_ONLY=word some calls,
 * MEMORY_AT=k one, MEMORY_LAST=1 all later ones fail, too, MEMORY_IN=library (failing_malloc.h), MEMORY_HERE=1 all in
 * this process, for a debugger. */
#include <dirent.h>
#include <graingas.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../faults/failing_malloc.h"
#include "memory.h"

static bool ends_with(const char *text, const char *end)
{
  size_t n = strlen(text), tail = strlen(end);
  return n >= tail && strcmp(text + n - tail, end) == 0;
}

/* Outcome of a call: results in memory, and files; those that begin with "new" are its own. */
static void look(const things *t, bool whole, int *litter)
{
  struct dirent **all;
  if (whole) say_things(t);
  const char *const folders[] = {".", "new.sweep"};
  for (int f = 0; f < 2; f++) {
    int n = scandir(folders[f], &all, NULL, alphasort);
    for (int i = 0; i < n; i++) {
      const char *name = all[i]->d_name;
      char path[600];
      snprintf(path, sizeof path, "%s/%s", folders[f], name);
      bool own = *name != '.' && (f == 1 || strncmp(name, "new", 3) == 0);
      bool temporary = strstr(name, "graingas-") || strstr(name, ".work.");
      if (temporary) ++*litter, printf("#   is left: %s\n", path);
      if (own && whole) say_file(path);
      bool some = t->written || t->result || t->comparison; /* a comparison of which one engine failed is written */
      if (own && !whole && !some && !temporary && !strstr(name, "checkpoint") && !ends_with(name, ".sweep") && f == 0)
        ++*litter, printf("#   is there although it failed: %s\n", path);
      free(all[i]);
    }
    if (n >= 0) free(all);
  }
}

static char *reference; /* shared with the processes of the tries */
static const char *home;

static void enter_folder(void)
{
  if (chdir(home) != 0) abort();
  make_copy("there", "try");
  if (chdir("try") != 0) abort();
}

/* Outcome of one try, received from its process. */
typedef struct outcome {
  uint64_t calls, faults, cached;
  int clean, harmless, wrong, ended;
} outcome;

static int wrong(const char *what, const char *message)
{
  printf("#   %s: %.300s; failed was", what, message);
  failing_malloc_where(stdout);
  return 1;
}

static void try_one(const memory_call *call, uint64_t at, bool last, const char *in, outcome *o)
{
  things t = {0};
  gg_error err = {0};
  int litter = 0;
  if (gg_scene_parse(scene_text, "memory", &t.scene, NULL) != GG_OK) abort();
  say_nothing();
  failing_malloc_arm(at, last, in);
  gg_status status = call->work(&t, &err);
  o->calls = failing_malloc_disarm(&o->faults);
  bool whole = status == GG_OK;
  look(&t, whole, &litter);
  clear(&t);
  if (litter) o->wrong += wrong("litter", "");
  if (whole && at && strcmp(said(), reference) != 0) {
    size_t same = 0;
    while (said()[same] == reference[same]) same++;
    o->wrong += wrong("GG_OK, and another answer", said() + (same > 40 ? same - 40 : 0));
  }
  bool reported = lack_was_reported() || strstr(err.message, "memory");
  if (!whole && (!reported || (status != GG_FAILED && status != GG_BAD_FILE))) o->wrong += wrong("said", err.message);
  if (at && failing_malloc_left(NULL, &o->cached)) {
    failing_malloc_left(stdout, NULL);
    o->wrong += wrong("leaks", err.message);
  }
  if (!at) snprintf(reference, MOST_SAID, "%s", said());
  o->clean = !whole, o->harmless = whole;
}

/* HDF5, FFTW, GSL's linear algebra and its solvers end the program where they lack memory in some places, which nobody
 * can keep them from; elsewhere it is our mistake. */
static outcome *ending;

static void end(void)
{
  ending->ended = failing_malloc_was_in("libhdf5") || failing_malloc_was_in("libfftw") ||
                  failing_malloc_was_in("gsl_linalg_") || failing_malloc_was_in("gsl_eigen_") ||
                  failing_malloc_was_in("gsl_multiroot_");
  if (ending->ended) return;
  printf("#   ended; failed was");
  failing_malloc_where(stdout);
  fflush(stdout);
}

static void on_signal(int number)
{
  end();
  signal(number, SIG_DFL);
  raise(number);
}

static void watch(outcome *o)
{
  static char stack[1 << 16]; /* where the other one overflowed, there is none left for the handler */
  const stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
  struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_ONSTACK};
  ending = o;
  if (sigaltstack(&own, NULL) != 0 || sigaction(SIGSEGV, &action, NULL) != 0) abort();
  signal(SIGABRT, on_signal);
  if (atexit(end) != 0) abort();
}

#ifdef COUNTS_LINES
enum { SLOW = 10 };
#else
enum { SLOW = 1 };
#endif

/* In a process of its own. */
static void fork_one(const memory_call *call, uint64_t at, bool last, const char *in, outcome *o)
{
  memset(o, 0, sizeof *o);
  fflush(stdout);
  enter_folder();
  if (getenv("MEMORY_HERE")) { /* for a debugger */
    try_one(call, at, last, in, o);
    return;
  }
  pid_t child = fork();
  if (child == 0) {
    alarm(60 * SLOW);
    watch(o);
    try_one(call, at, last, in, o);
    fflush(stdout);
    failing_malloc_keep_counts();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (o->ended) return;
  o->wrong++;
  printf("#   ended by %s %d\n", WIFSIGNALED(status) ? "signal" : "exit code",
         WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
}

static uint64_t number_of(const char *name, uint64_t otherwise)
{
  const char *text = getenv(name);
  return text ? strtoull(text, NULL, 10) : otherwise;
}

static bool try_all(const memory_call *call, outcome *shared)
{
  const char *in = getenv("MEMORY_IN");
  const bool last = getenv("MEMORY_LAST");
  uint64_t tries = number_of("MEMORY_TRIES", 8), only = number_of("MEMORY_AT", 0);
  fork_one(call, 0, false, in, shared); /* to know the answer, and how many there are */
  const uint64_t all = shared->calls, step = tries && all > tries ? all / tries : 1;
  uint64_t done = 0, clean = 0, harmless = 0, ended = 0, bad = shared->wrong != 0;
  for (uint64_t at = only ? only : 1; at <= all && (!only || at == only); at += step) {
    fork_one(call, at, last, in, shared);
    done++, clean += shared->clean != 0, harmless += shared->harmless != 0, ended += shared->ended != 0,
        bad += shared->wrong != 0;
    if (shared->wrong) printf("# %s, allocation %llu\n", call->name, (unsigned long long)at);
  }
  printf("# | %s | %llu | %llu | %llu | %llu | %llu | %llu |\n", call->name, (unsigned long long)all,
         (unsigned long long)done, (unsigned long long)clean, (unsigned long long)harmless, (unsigned long long)ended,
         (unsigned long long)bad);
  return bad == 0;
}

/* Files that calls resume from and read. */
static void prepare(void)
{
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  gg_comparison *both = NULL;
  gg_sweep *points = NULL;
  const gg_run_options one = {.size = sizeof one, .output = "there.h5"},
                       two = {.size = sizeof two, .output = "both.h5"};
  if (mkdtemp((char *)(uintptr_t)home) == NULL || chdir(home) != 0 || system("mkdir there") != 0 || chdir("there") != 0)
    abort();
  if (gg_scene_parse(scene_text, "memory", &scene, NULL) != GG_OK) abort();
  gg_run(scene, &one, &result, NULL);
  gg_result_free(result);
  gg_compare(scene, &two, &both, NULL);
  gg_comparison_free(both);
  result = NULL;
  gg_scene_set(scene, "output", "{trajectory_every: 5, checkpoint_every: 1.0e-6}", NULL);
  gg_scene_set(scene, "run", "{collisions: 40, warmup: 10, time_limit: 1.0e-9}", NULL);
  const gg_run_options stopped = {.size = sizeof stopped, .output = "x.h5", .checkpoint = "there.checkpoint.h5"};
  gg_run(scene, &stopped, &result, NULL);
  gg_result_free(result);
  gg_scene_free(scene);
  if (gg_sweep_parse(sweep_text, "sweep", &points, NULL) == GG_OK) gg_sweep_run(points, "there.sweep", NULL, NULL);
  gg_sweep_free(points);
}

int main(void)
{
  static char folder[] = "/tmp/graingas-memory-XXXXXX";
  const char *only = getenv("MEMORY_ONLY");
  int failed = 0;
  char command[100];
  home = folder;
  prepare();
  outcome *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  reference = mmap(NULL, MOST_SAID, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED || reference == MAP_FAILED) abort();
  int n = 0;
  while (calls[n].name) n++;
  printf("1..%d\n", n);
  for (int i = 0; i < n; i++) {
    bool skip = only && !strstr(calls[i].name, only);
    bool good = skip || try_all(&calls[i], shared);
    failed += !good;
    printf("%sok %d - %s%s\n", good ? "" : "not ", i + 1, calls[i].name, skip ? " # SKIP" : "");
  }
  snprintf(command, sizeof command, "rm -rf %s", home);
  if (system(command) != 0) return 1;
  return failed != 0;
}
