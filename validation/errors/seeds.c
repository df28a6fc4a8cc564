/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Do the errors of whole runs hold? seeds SCENE.yaml [--seeds N] [--set KEY=VALUE ...] [--truth QUANTITY=VALUE ...]
 * [--bounds NAME[,NAME ...]=LOW:HIGH ...] runs a scene N (200) times, seeds 1 to N, one thread, and prints a line for
 * each mean, for each curve (all its points together) and for each number read off a curve: how many runs have it, the
 * per cent of them that lie within the stated error and within 1.96 of it of the truth, the mean square of deviation
 * over error and that mean's own standard error (of a curve as if all points moved together), the mean deviation over
 * the root mean square error, and the stated over the true error. The truth is the one given, or else the mean over all
 * runs (deviations are then enlarged by the share that each run has in it). Then how many runs were called steady, and
 * how many of those have a mean that is off by more than four errors; mean samples and seconds of a run. --bounds: the
 * mean of z^2 over these lines has to lie between the two. Exit code 0; 1: a run failed, or z^2 is out of bounds; 2:
 * the command line is wrong. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/quantity.h"
#include "graingas.h"
#include "run/run.h"
#include "scene/scene_reader.h"

enum { MOST_NUMBERS = 20000, MOST_TRUTHS = 16, MOST_BOUNDS = 16 };

typedef struct item {
  char name[100];
  size_t first, n; /* of the numbers of a run */
  double truth;    /* NaN: the mean over runs */
  double z2;       /* NaN: too few runs have it */
} item;

typedef struct bounds {
  char names[120];
  double low, high;
} bounds;

typedef struct campaign {
  gg_scene scene;
  int seeds, items, truths, steady;
  size_t numbers;
  item *item;
  double *value, *error; /* seeds x numbers */
  bool *called_steady;
  double samples, seconds;
  struct {
    char name[60];
    double value;
  } truth[MOST_TRUTHS];
  int n_bounds;
  bounds bounds[MOST_BOUNDS];
} campaign;

static double truth_of(const campaign *c, const char *name)
{
  for (int i = 0; i < c->truths; i++)
    if (strcmp(c->truth[i].name, name) == 0) return c->truth[i].value;
  return NAN;
}

/* Numbers of one run, one after another; the first run says what they are called. */
typedef struct cursor {
  campaign *c;
  int seed, item;
  size_t at;
} cursor;

static void begin_item(cursor *k, const char *name, size_t n)
{
  campaign *c = k->c;
  if (k->seed == 0) {
    c->item = realloc(c->item, (size_t)(c->items + 1) * sizeof *c->item);
    c->item[c->items] = (item){.first = k->at, .n = n, .truth = truth_of(c, name), .z2 = NAN};
    snprintf(c->item[c->items++].name, sizeof c->item->name, "%s", name);
  }
  k->at = c->item[k->item].first;
  k->item++;
}

static void put(cursor *k, double value, double error)
{
  size_t i = (size_t)k->seed * MOST_NUMBERS + k->at++;
  if (k->at > MOST_NUMBERS) abort();
  k->c->value[i] = value, k->c->error[i] = error;
  if (k->seed == 0) k->c->numbers = k->at;
}

static void collect(campaign *c, int seed, const gg_result *r)
{
  cursor k = {.c = c, .seed = seed};
  for (int q = 0; q < gg_common_quantity_set_of(&r->model); q++) {
    const gg_estimate *e = &r->value[gg_common_quantity_at(&r->model, q)];
    begin_item(&k, gg_common_quantity_name_in(&r->model, gg_common_quantity_at(&r->model, q)), 1);
    put(&k, e->mean, e->error);
    if (q == 0) c->samples += (double)e->samples / c->seeds;
  }
  for (int i = 0; i < r->curves.n; i++) {
    const gg_curve *u = &r->curves.curve[i];
    char name[100];
    snprintf(name, sizeof name, "curve %s", u->name);
    begin_item(&k, name, u->n);
    for (size_t p = 0; p < u->n && (seed == 0 || p < c->item[k.item - 1].n); p++) put(&k, u->value[p], u->error[p]);
    for (int p = 0; p < u->n_numbers; p++) {
      snprintf(name, sizeof name, "fit %.50s.%s", u->name, u->number[p].name);
      begin_item(&k, name, 1);
      put(&k, u->number[p].value, u->number[p].error);
    }
  }
  c->called_steady[seed] = r->steadiness == GG_STEADY;
  c->steady += c->called_steady[seed];
  c->seconds += r->total.cpu_seconds / c->seeds;
}

