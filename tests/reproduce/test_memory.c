/* A figure whose points are done, read and drawn with each of our own allocations, and of jansson's, which come through
 * ours, failing in turn (some of them; more where lines are counted): it ends well, or says that memory lacked; nothing
 * leaks, and its files are whole. Each try is a process of its own. */
#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../faults/failing_malloc.h"
#include "reproduce/figures.h"

#ifdef COUNTS_LINES
enum { TRIES = 250 };
#else
enum { TRIES = 40 };
#endif

static const char yaml[] =
    "figure: thesis 9.9\n"
    "shows: every kind of panel\n"
    "sweeps:\n"
    "  means: {flow: usf, engine: dsmc, dsmc: {particles: 100}, measure: [rheology, velocity_distributions],\n"
    "    run: {collisions: 60, warmup: 10}, vary: {collision.e: [0.8, 0.9], phi: [0.05, 0.1]}, sweep: {does: run}}\n"
    "  frames: {flow: usf, engine: md, particles: 80, run: {collisions: 40, warmup: 5}, vary: {phi: [0.1]},\n"
    "    output: {trajectory_every: 4}, sweep: {does: run}}\n"
    "quick: {run.seed: 3, vary: {phi: [0.08, 0.1]}}\n"
    "panels:\n"
    "  - {title: means, of: means, x: {key: collision.e}, y: {quantity: [temperature, N1]}, lines: {by: phi},\n"
    "     theories: [lun1991], guides: [{label: one, as: 1}]}\n"
    "  - {of: means, x: {key: phi, log: true}, y: {quantity: temperature, relative_to: {phi: 0.1}},\n"
    "     where: {collision.e: [0.8, 0.9]}, lines: {by: collision.e}}\n"
    "  - {of: means, x: {number: kurtosis}, y: {number: kurtosis, curve: velocity_distribution_Cx}}\n"
    "  - {of: means, x: {bins: 2}, y: {curve: velocity_distribution_Cx, log: true}, lines: {by: collision.e}}\n"
    "  - {of: frames, y: {series: [temperature, N1]}}\n"
    "  - {of: frames, y: {frames: velocity}}\n"
    "  - {of: frames, y: {snapshot: zy}}\n"
    "numbers:\n"
    "  - {what: T, sweep: means, paper: 0.70, of: temperature, at: {phi: 0.1, collision.e: 0.8}, theories: [lun1991]}\n"
    "  - {what: power, sweep: means, paper: -1, over: collision.e, x: 1-x^2, find: exponent, of: temperature}\n";
enum { FILES = 7 };

static gg_status reproduce(gg_error *err)
{
  gg_figure_entry e;
  const gg_reproduce_options options = {.quick = 1, .folder = "out"};
  GG_TRY(gg_reproduce_entry_read(&e, "thesis-9.09.yaml", yaml, err));
  gg_status status = gg_reproduce_figure_reproduce(&e, &options, err);
  gg_reproduce_entry_clear(&e);
  return status;
}

/* Of the files when nothing failed, in the order of their names; clocks and HDF5's own bytes are the same then. */
static off_t size_of[FILES];

/* Its files and no others, as large as ever. Those of a try stay for the next, which does not write all of them. */
static bool are_files_whole(bool first)
{
  struct dirent **all;
  int whole = 0, n = scandir("out", &all, NULL, alphasort);
  bool good = true;
  for (int i = 0; i < n; i++) {
    char path[400];
    struct stat about;
    snprintf(path, sizeof path, "out/%s", all[i]->d_name);
    if (strncmp(all[i]->d_name, "thesis-9.09", 11) == 0 && stat(path, &about) == 0 && whole < FILES) {
      if (first) size_of[whole] = about.st_size;
      good = good && about.st_size == size_of[whole++];
    } else if (all[i]->d_name[0] != '.' && strcmp(all[i]->d_name, "figures.sweep") != 0)
      good = false;
    if (strstr(all[i]->d_name, "graingas-")) good = false;
    free(all[i]);
  }
  if (n >= 0) free(all);
  return good && whole == FILES;
}

static void wrong(uint64_t at, const char *what, const char *message)
{
  printf("# allocation %llu: %s: %s; failed was", (unsigned long long)at, what, message);
  failing_malloc_where(stdout);
  fflush(stdout);
  _exit(1);
}

static void try_one(uint64_t at)
{
  gg_error err = {0};
  uint64_t faults;
  alarm(600);
  failing_malloc_arm(at, 0, "reproduce_memory");
  gg_status status = reproduce(&err);
  failing_malloc_disarm(&faults);
  if (status != GG_OK && !strstr(err.message, "memory")) wrong(at, "said", err.message);
  if (failing_malloc_left(NULL, NULL)) {
    failing_malloc_left(stdout, NULL);
    wrong(at, "leaks", err.message);
  }
  if (!are_files_whole(false)) wrong(at, "files", err.message);
  failing_malloc_keep_counts();
  _exit(0);
}

static uint64_t count_calls(void)
{
  gg_error err;
  uint64_t faults;
  if (reproduce(&err) != GG_OK) {
    printf("# %s\n", err.message);
    return 0;
  }
  failing_malloc_arm(0, 0, "reproduce_memory");
  gg_status status = reproduce(&err);
  uint64_t calls = failing_malloc_disarm(&faults);
  return status == GG_OK && are_files_whole(true) ? calls : 0;
}

static int try_all(void)
{
  const char *asked = getenv("MEMORY_TRIES"); /* 0: all */
  const uint64_t tries = asked ? strtoull(asked, NULL, 10) : TRIES, calls = count_calls();
  const uint64_t step = tries && calls > tries ? calls / tries : 1;
  int bad = calls == 0, tried = 0;
  for (uint64_t at = 1; at <= calls; at += step, tried++) {
    int status = 0;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) try_one(at);
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) printf("# allocation %llu: signal %d\n", (unsigned long long)at, WTERMSIG(status));
    bad += !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  }
  printf("# %d of %llu allocations\n", tried, (unsigned long long)calls);
  return bad;
}

int main(void)
{
  char folder[] = "/tmp/graingas-figure-XXXXXX", command[64];
  if (system("command -v gnuplot >/dev/null") != 0) return printf("1..0 # SKIP gnuplot is not installed\n"), 0;
  if (!mkdtemp(folder) || chdir(folder) != 0) return 1;
  printf("1..1\n");
  int bad = try_all();
  printf("%sok 1 - a figure\n", bad ? "not " : "");
  snprintf(command, sizeof command, "rm -r %s", folder);
  return chdir("/") != 0 || system(command) != 0 || bad != 0;
}
