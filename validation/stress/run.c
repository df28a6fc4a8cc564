/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A corner on one engine: rejected, or run with samples of the grains, then followed collision by collision. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/archive.h"
#include "budget.h"
#include "common/thermostat.h"
#include "corner.h"

enum { SAMPLES = 30, SAMPLES_OF_MANY = 2, MANY = 100000, STEPS = 400, STEPS_OF_MANY = 10 };

/* A corner crawls (and fails) if it has used this much processor time and is slower: seconds, collisions per second. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CRAWLS_AFTER 1200.0
#else
#define CRAWLS_AFTER 60.0
#endif
#define CRAWLS_BELOW 1e5

static double cpu_now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int is_crawling(void *context)
{
  const double *until = context;
  return cpu_now() > *until;
}

/* Departure of the momentum from the expected one, over sum m |C|; between walls over its largest value so far, since
 * all grains may come to rest there. */
static double momentum_of(const gg_simulation *g, const sample *s, const double expected[3], double *largest)
{
  double off = 0;
  *largest = g->model.walled ? fmax(*largest, s->scale) : s->scale;
  for (int a = 0; a < 3; a++) off = fmax(off, fabs(s->momentum[a] - expected[a]));
  return off / *largest;
}

/* Allowed departure of the momentum. dsmc removes the mean of its white-noise kicks only from time to time. Between
 * walls each of its half flights rounds the momentum that gravity gives. */
static double allowed_momentum(const gg_simulation *g)
{
  const bool kicked = g->model.ensemble && gg_common_heat_of(&g->model) == GG_HEAT_KICKS;
  if (g->model.ensemble && g->model.walled) return 1e-10;
  return kicked ? 2 / sqrt((double)g->model.n) : g->model.single ? 1e-6 : 1e-11;
}

/* Expected momentum: zero; between walls that of laboratory velocities, which gains the impulses of walls and gravity.
 */
static gg_status expect_momentum(gg_simulation *g, double expected[3], gg_error *err)
{
  gg_simulation_sums sums;
  GG_TRY(gg_simulation_take_sums(g, &sums, err));
  if (!g->model.walled) return GG_OK;
  double mass = 0;
  for (int i = 0; i < g->model.n_species; i++) mass += (double)g->model.n_of[i] * g->model.mass[i];
  for (int a = 0; a < 3; a++) {
    expected[a] += mass * g->model.gravity[a] * sums.time;
    for (int w = 0; w < g->model.n_surfaces; w++) expected[a] -= sums.wall_impulse[w][a];
  }
  return GG_OK;
}

static double collisions_of(const corner *c, const gg_simulation *g)
{
  return (c->collisions > 0 ? c->collisions : 60) * (double)g->model.n / 2;
}

/* True if the energy is conserved. */
static bool keeps_energy(const gg_model *m)
{
  return m->elastic && m->shear_rate == 0 && !m->walled && gg_common_heat_of(m) == GG_UNHEATED;
}

static void inspect(const gg_simulation *g, const sample *s, finding *f)
{
  f->numbers &= s->numbers;
  f->overlap = fmax(f->overlap, sample_overlap(s, g));
  f->escapes += sample_escapes(s, g);
}

/* Save and restore the engine. Restoring validates the state, so every state that occurs must pass the validation. */
static gg_status save_and_restore(const gg_simulation *g, gg_error *err)
{
  gg_archive archive = {0};
  gg_engine *restored = NULL;
  gg_status status = g->engine->ops->save(g->engine, &archive, err);
  if (status == GG_OK) status = g->engine->ops->restore(&g->model, &archive, &restored, err);
  gg_base_archive_clear(&archive);
  if (restored) restored->ops->destroy(restored);
  return status;
}

static gg_status go_through(gg_simulation *g, const corner *c, sample *s, sample *other, finding *f, gg_error *err)
{
  const double n = (double)g->model.n, all = collisions_of(c, g);
  const int samples = n < MANY ? SAMPLES : SAMPLES_OF_MANY;
  double expected[3], middle = 0, scale = 0;
  sample_take(s, g);
  for (int a = 0; a < 3; a++) expected[a] = g->model.walled ? s->momentum[a] : 0;
  const double first = s->state.temperature, energy = s->translation + s->rotation;
  if (!g->model.ensemble) inspect(g, s, f);
  for (int k = 0; k < samples && f->numbers; k++) {
    const double time = s->state.time;
    const uint64_t collisions = s->state.collisions;
    GG_TRY(gg_simulation_collide(g, (uint64_t)fmax(1, ceil(all / samples)), err));
    GG_TRY(expect_momentum(g, expected, err));
    sample_take(s, g);
    inspect(g, s, f);
    if (f->numbers) GG_TRY(save_and_restore(g, err));
    f->monotone &= s->state.time >= time && s->state.collisions > collisions;
    if (2 * k == samples) middle = s->state.time;
    f->momentum = fmax(f->momentum, momentum_of(g, s, expected, &scale));
    f->collisions = (double)s->state.collisions;
    f->cooled = s->state.temperature / first;
    if (keeps_energy(&g->model)) f->drift = fmax(f->drift, fabs((s->translation + s->rotation) / energy - 1));
  }
  budget b = {.energy = NAN};
  GG_TRY(budget_follow(g, s, other, n < MANY ? STEPS : STEPS_OF_MANY, &b, err));
  f->energy = fmax(b.energy, f->drift), f->energy_allowed = b.energy_allowed, f->rule = b.rule;
  f->monotone &= b.in_time && s->state.time > middle;
  f->momentum_allowed = allowed_momentum(g);
  return GG_OK;
}

