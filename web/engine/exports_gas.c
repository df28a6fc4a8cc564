/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulations step by step, and trajectories of runs: both have a state, grains and species. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exports.h"

enum { MOST_SPECIES = 16, MOST_BINS = 64 };

/* Grains in arrays at fixed addresses, filled again when the page requests them. */
typedef struct page_grains {
  gg_grains into;
  size_t n;
  double *hit; /* time of each grain's last collision; NULL: not recorded */
  double mass[MOST_SPECIES];
} page_grains;

static void free_arrays(page_grains *g)
{
  free(g->into.position);
  free(g->into.velocity);
  free(g->into.spin);
  free(g->into.species);
  free(g->hit);
}

static int make_arrays(page_grains *g, size_t n, int positions)
{
  g->n = n;
  if (positions) g->into.position = calloc(3 * n, sizeof(double));
  g->into.velocity = calloc(3 * n, sizeof(double));
  g->into.spin = calloc(3 * n, sizeof(double));
  g->into.species = calloc(n, sizeof(int));
  if (g->into.velocity && g->into.spin && g->into.species && (g->into.position || !positions)) return 1;
  page_fail("out of memory");
  return 0;
}

/* Addresses of the arrays: 0 positions (NULL in dsmc), 1 velocities, 2 spins, 3 species, 4 times of collisions, 5
 * masses of species. `g` is a simulation or a trajectory: both begin with a page_grains. */
PAGE void *page_array(page_grains *g, int which)
{
  void *const arrays[] = {g->into.position, g->into.velocity, g->into.spin, g->into.species, g->hit, g->mass};
  return arrays[which];
}

static const double *told_state(const gg_simulation_state *s)
{
  static double numbers[20];
  const double head[] = {s->time,           (double)s->collisions, s->collisions_per_grain,
                         (double)s->grains, s->temperature,        s->rotational_temperature,
                         s->strain,         s->image_offset};
  memcpy(numbers, head, sizeof head);
  memcpy(numbers + 8, s->box, sizeof s->box);
  memcpy(numbers + 11, s->kinetic_stress, sizeof s->kinetic_stress);
  return numbers;
}

static const double *told_species(const gg_species_state *s)
{
  static double numbers[6];
  const double all[] = {(double)s->grains, s->diameter, s->mass, s->inertia, s->temperature, s->rotational_temperature};
  return memcpy(numbers, all, sizeof all);
}

/* ---- Simulations ---- */

typedef struct page_simulation {
  page_grains grains;
  gg_simulation *simulation;
  double until;  /* end of the time slice of an advance, in milliseconds */
  double *start; /* remembered positions; NULL: none */
  uint64_t caught;
  gg_collision_event event; /* the last collision that was reported */
} page_simulation;

static int time_is_up(void *context)
{
  return emscripten_get_now() >= ((page_simulation *)context)->until;
}

PAGE void page_simulation_free(page_simulation *p)
{
  if (!p) return;
  gg_simulation_free(p->simulation);
  free_arrays(&p->grains);
  free(p->start);
  free(p);
}

static void take_masses(page_simulation *p)
{
  gg_species_state s;
  for (int i = 0; i < MOST_SPECIES && gg_simulation_get_species(p->simulation, i, &s, NULL) == GG_OK; i++)
    p->grains.mass[i] = s.mass;
}

static int make(page_simulation *p, const gg_scene *scene, uint64_t stream)
{
  gg_simulation_state state;
  return gg_simulation_new(scene, &(gg_start_options){.size = sizeof(gg_start_options), .stream = stream},
                           &p->simulation, &page_why) == GG_OK &&
         gg_simulation_get_state(p->simulation, &state, &page_why) == GG_OK &&
         gg_simulation_on_stop(p->simulation, time_is_up, p, &page_why) == GG_OK &&
         make_arrays(&p->grains, state.grains, state.box[0] > 0);
}