static bool usable(const campaign *c, int seed, size_t number)
{
  size_t i = (size_t)seed * MOST_NUMBERS + number;
  return isfinite(c->value[i]) && c->error[i] > 0;
}

typedef struct sums {
  double n, in68, in95, z2, z4, bias, error2, deviation2, wrong;
} sums;

/* One number over all runs; those that nearly every run has, or else a mean over runs would be of the lucky ones. */
static void add_number(const campaign *c, const item *t, size_t number, sums *s)
{
  double n = 0, mean = 0, error2 = 0;
  for (int seed = 0; seed < c->seeds; seed++) n += usable(c, seed, number);
  if (n < 0.95 * c->seeds || n < 2) return;
  for (int seed = 0; seed < c->seeds; seed++) {
    size_t i = (size_t)seed * MOST_NUMBERS + number;
    if (usable(c, seed, number)) mean += c->value[i] / n, error2 += c->error[i] * c->error[i] / n;
  }
  bool known = isfinite(t->truth);
  double truth = known ? t->truth : mean;
  for (int seed = 0; seed < c->seeds; seed++) {
    size_t i = (size_t)seed * MOST_NUMBERS + number;
    if (!usable(c, seed, number)) continue;
    double d = (c->value[i] - truth) * (known ? 1 : sqrt(n / (n - 1))), z = fabs(d) / c->error[i];
    s->n++, s->in68 += z <= 1, s->in95 += z <= 1.959964;
    s->z2 += z * z, s->z4 += z * z * z * z;
    s->deviation2 += d * d / error2, s->error2++;
    s->wrong += z > 4 && c->called_steady[seed];
  }
  s->bias += (mean - truth) / sqrt(error2) * n;
}

static double mean_over_runs(const campaign *c, size_t number)
{
  double n = 0, sum = 0;
  for (int seed = 0; seed < c->seeds; seed++)
    if (usable(c, seed, number)) n++, sum += c->value[(size_t)seed * MOST_NUMBERS + number];
  return sum / n;
}

static void report(campaign *c)
{
  printf("%-44s %6s %5s %5s %6s %5s %6s %6s\n", "#", "runs", "68.27", "95", "z^2", "+-", "bias", "claim");
  for (int i = 0; i < c->items; i++) {
    sums s = {0};
    const item *t = &c->item[i];
    for (size_t k = 0; k < t->n; k++) add_number(c, t, t->first + k, &s);
    if (s.n == 0) continue;
    double z2 = c->item[i].z2 = s.z2 / s.n;
    printf("%-44s %6.0f %5.1f %5.1f %6.3f %5.3f %+6.3f %6.3f", t->name, s.n, 100 * s.in68 / s.n, 100 * s.in95 / s.n, z2,
           sqrt(fmax(s.z4 / s.n - z2 * z2, 0) / c->seeds), s.bias / s.n, sqrt(s.error2 / s.deviation2));
    if (t->n == 1 && !isfinite(t->truth)) printf("  mean %.8g", mean_over_runs(c, t->first));
    if (isfinite(t->truth)) printf("  steady and off by 4 errors: %.1f %%", 100 * s.wrong / c->seeds);
    printf("\n");
  }
  printf("# %d of %d steady; %.0f samples, %.3f s a run\n", c->steady, c->seeds, c->samples, c->seconds);
}

/* NaN where a name is that of no line. */
static double mean_z2(const campaign *c, const bounds *b)
{
  char names[sizeof b->names], *rest = names;
  double sum = 0, n = 0;
  snprintf(names, sizeof names, "%s", b->names);
  for (const char *name; (name = strsep(&rest, ","));) {
    double z2 = NAN;
    for (int i = 0; i < c->items; i++)
      if (strcmp(c->item[i].name, name) == 0) z2 = c->item[i].z2;
    sum += z2, n++;
  }
  return sum / n;
}

