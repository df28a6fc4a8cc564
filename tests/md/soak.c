/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long runs by hand: do errors, which are rounding at first, grow over 10^9 collisions, or on a clock that shows 10^8?
 *
 *   soak PHI E BETA COLLISIONS [START [N [SEED [equilibrium | usf | hss | couette]]]]
 *
 * Samples the run some thousand times, half of them at a collision, half between two: the smallest distance of all
 * pairs and their images, in long double; grains outside their cell, skin or walls; total momentum; and the energy,
 * where collisions conserve it (e = 1, beta = 1 or -1, no shear). Prints one line, PASS or FAIL, and exits 0 or 1.
 *
 * If no flow is named, grains that conserve energy are in equilibrium in a periodic box, and others are sheared, which
 * keeps their temperature; the moving images of the sheared box depend on the clock. START is the time on the clock at
 * the start (under shear, rounded to a whole number of periods of the images). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "md_test.h"
#include "scene/scene.h"

#define LARGEST_OVERLAP 1e-11 /* contact distances */
#define LARGEST_DRIFT 1e-11   /* of energy, relative; of momentum, in N thermal speeds */
enum { SAMPLES = 4000, FEWEST_BETWEEN = 25000, REPORT_SECONDS = 20 };

typedef struct soak {
  gg_md *e;
  uint64_t collisions;
  double energy0, start, gone;
  bool conserves;
  double overlap, drift, momentum; /* worst so far */
  uint32_t misplaced;
  int samples;
} soak;

static gg_flow flow_of(const char *word, double e, double beta)
{
  static const struct {
    const char *name;
    gg_flow flow;
  } flows[] = {{"equilibrium", GG_EQUILIBRIUM}, {"usf", GG_USF}, {"hss", GG_HSS}, {"couette", GG_COUETTE}};
  if (!word) return e == 1 && fabs(beta) == 1 ? GG_EQUILIBRIUM : GG_USF;
  for (size_t k = 0; k < sizeof flows / sizeof *flows; k++)
    if (strcmp(word, flows[k].name) == 0) return flows[k].flow;
  fprintf(stderr, "soak: no flow '%s'\n", word);
  exit(2);
}

static void sample(soak *s)
{
  double overlap = (double)(1 - md_closest(s->e)), energy = md_energy(s->e);
  gg_vec p = md_momentum(s->e);
  double scale = sqrt(2 * energy * s->e->n);
  s->overlap = fmax(s->overlap, overlap);
  if (!s->e->model.walled) s->momentum = fmax(s->momentum, sqrt(gg_dot(p, p)) / scale);
  if (s->conserves) s->drift = fmax(s->drift, fabs(energy / s->energy0 - 1));
  s->misplaced += md_misplaced(s->e);
  s->samples++;
}

static bool passes(const soak *s)
{
  return s->overlap < LARGEST_OVERLAP && s->e->k.worst_overlap < LARGEST_OVERLAP && s->misplaced == 0 &&
         s->drift < LARGEST_DRIFT && s->momentum < LARGEST_DRIFT;
}

static void print(const soak *s, FILE *out, const char *word, double seconds)
{
  const gg_model *m = &s->e->model;
  gg_engine_state now;
  gg_md_ops.state(&s->e->base, &now);
  static const char *const flows[] = {"equilibrium", "usf", "hcs", "hss", "couette", "poiseuille", "chute"};
  fprintf(out, "%s phi %g e %g beta %g %s N %u start %.0f: %.4g collisions, %.0f s, clock %.6f; ", word, m->phi,
          m->e[0], m->beta[0], flows[m->flow], s->e->n, s->start, (double)now.collisions, seconds, now.time);
  fprintf(out, "overlap at collisions %.1e, of all pairs in %d samples %.1e; misplaced %u; momentum %.1e; ",
          now.worst_overlap, s->samples, s->overlap, s->misplaced, s->momentum);
  if (s->conserves) fprintf(out, "energy %.1e; ", s->drift);
  fprintf(out, "treated %.1e; state %016llx\n", (double)now.treated / (double)now.collisions,
          (unsigned long long)md_hash(s->e));
  fflush(out);
}

/* Advances to the next sample; every second one is between two collisions. */
static void go_on(soak *s, uint64_t collisions)
{
  double between = s->samples % 2 ? 0.3 * s->e->k.mean_free_time / s->e->n : 0, dt;
  s->gone += md_collide(s->e, collisions);
  if (between > 0 && gg_md_ops.advance(&s->e->base, between, UINT64_MAX, &dt, NULL) == GG_OK) s->gone += dt;
}

static void set_clock(soak *s, double start)
{
  const gg_md_box *box = &s->e->box;
  double period = box->image_velocity != 0 ? box->edge[0] / box->image_velocity : 1;
  s->start = period * rint(start / period);
  s->e->k.epoch_start = s->e->k.outer_time = s->start;
}

static int run(soak *s)
{
  uint64_t step = s->collisions / SAMPLES > FEWEST_BETWEEN ? s->collisions / SAMPLES : FEWEST_BETWEEN;
  time_t begin = time(NULL), told = begin;
  sample(s);
  while (s->e->k.collisions < s->collisions) {
    uint64_t left = s->collisions - s->e->k.collisions;
    go_on(s, left < step ? left : step);
    sample(s);
    if (time(NULL) < told + REPORT_SECONDS) continue;
    told = time(NULL);
    print(s, stderr, "at", (double)(told - begin));
  }
  gg_engine_state now;
  gg_md_ops.state(&s->e->base, &now);
  bool clock_right = fabs(now.time - s->start - s->gone) < 1e-9 * (s->start + s->gone);
  bool good = passes(s) && clock_right;
  print(s, stdout, good ? "PASS" : "FAIL", (double)(time(NULL) - begin));
  return good ? 0 : 1;
}

int main(int argc, char **argv)
{
  if (argc < 5) {
    fprintf(stderr, "soak PHI E BETA COLLISIONS [START [N [SEED [equilibrium|usf|hss|couette]]]]\n");
    return 2;
  }
  double phi = atof(argv[1]), e = atof(argv[2]), beta = atof(argv[3]);
  gg_flow flow = flow_of(argc > 8 ? argv[8] : NULL, e, beta);
  gg_scene scene = md_scene((md_case){flow, argc > 6 ? atoll(argv[6]) : 1000, phi, e, beta, INFINITY, {0}});
  scene.md.contact_time = GG_AUTO;
  gg_model model = md_model_of(&scene);
  soak s = {.collisions = (uint64_t)atof(argv[4]), .conserves = model.elastic && flow == GG_EQUILIBRIUM};
  s.e = md_create(&model, argc > 7 ? (uint64_t)atoll(argv[7]) : 1);
  s.energy0 = md_energy(s.e);
  set_clock(&s, argc > 5 ? atof(argv[5]) : 0);
  int code = run(&s);
  md_destroy(s.e);
  return code;
}