PAGE page_simulation *page_simulation_new(const gg_scene *scene, int stream)
{
  page_simulation *p = calloc(1, sizeof *p);
  if (!p) return page_fail("out of memory");
  p->until = INFINITY;
  if (make(p, scene, (uint64_t)stream)) {
    take_masses(p);
    return p;
  }
  page_simulation_free(p);
  return NULL;
}

static void catch_event(void *context, const gg_collision_event *event)
{
  page_simulation *p = context;
  p->event = *event;
  p->caught++;
  for (int i = 0; i < 2 && p->grains.hit; i++) p->grains.hit[event->grain[i]] = event->time;
}

/* Record the time of each grain's last collision from now on, -infinity until it has one. For md only. */
PAGE int page_follow(page_simulation *p)
{
  p->grains.hit = malloc(p->grains.n * sizeof(double));
  if (!p->grains.hit) return page_fail("out of memory"), 0;
  for (size_t i = 0; i < p->grains.n; i++) p->grains.hit[i] = -INFINITY;
  return gg_simulation_on_collision(p->simulation, catch_event, p, &page_why) == GG_OK;
}

/* 1: done; 2: the time slice ended, call again; 0: failed. */
static int outcome(gg_status status)
{
  return status == GG_OK ? 1 : status == GG_INTERRUPTED ? 2 : 0;
}
PAGE int page_advance(page_simulation *p, double time, double milliseconds)
{
  p->until = emscripten_get_now() + milliseconds;
  return outcome(gg_simulation_advance(p->simulation, time, &page_why));
}
PAGE int page_collide(page_simulation *p, double collisions, double milliseconds)
{
  p->until = emscripten_get_now() + milliseconds;
  return outcome(gg_simulation_collide(p->simulation, (uint64_t)collisions, &page_why));
}

/* Report collisions for this step alone, unless they are recorded already. */
static gg_status show(page_simulation *p, gg_on_collision *callback)
{
  return p->grains.hit ? GG_OK : gg_simulation_on_collision(p->simulation, callback, p, &page_why);
}

/* Advance by one collision, or in dsmc by one step with at least one. Returns the last collision in the order of
 * engines.js; NULL: failed. */
PAGE const double *page_step(page_simulation *p)
{
  static double numbers[15];
  p->caught = 0;
  p->until = INFINITY;
  gg_status status = show(p, catch_event);
  if (status == GG_OK) status = gg_simulation_collide(p->simulation, 1, &page_why);
  if (status == GG_OK) status = show(p, NULL);
  if (status == GG_OK && !p->caught) return page_fail("no collision was shown");
  if (status != GG_OK) return NULL;
  const gg_collision_event *e = &p->event;
  double *to = numbers;
  for (int i = 0; i < 2; i++) *to++ = (double)e->grain[i];
  for (int i = 0; i < 2; i++) *to++ = e->species[i];
  for (int a = 0; a < 3; a++) *to++ = e->k[a];
  for (int a = 0; a < 3; a++) *to++ = e->velocity[a];
  *to++ = e->normal_speed;
  for (int a = 0; a < 3; a++) *to++ = e->impulse[a];
  *to = e->time;
  return numbers;
}

PAGE const double *page_state(page_simulation *p)
{
  gg_simulation_state s;
  return gg_simulation_get_state(p->simulation, &s, &page_why) == GG_OK ? told_state(&s) : NULL;
}

PAGE const double *page_sums(page_simulation *p)
{
  static double numbers[4 + 9];
  gg_simulation_sums s;
  if (gg_simulation_take_sums(p->simulation, &s, &page_why) != GG_OK) return NULL;
  const double head[] = {s.time, (double)s.collisions, (double)s.wall_collisions, s.dissipation};
  memcpy(numbers, head, sizeof head);
  memcpy(numbers + 4, s.collisional_stress, sizeof s.collisional_stress);
  return numbers;
}

/* Fill the arrays. */
PAGE int page_take_grains(page_simulation *p)
{
  return gg_simulation_get_grains(p->simulation, &p->grains.into, &page_why) == GG_OK;
}

/* ---- Experiments of a class ---- */

