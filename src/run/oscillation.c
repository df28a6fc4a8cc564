/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/oscillation.h"

#include <stdlib.h>

#include "base/memory.h"
#include "measure/harmonics.h"
#include "run/protocol_times.h"
#include "run/series_means.h"
#include "scene/fields.h"

/* The values of a replica at one sample. */
typedef struct sampled {
  gg_function kinetic, collisional, T;
  int of_kinetic, of_collisional; /* observables; -1: none */
} sampled;

static double value_of(const gg_replica *r, const gg_function *f, int observable, size_t row)
{
  return observable < 0
             ? 0
             : gg_function_value(*f, gg_series_row(&r->series, row) + r->sampler.offset[observable], &r->model);
}

static void read_replica(const gg_oscillation *o, size_t first, const gg_replica *r, const sampled *s, gg_cycle *c)
{
  for (size_t k = 0; k < o->steps * o->periods; k++) {
    const size_t j = k % o->steps, row = first + k + 1;
    c->kinetic[j] += value_of(r, &s->kinetic, s->of_kinetic, row) / (double)o->periods;
    c->collisional[j] += value_of(r, &s->collisional, s->of_collisional, row) / (double)o->periods;
    c->T[j] += value_of(r, &s->T, 0, row) / (double)o->periods;
  }
}

static void read_theory(const gg_oscillation *o, size_t first, const gg_relaxing *theory, gg_cycle *c)
{
  for (size_t k = 0; k < o->steps * o->periods; k++) {
    const gg_relaxing *x = &theory[first + k + 1];
    c->kinetic[k % o->steps] += x->P.at[0][1] / (double)o->periods;
    c->T[k % o->steps] += x->T / (double)o->periods;
  }
}

/* The strain of the period, about its mean. */
static void read_strain(const gg_oscillation *o, size_t first, const gg_scene *s)
{
  const double step = gg_run_protocol_time(s, 1);
  double strain = 0, mean = 0;
  for (size_t j = 0; j < o->steps; j++) {
    strain += step * gg_run_protocol_shear_rate(s, first + j);
    o->strain[j] = strain, mean += strain / (double)o->steps;
  }
  for (size_t j = 0; j < o->steps; j++) o->strain[j] -= mean;
}

gg_status gg_run_oscillation_curves(const gg_replicas *all, const gg_relaxing *theory, gg_curves *list, gg_error *err)
{
  const gg_scene *scene = &all->scene;
  const gg_replica *r = all->replica;
  const size_t steps = (size_t)scene->shear.steps, periods = (size_t)gg_scene_shear_periods(scene),
               analysed = (periods + 1) / 2, n = (size_t)all->n, first = steps * (periods - analysed);
  sampled s;
  s.of_kinetic = gg_measure_sampler_find(&r->sampler, GG_Q_P_XY_KINETIC, &s.kinetic);
  s.of_collisional = gg_measure_sampler_find(&r->sampler, GG_Q_P_XY_COLLISIONAL, &s.collisional);
  if (r->series.n <= steps * periods || s.of_kinetic < 0 || *scene->protocol[0].key ||
      !gg_measure_sampler_find_history(&r->sampler, GG_Q_TEMPERATURE, &s.T))
    return GG_OK; /* cut short, or not of one gas */
  GG_FREED double *room = gg_base_array_new(steps * (3 * n + 4), sizeof *room, err);
  GG_FREED gg_cycle *of = gg_base_array_new(n + 1, sizeof *of, err);
  const gg_oscillation o = {&all->model,
                            theory ? gg_theory_relaxation_name(&all->model) : NULL,
                            steps,
                            analysed,
                            (double)steps * gg_run_protocol_time(scene, 1),
                            room,
                            n,
                            of};
  if (!room || !of) return GG_FAILED;
  for (size_t i = 0; i < 3 * (n + 1); i += 3)
    of[i / 3] = (gg_cycle){room + (i + 1) * steps, room + (i + 2) * steps, room + (i + 3) * steps};
  read_strain(&o, first, scene);
  for (size_t i = 0; i < n; i++) read_replica(&o, first, &r[i], &s, &of[i]);
  if (theory) read_theory(&o, first, theory, &of[n]);
  return gg_measure_harmonics(&o, list, err);
}