static bool is_within_bounds(const campaign *c)
{
  bool all = true;
  for (int i = 0; i < c->n_bounds; i++) {
    const bounds *b = &c->bounds[i];
    const double z2 = mean_z2(c, b);
    const bool good = z2 >= b->low && z2 <= b->high;
    printf("# z^2 of %s: %.3f, %s %g to %g\n", b->names, z2, good ? "within" : "OUT OF", b->low, b->high);
    all = all && good;
  }
  return all;
}

static int usage(const char *why)
{
  fprintf(stderr,
          "%s\nseeds SCENE.yaml [--seeds N] [--set KEY=VALUE ...] [--truth QUANTITY=VALUE ...] "
          "[--bounds NAME[,NAME ...]=LOW:HIGH ...]\n",
          why);
  return 2;
}

static bool split(const char *text, char *key, size_t size, const char **value)
{
  const char *equals = strchr(text, '=');
  if (!equals || (size_t)(equals - text) >= size) return false;
  memcpy(key, text, (size_t)(equals - text));
  key[equals - text] = '\0';
  *value = equals + 1;
  return true;
}

static bool take_bounds(campaign *c, const char *argument)
{
  bounds *b = &c->bounds[c->n_bounds];
  const char *value;
  if (c->n_bounds == MOST_BOUNDS || !split(argument, b->names, sizeof b->names, &value)) return false;
  c->n_bounds++;
  return sscanf(value, "%lf:%lf", &b->low, &b->high) == 2;
}

/* One option with its value; false: there is none such, or it is wrong. */
static bool take(campaign *c, const char *option, const char *argument, gg_error *err)
{
  char key[60];
  const char *value;
  if (strcmp(option, "--seeds") == 0) return (c->seeds = atoi(argument)) >= 3;
  if (strcmp(option, "--bounds") == 0) return take_bounds(c, argument);
  if (!split(argument, key, sizeof key, &value)) return false;
  if (strcmp(option, "--set") == 0) return gg_scene_override(&c->scene, key, value, err) == GG_OK;
  if (strcmp(option, "--truth") != 0 || c->truths == MOST_TRUTHS) return false;
  c->truth[c->truths].value = atof(value);
  snprintf(c->truth[c->truths++].name, sizeof c->truth->name, "%s", key);
  return true;
}

/* Returns how many runs ended short of what was asked; -1: one left nothing. */
static int run_all(campaign *c)
{
  int short_of = 0;
  gg_error err = {0};
  for (int seed = 0; seed < c->seeds; seed++) {
    gg_scene s = c->scene;
    gg_result *r = NULL;
    s.run.seed = (uint64_t)seed + 1;
    gg_status status = gg_run_scene(&s, NULL, 1, NULL, &r, &err);
    if (!r || (status != GG_OK && short_of++ == 0)) fprintf(stderr, "seed %d: %s\n", seed + 1, err.message);
    if (!r) return -1;
    collect(c, seed, r);
    gg_result_free(r);
  }
  return short_of;
}

int main(int argc, char **argv)
{
  campaign c = {.seeds = 200};
  gg_scene *given;
  gg_error err = {0};
  bool good = argc >= 2 && argc % 2 == 0 && gg_scene_load(argv[1], &given, &err) == GG_OK;
  if (good) c.scene = *given;
  for (int i = 2; good && i < argc; i += 2) good = take(&c, argv[i], argv[i + 1], &err);
  if (!good || gg_scene_finish(&c.scene, &err) != GG_OK) return usage(err.message);
  size_t all = (size_t)c.seeds * MOST_NUMBERS;
  c.value = malloc(all * sizeof *c.value);
  c.error = malloc(all * sizeof *c.error);
  c.called_steady = calloc((size_t)c.seeds, sizeof *c.called_steady);
  if (!c.value || !c.error || !c.called_steady) return 1;
  for (size_t i = 0; i < all; i++) c.value[i] = c.error[i] = NAN;
  int short_of = run_all(&c);
  if (short_of >= 0) report(&c);
  if (short_of > 0) printf("# %d runs ended short of what was asked\n", short_of);
  good = short_of >= 0 && is_within_bounds(&c);
  free(c.value), free(c.error), free(c.item), free(c.called_steady);
  return good ? 0 : 1;
}
