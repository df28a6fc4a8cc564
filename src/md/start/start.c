/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The initial state: random positions, Maxwellian velocities at temperature0 (energies equal for all species), spins at
 * ratio0 x temperature0 about minus half the shear rate, total momentum zero, temperatures exact. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/portable_math.h"
#include "common/shear_wave.h"
#include "md/start/all_grains.h"
#include "md/start/place.h"
#include "md/start/start.h"

enum { SWEEPS = 3000 };

static gg_status make_cells(const gg_md *e, gg_md_packing *p, gg_error *err)
{
  double widest = gg_common_model_widest(&e->model) * 1.05;
  int32_t n[3];
  gg_md_cells_count(&e->box, fmax(widest, gg_root(e->model.volume / e->n, 3)),
                    n); /* wide enough that most cells are not empty */
  if (n[0] < 3 || n[1] < 3 || n[2] < 3) return GG_OK;
  GG_TRY(gg_md_cells_make(&p->cells, &e->box, n, widest, err));
  return GG_OK;
}

static gg_status push_apart(gg_md_packing *p, double phi, bool *free, gg_error *err)
{
  const double margin = gg_md_place_margin(phi);
  return gg_md_place_has_lists(p) ? gg_md_place_relax_lists(p, margin, SWEEPS, free, err)
                                  : gg_md_place_relax(p, margin, SWEEPS, free, err);
}

/* Relax random points; if that fails, near random close packing, relax a lattice with vacancies, which the run itself
 * has to melt. */
static gg_status relax(const gg_md *e, gg_md_packing *p, gg_rng *rng, gg_error *err)
{
  bool free;
  if (!gg_md_place_has_lists(p)) GG_TRY(make_cells(e, p, err));
  GG_TRY(push_apart(p, e->model.phi, &free, err));
  if (free) return GG_OK;
  gg_md_place_lattice(&e->box, e->n, rng, p->r);
  GG_TRY(gg_md_place_sort(p, NULL, err));
  GG_TRY(push_apart(p, e->model.phi, &free, err));
  if (free) return GG_OK;
  return gg_base_fail(
      err, GG_FAILED,
      "phi: no initial state without overlaps was found at phi = %g with particles = %u; try a lower phi or another "
      "number of particles",
      e->model.phi, e->n);
}

/* Distribute the species at random over the positions. */
static void distribute_species(gg_md *e, double *diameter, gg_rng *rng)
{
  uint32_t left[GG_MAX_SPECIES];
  for (int k = 0; k < e->model.n_species; k++) left[k] = (uint32_t)e->model.n_of[k];
  for (uint32_t i = 0; i < e->n; i++) {
    uint32_t s = 0;
    for (uint32_t card = (uint32_t)gg_rng_below(rng, e->n - i); card >= left[s]; s++) card -= left[s];
    left[s]--;
    e->grain[i].species = s;
    diameter[i] = e->model.diameter[s];
  }
}

/* Take given positions, after validation. In memory they are sorted along a space-filling curve, as in a fresh start.
 */
static gg_status place_given(gg_md *e, const gg_grain_arrays *given, gg_md_packing *p, double *diameter, gg_error *err)
{
  for (uint32_t i = 0; i < e->n; i++) p->r[i] = (gg_vec){given->r[3 * i], given->r[3 * i + 1], given->r[3 * i + 2]};
  GG_TRY(gg_md_place_sort(p, e->id, err));
  for (uint32_t i = 0; i < e->n; i++) {
    e->grain[i].r = p->r[i];
    e->grain[i].species = given->species ? (uint32_t)given->species[e->id[i]] : 0;
    diameter[i] = e->model.diameter[e->grain[i].species];
  }
  GG_TRY(make_cells(e, p, err));
  return gg_md_place_check(p, e->id, err);
}

/* Sites that grains of the same size do not fill are left empty at random. Grains stay on their sites: large ones may
 * not fit there. */
static gg_status place_on_lattice(gg_md *e, gg_rng *rng, gg_md_packing *p, double *diameter, gg_error *err)
{
  gg_md_place_lattice(&e->box, e->n, rng, p->r);
  GG_TRY(gg_md_place_sort(p, NULL, err));
  distribute_species(e, diameter, rng);
  for (uint32_t i = 0; i < e->n; i++) e->id[i] = i;
  GG_TRY(make_cells(e, p, err));
  const gg_status status = gg_md_place_check(p, e->id, err);
  return status == GG_OK ? GG_OK : gg_base_error_prefix(err, status, "start.positions: fcc");
}

static gg_status place_at_random(gg_md *e, gg_rng *rng, gg_md_packing *p, double *diameter, gg_error *err)
{
  for (uint32_t i = 0; i < e->n; i++)
    for (int a = 0; a < 3; a++) *gg_component(&p->r[i], a) = gg_rng_uniform(rng) * e->box.edge[a];
  GG_TRY(gg_md_poll_stop(e, err));
  GG_TRY(gg_md_place_sort(p, NULL, err));
  distribute_species(e, diameter, rng);
  return relax(e, p, rng, err);
}

static gg_status place(gg_md *e, gg_rng *rng, gg_md_packing *p, double *diameter, gg_error *err)
{
  GG_TRY((e->model.lattice ? place_on_lattice : place_at_random)(e, rng, p, diameter, err));
  for (uint32_t i = 0; i < e->n; i++) {
    e->grain[i].r = p->r[i];
    e->id[i] = i;
  }
  return GG_OK;
}