static void tell(finding *f, const gg_error *err)
{
  snprintf(f->reason, sizeof f->reason, "%s", err->message);
}

static gg_status prepare(const corner *c, const char *engine, gg_scene **scene, gg_error *err)
{
  GG_TRY(gg_scene_parse(c->scene, c->name, scene, err));
  GG_TRY(gg_scene_set(*scene, "engine", engine, err));
  if (!strstr(c->scene, "dsmc:")) {
    char n[32];
    GG_TRY(gg_scene_get(*scene, "particles", n, sizeof n, err));
    GG_TRY(gg_scene_set(*scene, "dsmc.particles", n, err));
  }
  return GG_OK;
}

void corner_run(const corner *c, const char *engine, finding *f)
{
  gg_error err = {0};
  gg_scene *scene = NULL;
  gg_simulation *g = NULL;
  sample s = {0}, other = {0};
  *f = (finding){.monotone = true, .numbers = true, .z = NAN, .departure = NAN, .energy = NAN};
  const double begin = cpu_now();
  double until = INFINITY;
  gg_status status = prepare(c, engine, &scene, &err);
  if (status == GG_OK) status = gg_simulation_new(scene, NULL, &g, &err);
  f->refused = status != GG_OK;
  if (status == GG_OK && c->start) c->start(g);
  if (status == GG_OK && !(sample_new(&s, g) && sample_new(&other, g)))
    status = gg_base_fail(&err, GG_FAILED, "no memory");
  if (status == GG_OK) {
    until = begin + CRAWLS_AFTER + collisions_of(c, g) / CRAWLS_BELOW;
    status = gg_simulation_on_stop(g, is_crawling, &until, &err);
  }
  if (status == GG_OK) status = go_through(g, c, &s, &other, f, &err);
  f->ended = status != GG_OK && !f->refused;
  if (status != GG_OK) tell(f, &err);
  /* Places near the far end of a box have no finer grain. */
  if (g && !g->model.ensemble)
    f->allowed_overlap = 1e-14 * (100 + fmax(g->model.box[0], fmax(g->model.box[1], g->model.box[2])));
  if (status == GG_OK && !g->model.ensemble && !c->start && g->model.n < MANY) corner_compare_plain(scene, f);
  sample_free(&s);
  sample_free(&other);
  gg_simulation_free(g);
  gg_scene_free(scene);
  f->seconds = cpu_now() - begin;
}

static const char *expected_reason(const corner *c, const char *engine)
{
  const char *own = strcmp(engine, "md") == 0 ? c->md : c->dsmc;
  return own ? own : c->refused;
}

#define WRONG(...) (snprintf(text, 256, __VA_ARGS__), text)

const char *corner_wrong(const corner *c, const char *engine, const finding *f, char text[256])
{
  const char *reason = expected_reason(c, engine);
  if (reason) {
    if (!f->refused && !f->ended) return "should have been refused";
    return strstr(f->reason, reason) ? NULL : WRONG("another reason: %.200s", f->reason);
  }
  if (f->refused || f->ended) return WRONG("%.240s", f->reason);
  if (!f->numbers) return "not a number";
  if (!f->monotone) return "time or collisions went back";
  if (f->overlap > f->allowed_overlap) return WRONG("overlap %.1e", f->overlap);
  if (f->escapes) return WRONG("%zu escapes", f->escapes);
  if (!(f->momentum < f->momentum_allowed)) return WRONG("momentum %.1e", f->momentum);
  if (f->energy > f->energy_allowed) return WRONG("energy %.1e of %.1e", f->energy, f->energy_allowed);
  if (!(f->rule < 1e-10)) return WRONG("rule %.1e", f->rule);
  if (f->same_pairs < f->compared_pairs) return WRONG("collision %d is another", f->same_pairs + 1);
  if (fabs(f->z) > 4 || fabs(f->departure) > 4) return WRONG("z %+.1f, %+.1f", f->z, f->departure);
  if (c->cools > 0 && (c->cools < 1 ? f->cooled > c->cools : f->cooled < c->cools))
    return WRONG("T went to %.1e", f->cooled);
  return NULL;
}