static int put_grains(page_simulation *p)
{
  return gg_simulation_set_grains(p->simulation, &p->grains.into, p->grains.n, &page_why) == GG_OK;
}

/* Reverse all velocities and spins. */
PAGE int page_reverse(page_simulation *p)
{
  if (!page_take_grains(p)) return 0;
  for (size_t i = 0; i < 3 * p->grains.n; i++) {
    p->grains.into.velocity[i] = -p->grains.into.velocity[i];
    p->grains.into.spin[i] = -p->grains.into.spin[i];
  }
  return put_grains(p);
}

/* Put the grains back, as they are after a change of units and back. With `change`, displace the grain of the
 * largest x towards 0 by the least amount that survives: one last bit or, where the change of units rounds that
 * away, a few. A last bit of a velocity would mostly be lost in the first collision. */
PAGE int page_nudge(page_simulation *p, int change)
{
  if (!page_take_grains(p) || !put_grains(p) || !page_take_grains(p) || !put_grains(p)) return 0;
  double *x = p->grains.into.position;
  for (size_t i = 1; i < p->grains.n; i++)
    if (p->grains.into.position[3 * i] > *x) x = p->grains.into.position + 3 * i;
  double before = *x, after = before;
  for (int tries = 0; change && tries < 64; tries++) {
    *x = after = nextafter(after, 0);
    if (!put_grains(p) || !page_take_grains(p)) return 0;
    if (*x != before) return 1;
  }
  return change ? page_fail("no place is that near"), 0 : 1;
}

/* Remember the positions of the grains for page_distance. */
PAGE int page_remember(page_simulation *p)
{
  if (!p->start) p->start = malloc(3 * p->grains.n * sizeof *p->start);
  if (!p->start) return page_fail("out of memory"), 0;
  if (!page_take_grains(p)) return 0;
  memcpy(p->start, p->grains.into.position, 3 * p->grains.n * sizeof *p->start);
  return 1;
}

/* Root mean square distance of the grains, by minimum image, from their remembered positions, or from those of
 * another simulation; NaN: failed. For periodic boxes without shear. */
PAGE double page_distance(page_simulation *p, page_simulation *other)
{
  gg_simulation_state s;
  double sum = 0;
  if (gg_simulation_get_state(p->simulation, &s, &page_why) != GG_OK ||
      gg_simulation_get_grains(p->simulation, &p->grains.into, &page_why) != GG_OK ||
      (other && gg_simulation_get_grains(other->simulation, &other->grains.into, &page_why) != GG_OK))
    return NAN;
  const double *from = other ? other->grains.into.position : p->start;
  for (size_t i = 0; from && i < 3 * p->grains.n; i++) {
    double d = p->grains.into.position[i] - from[i];
    d -= s.box[i % 3] * round(d / s.box[i % 3]);
    sum += d * d;
  }
  return from ? sqrt(sum / (double)p->grains.n) : NAN;
}

/* Fraction of the grains by speed: `bins` bins up to `end`, over the bin width. Reads the grains of
 * page_take_grains. */
PAGE const double *page_speeds(const page_simulation *p, int bins, double end)
{
  static double share[MOST_BINS];
  if (bins < 1 || bins > MOST_BINS || !(end > 0)) return page_fail("no such bins");
  memset(share, 0, sizeof share);
  for (size_t i = 0; i < p->grains.n; i++) {
    const double *v = p->grains.into.velocity + 3 * i;
    const double at = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / end * bins;
    if (at < bins) share[(int)at] += bins / (end * (double)p->grains.n);
  }
  return share;
}

/* NULL after the last species. */
PAGE const double *page_species_state(const page_simulation *p, int species)
{
  gg_species_state s;
  return gg_simulation_get_species(p->simulation, species, &s, &page_why) == GG_OK ? told_species(&s) : NULL;
}

PAGE const char *page_hash(const page_simulation *p)
{
  static char text[17];
  uint64_t hash;
  if (gg_simulation_hash(p->simulation, &hash, &page_why) != GG_OK) return NULL;
  snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
  return text;
}