/* Velocity of the upper wall relative to the lower one. */
static double wall_shear(const gg_md *e)
{
  const gg_surface *lower = gg_surface_at(&e->model, 1, -1), *upper = gg_surface_at(&e->model, 1, 1);
  return lower && upper ? upper->velocity.x - lower->velocity.x : 0;
}

/* Draw velocities with the fourth cumulant of the model (Gaussian by default), total momentum zero and exactly the
 * temperature T: sum m c^2 = 3 N T. */
static void set_velocities(gg_md *e, gg_rng *rng, double T)
{
  gg_vec momentum = {0, 0, 0};
  double mass = 0, energy = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    double m = e->model.mass[gg_md_species_of(&e->grain[i])];
    e->grain[i].v = gg_scale(sqrt(T / m), gg_common_rng_velocity(rng, e->model.a2_0));
    momentum = gg_axpy(m, e->grain[i].v, momentum);
    mass += m;
  }
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec *v = &e->grain[i].v;
    *v = gg_axpy(-1 / mass, momentum, *v);
    energy += e->model.mass[gg_md_species_of(&e->grain[i])] * gg_dot(*v, *v);
  }
  double scale = energy > 0 ? sqrt(3 * e->n * T / energy) : 0;
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->v = gg_scale(scale, g->v);
    double rate = e->model.shear_rate + wall_shear(e) / e->box.edge[1]; /* the laminar profile */
    g->v.x += rate * (g->r.y - 0.5 * e->box.edge[1]);
  }
}

static void add_wave(gg_md *e)
{
  const gg_model *m = &e->model;
  gg_wave_sums sums = {0};
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_md_grain *g = &e->grain[i];
    gg_wave_add(&sums, m->mass[gg_md_species_of(g)], gg_wave_profile(m, g->r.y), g->v.x);
  }
  for (uint32_t i = 0; i < e->n; i++) e->grain[i].v.x += gg_wave_start(m, &sums, gg_wave_profile(m, e->grain[i].r.y));
}

/* Draw Gaussian spins with exactly sum K m s^2 = 3 N theta, since perfectly rough grains conserve their total energy.
 * Then add the mean spin, by default that of the vorticity. */
static void set_spins(gg_md *e, gg_rng *rng, double theta)
{
  double energy = 0;
  if (!e->spin) return;
  for (uint32_t i = 0; i < e->n; i++) {
    int k = gg_md_species_of(&e->grain[i]);
    double inertia = e->model.inertia[k] * e->model.mass[k];
    e->spin[i] = gg_scale(sqrt(theta / inertia), gg_common_rng_normal_vec(rng));
    energy += inertia * gg_dot(e->spin[i], e->spin[i]);
  }
  double scale = energy > 0 ? sqrt(3 * e->n * theta / energy) : 0;
  for (uint32_t i = 0; i < e->n; i++) {
    e->spin[i] = gg_scale(scale, e->spin[i]);
    e->spin[i].z += gg_model_starting_spin(&e->model, gg_md_species_of(&e->grain[i]));
  }
}

/* Take given peculiar velocities and spins. */
static void take_motion(gg_md *e, const gg_grain_arrays *given)
{
  for (uint32_t i = 0; i < e->n; i++) {
    const size_t at = 3 * (size_t)e->id[i];
    gg_md_grain *g = &e->grain[i];
    if (given->c) {
      g->v = (gg_vec){given->c[at], given->c[at + 1], given->c[at + 2]};
      g->v.x += e->model.shear_rate * (g->r.y - 0.5 * e->box.edge[1]);
    }
    if (given->s && e->spin) e->spin[i] = (gg_vec){given->s[at], given->s[at + 1], given->s[at + 2]};
  }
}

static gg_status place_all(gg_md *e, const gg_grain_arrays *given, gg_rng *rng, gg_error *err)
{
  gg_vec *r = gg_base_array_new(e->n, sizeof *r, err);
  double *diameter = gg_base_array_new(e->n, sizeof *diameter, err);
  gg_status status = r && diameter ? GG_OK : GG_FAILED;
  gg_md_packing p = {.box = e->box, .model = &e->model, .n = e->n, .r = r, .diameter = diameter};
  p.stop = e->model.stop;
  if (gg_md_place_has_lists(&p)) p.pool = gg_base_thread_pool_new(e->model.threads);
  if (status == GG_OK)
    status = given && given->r ? place_given(e, given, &p, diameter, err) : place(e, rng, &p, diameter, err);
  gg_base_thread_pool_free(p.pool);
  gg_md_cells_free(&p.cells);
  free(r);
  free(diameter);
  return status;
}

gg_status gg_md_start(gg_md *e, uint64_t seed, uint64_t stream, const gg_grain_arrays *given, gg_error *err)
{
  gg_rng rng = gg_common_rng_seed(seed, stream + GG_STREAM_START);
  e->k.rng = gg_common_rng_seed(seed, stream + GG_STREAM_ENGINE);
  GG_TRY(gg_md_poll_stop(e, err));
  GG_TRY(place_all(e, given, &rng, err));
  GG_TRY(gg_md_poll_stop(e, err));
  set_velocities(e, &rng, e->model.temperature0);
  if (e->model.wave > 0) add_wave(e);
  GG_TRY(gg_md_poll_stop(e, err));
  set_spins(e, &rng, e->model.ratio0 * e->model.temperature0);
  if (given) take_motion(e, given);
  return gg_md_poll_stop(e, err);
}
