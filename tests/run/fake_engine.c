/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fake_engine.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "base/memory.h"
#include "common/rng.h"

fake_plan fake;

typedef struct fake_state {
  double age, noise[3]; /* collisions per grain; autoregressive noises of T, theta, stress */
  double time;
  uint64_t collisions;
  gg_rng rng;
} fake_state;

typedef struct fake_engine {
  gg_engine base;
  gg_model model;
  fake_state now;
  gg_collision_sums sums;
} fake_engine;

static double bytes(const gg_model *model)
{
  return 100 * (double)model->n;
}

static gg_status accepts(const gg_model *m, gg_error *err)
{
  return m->flow == GG_USF || m->flow == GG_EQUILIBRIUM ? GG_OK : gg_base_fail(err, GG_BAD_INPUT, "fake: flow");
}

static gg_status create(const gg_model *m, uint64_t seed, uint64_t stream, gg_engine **out, gg_error *err);

static void destroy(gg_engine *e)
{
  free(e);
}

/* Knuth, The Art of Computer Programming 2 (1969), 3.4.1 F(3). */
static uint64_t poisson(gg_rng *rng, double mean)
{
  uint64_t n = 0;
  for (double p = gg_rng_uniform(rng); p > exp(-mean); p *= gg_rng_uniform(rng)) n++;
  return n;
}

static gg_status advance(gg_engine *base, double dt, uint64_t most, double *elapsed, gg_error *err)
{
  (void)most, (void)err;
  fake_engine *e = (fake_engine *)base;
  double rate = gg_common_model_collision_rate(&e->model, fake.T), step = rate * dt, keep = exp(-step / 10);
  for (int k = 0; k < 3; k++)
    e->now.noise[k] = keep * e->now.noise[k] + sqrt(1 - keep * keep) * gg_common_rng_normal(&e->now.rng);
  e->now.age += step, e->now.time += dt;
  const double expected = step * (double)e->model.n / 2;
  uint64_t collisions = fake.counted ? poisson(&e->now.rng, expected) : (uint64_t)llround(expected);
  e->now.collisions += collisions;
  e->sums.collisions[0] += collisions;
  double stress = e->model.volume * dt * (1 + fake.noise * e->now.noise[2]);
  for (int a = 0; a < 3; a++) e->sums.stress[0][a][a] += stress;
  e->sums.stress[0][0][1] -= 0.5 * stress, e->sums.stress[0][1][0] -= 0.5 * stress;
  e->sums.loss[0] += 0.5 * stress * (1 - fake.unpaid);
  *elapsed = dt;
  if (fake.seconds > 0) nanosleep(&(struct timespec){0, (long)(fake.seconds * 1e9)}, NULL);
  return GG_OK;
}

static void take_sums(gg_engine *base, gg_collision_sums *t)
{
  fake_engine *e = (fake_engine *)base;
  *t = e->sums;
  e->sums = (gg_collision_sums){0};
}

static void state(const gg_engine *base, gg_engine_state *s)
{
  const fake_engine *e = (const fake_engine *)base;
  *s = (gg_engine_state){.time = e->now.time,
                         .collisions = e->now.collisions,
                         .treated = (uint64_t)(fake.treated * (double)e->now.collisions)};
}

/* Half the grains move one way, half the other, along each axis: <C_a^2> = T exactly, and so for the spins. */
static void snapshot(gg_engine *base, bool positions, gg_visit *visit, void *context)
{
  (void)positions;
  fake_engine *e = (fake_engine *)base;
  double T = fake.T * (1 + fake.noise * e->now.noise[0] + fake.trend * e->now.age);
  double theta = fake.theta * (1 + fake.noise * e->now.noise[1] + fake.start * exp(-e->now.age / fake.relaxation));
  double c[3][GG_CHUNK], s[3][GG_CHUNK];
  uint8_t species[GG_CHUNK];
  size_t n = (size_t)e->model.n;
  for (size_t i = 0; i < n; i++) species[i] = i >= (size_t)e->model.n_of[0];
  for (size_t i = 0; i < n; i++)
    for (int a = 0; a < 3; a++) {
      double sign = (i >> a) & 1 ? 1 : -1;
      c[a][i] = sign * sqrt(T);
      s[a][i] = sign * sqrt(theta / e->model.inertia[0]);
    }
  gg_chunk chunk = {.n = n, .c = {c[0], c[1], c[2]}, .species = e->model.n_species > 1 ? species : NULL};
  if (e->model.rule != GG_SMOOTH)
    for (int a = 0; a < 3; a++) chunk.s[a] = s[a];
  visit(context, &chunk);
}

static gg_status rescale(gg_engine *e, int power, gg_error *err)
{
  (void)e, (void)power;
  return gg_base_fail(err, GG_BAD_INPUT, "fake: no rescaling");
}

static gg_status save(const gg_engine *base, gg_archive *a, gg_error *err)
{
  const fake_engine *e = (const fake_engine *)base;
  return gg_base_archive_put(a, "fake", GG_ITEM_U8, &e->now, sizeof e->now, err);
}

static gg_status restore(const gg_model *m, const gg_archive *a, gg_engine **out, gg_error *err)
{
  GG_TRY(create(m, 0, 0, out, err));
  return gg_base_archive_get(a, "fake", GG_ITEM_U8, &((fake_engine *)*out)->now, sizeof(fake_state), err);
}

static void describe(const gg_model *m, void (*line)(void *, const char *), void *context)
{
  (void)m, line(context, "fake");
}

static const gg_engine_ops ops = {
    .name = "fake",
    .doc = "planted answers",
    .accepts = accepts,
    .bytes = bytes,
    .nanoseconds = bytes,
    .create = create,
    .destroy = destroy,
    .advance = advance,
    .take_sums = take_sums,
    .state = state,
    .snapshot = snapshot,
    .rescale = rescale,
    .save = save,
    .restore = restore,
    .describe = describe,
};

static gg_status create(const gg_model *m, uint64_t seed, uint64_t stream, gg_engine **out, gg_error *err)
{
  fake_engine *e = gg_base_array_new(1, sizeof *e, err);
  if (!e) return GG_FAILED;
  e->base.ops = &ops;
  e->model = *m;
  e->now.rng = gg_common_rng_seed(seed, stream);
  for (int k = 0; k < 3; k++) e->now.noise[k] = gg_common_rng_normal(&e->now.rng);
  *out = &e->base;
  return GG_OK;
}

const gg_engine_ops *gg_common_engine_of(int kind)
{
  static gg_engine_ops ensemble;
  if (kind != GG_DSMC) return &ops;
  ensemble = ops, ensemble.ensemble = true;
  return &ensemble;
}

gg_scene planted_scene(double beta)
{
  fake = (fake_plan){.T = 2, .theta = 0.5, .relaxation = 10, .noise = 0.02};
  gg_scene s = gg_scene_defaults();
  s.phi = 0.2, s.particles = 512;
  s.collision.beta[0] = beta;
  return s;
}
