/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hours without a stop: one run of one engine, with checkpoints and a trajectory, watched from within.
 *   soak SCENE.yaml SECONDS FOLDER      SECONDS of processor time; its files go into FOLDER
 * Prints a row every hundredth of that: processor time, collisions, collisions a second since the row before, memory in
 * use, open files. Exit code 0; 1 where, from the second tenth on, memory grew by more than 1 % and 256 kB, the number
 * of open files changed, or the rate of a tenth is more than 5 % off that of the others (their median); 2: it could not
 * be run. */
#include <dirent.h>
#include <graingas.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { ROWS = 100, PARTS = 10 };

typedef struct row {
  double seconds, memory; /* of the processor; bytes */
  uint64_t collisions;
  int files;
} row;

typedef struct watch {
  double every;
  int n;
  row rows[ROWS + 1];
} watch;

static double processor_time(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double resident_memory(void)
{
  long total, resident;
  FILE *f = fopen("/proc/self/statm", "r");
  if (!f) return NAN;
  int got = fscanf(f, "%ld %ld", &total, &resident);
  fclose(f);
  return got == 2 ? (double)resident * (double)sysconf(_SC_PAGESIZE) : NAN;
}

static int open_files(void)
{
  int n = 0;
  DIR *d = opendir("/proc/self/fd");
  if (!d) return -1;
  while (readdir(d)) n++;
  closedir(d);
  return n - 3; /* ".", ".." and the folder itself */
}

static int note(void *context, const gg_progress *p)
{
  watch *w = (watch *)context;
  double now = processor_time();
  if (now < w->every * (w->n + 1)) return 0;
  row *r = &w->rows[w->n++];
  *r = (row){now, resident_memory(), p->collisions, open_files()};
  const row before = w->n > 1 ? r[-1] : (row){0};
  printf("%8.1f s %14llu collisions %10.4g /s %8.2f MB %3d files\n", now, (unsigned long long)p->collisions,
         (double)(r->collisions - before.collisions) / (now - before.seconds), r->memory / 1e6, r->files);
  fflush(stdout);
  return w->n == ROWS;
}

static int by_value(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double least_memory(const row *from, const row *to)
{
  double least = from->memory;
  for (const row *r = from; r < to; r++) least = fmin(least, r->memory);
  return least;
}

/* The second to the last tenth: the first has the warm-up in it. */
static int verdict(const watch *w)
{
  double rate[PARTS - 1], sorted[PARTS - 1], worst = 0;
  const row *first = &w->rows[ROWS / PARTS], *last = &w->rows[ROWS - 1];
  int other = 0;
  if (w->n < ROWS) return fprintf(stderr, "soak: the run ended by itself\n"), 2;
  for (int k = 0; k < PARTS - 1; k++) {
    const row *from = &w->rows[(k + 1) * ROWS / PARTS - 1], *to = &w->rows[(k + 2) * ROWS / PARTS - 1];
    rate[k] = sorted[k] = (double)(to->collisions - from->collisions) / (to->seconds - from->seconds);
  }
  qsort(sorted, PARTS - 1, sizeof *sorted, by_value);
  for (int k = 0; k < PARTS - 1; k++) worst = fmax(worst, fabs(rate[k] / sorted[PARTS / 2 - 1] - 1));
  for (const row *r = first; r <= last; r++) other += r->files != first->files;
  double before = least_memory(first, &w->rows[ROWS / 2]), growth = least_memory(&w->rows[ROWS / 2], last + 1) - before;
  printf("memory %+.0f kB (%+.2f %%); rate %.4g /s, of a tenth within %.2f %%; open files %d, other in %d rows\n",
         growth / 1e3, 100 * growth / before, sorted[PARTS / 2 - 1], 100 * worst, first->files, other);
  return (growth > 0.01 * before && growth > 256e3) || worst > 0.05 || other;
}

int main(int argc, char **argv)
{
  static watch w;
  static gg_run_options options;
  char output[4096], checkpoint[4096];
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  gg_error err;
  if (argc != 4 || !(w.every = atof(argv[2]) / ROWS)) return fprintf(stderr, "soak SCENE SECONDS FOLDER\n"), 2;
  snprintf(output, sizeof output, "%s/soak.h5", argv[3]);
  snprintf(checkpoint, sizeof checkpoint, "%s/soak.checkpoint.h5", argv[3]);
  options = (gg_run_options){
      .size = sizeof(gg_run_options), .output = output, .checkpoint = checkpoint, .context = &w, .progress = note};
  gg_status status = gg_scene_load(argv[1], &scene, &err);
  if (!status) status = gg_run(scene, &options, &result, &err);
  int code = status == GG_OK || status == GG_INTERRUPTED ? verdict(&w) : 2;
  if (code == 2 && status && status != GG_INTERRUPTED) fprintf(stderr, "soak: %s\n", err.message);
  gg_result_free(result);
  gg_scene_free(scene);
  return code;
}