/* ---- Trajectories ---- */

typedef struct page_trajectory {
  page_grains grains;
  gg_trajectory *trajectory;
} page_trajectory;

PAGE void page_trajectory_free(page_trajectory *p)
{
  if (!p) return;
  gg_trajectory_free(p->trajectory);
  free_arrays(&p->grains);
  free(p);
}

static void masses_of_trajectory(page_trajectory *p)
{
  gg_species_state s;
  for (int i = 0; i < MOST_SPECIES && gg_trajectory_get_species(p->trajectory, i, &s, NULL) == GG_OK; i++)
    p->grains.mass[i] = s.mass;
}

PAGE page_trajectory *page_trajectory_new(const char *path)
{
  gg_simulation_state state;
  page_trajectory *p = calloc(1, sizeof *p);
  if (!p) return page_fail("out of memory");
  if (gg_trajectory_open(path, &p->trajectory, &page_why) == GG_OK &&
      gg_trajectory_frame(p->trajectory, 0, &state, NULL, &page_why) == GG_OK &&
      make_arrays(&p->grains, state.grains, 1)) {
    masses_of_trajectory(p);
    return p;
  }
  page_trajectory_free(p);
  return NULL;
}

PAGE const gg_scene *page_trajectory_scene(const page_trajectory *p)
{
  return gg_trajectory_scene(p->trajectory);
}
PAGE int page_trajectory_frames(const page_trajectory *p)
{
  return (int)gg_trajectory_frames(p->trajectory);
}
/* The k-th frame: fills the arrays, returns its state. */
PAGE const double *page_trajectory_frame(page_trajectory *p, int k)
{
  gg_simulation_state s;
  return gg_trajectory_frame(p->trajectory, (size_t)k, &s, &p->grains.into, &page_why) == GG_OK ? told_state(&s) : NULL;
}
/* NULL after the last species. */
PAGE const double *page_trajectory_species(const page_trajectory *p, int species)
{
  gg_species_state s;
  return gg_trajectory_get_species(p->trajectory, species, &s, &page_why) == GG_OK ? told_species(&s) : NULL;
}

/* ---- The temperature between walls at one instant ---- */

enum { MOST_SLABS = 128, GRAINS_PER_SLAB = 30 };

typedef struct slab {
  double n, c[3], m, mc[3], mcc; /* number of grains, and sums over them: velocity, mass, momentum, m c^2 */
} slab;

static void add_to_slab(slab *s, double mass, const double *c)
{
  s->n++, s->m += mass;
  for (int a = 0; a < 3; a++) s->c[a] += c[a], s->mc[a] += mass * c[a], s->mcc += mass * c[a] * c[a];
}

/* sum m (c - u)^2 about the mean u of the slab, corrected for the degrees of freedom that the mean of few grains
 * takes away. */
static double heat_of_slab(const slab *s)
{
  double sum = s->mcc;
  if (s->n < 2) return 0;
  for (int a = 0; a < 3; a++) {
    double u = s->c[a] / s->n;
    sum += u * (s->m * u - 2 * s->mc[a]);
  }
  return sum * s->n / (s->n - 1);
}

/* T of these grains about their mean velocities at this instant, in slabs across y. Results have this temperature
 * between walls; the temperature of the state is of whole velocities. */
PAGE double page_local_temperature(int n, const double *position, const double *velocity, const int *species,
                                   const double *mass, double height)
{
  slab slabs[MOST_SLABS] = {0};
  double heat = 0;
  int n_slabs = (int)fmin(fmax(fmin(floor(height), floor((double)n / GRAINS_PER_SLAB)), 1), MOST_SLABS);
  for (int i = 0; i < n; i++) {
    double at = position[3 * i + 1] / height * n_slabs;
    add_to_slab(&slabs[(int)fmin(fmax(at, 0), n_slabs - 1)], mass[species[i]], velocity + 3 * i);
  }
  for (int k = 0; k < n_slabs; k++) heat += heat_of_slab(&slabs[k]);
  return heat / (3.0 * n);
}
