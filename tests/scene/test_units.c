/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One convention of units for every key of every flow: a scene whose lengths, masses and times are counted in other
 * units, by the unit that the table of keys gives each of them, is the same gas; and so is one whose species stand in
 * another order. Its model agrees to 1e-13, theories to 1e-12, and runs under powers of two bit for bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/engine_grains.h"
#include "run/protocol_times.h"
#include "run/run.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"
#include "theory/theory.h"

typedef struct scaling {
  double length, mass, time;
} scaling;

/* Powers of length, mass and time in the units of keys; a unit that is not here fails the test. */
static const struct {
  const char *unit;
  int length, mass, time;
} dimensions[] = {{"length", 1, 0, 0},
                  {"mass", 0, 1, 0},
                  {"time", 0, 0, 1},
                  {"1/time", 0, 0, -1},
                  {"velocity", 1, 0, -1},
                  {"velocity^2/time", 2, 0, -3},
                  {"mass velocity^2", 2, 1, -2},
                  {"acceleration", 1, 0, -2},
                  {"s", 0, 0, 0},
                  {"collisions per grain", 0, 0, 0},
                  {"mean free times", 0, 0, 0}};

static double factor_of(const char *unit, scaling by)
{
  if (!unit) return 1;
  for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++)
    if (strcmp(dimensions[i].unit, unit) == 0)
      return pow(by.length, dimensions[i].length) * pow(by.mass, dimensions[i].mass) * pow(by.time, dimensions[i].time);
  fail_msg("unit '%s' has no row here", unit);
  return NAN;
}

static void scale_field(const gg_field *f, void *base, scaling by)
{
  double *x = (double *)(void *)((char *)base + f->offset);
  const double factor = factor_of(f->unit, by);
  for (size_t i = 0; f->unit && i < gg_scene_field_count(f); i++)
    if (!(f->special && x[i] == f->special_value)) x[i] *= factor;
}

/* A default temperature makes v_0 a diameter per unit of time, whatever that unit is. */
static scaling allowed(const gg_scene *s, scaling by)
{
  if (s->start.temperature == GG_AUTO && gg_scene_scales_with_start(s)) by.time = 1;
  return by;
}

/* The same gas in units that are 1/`by` as large. */
static gg_scene scaled(const gg_scene *scene, scaling by)
{
  gg_scene s = *scene;
  for (const gg_field *f = gg_scene_fields; f->key; f++)
    if (f->type == GG_FIELD_NUMBER || f->type == GG_FIELD_VECTOR || f->type == GG_FIELD_ENDS ||
        f->type == GG_FIELD_PAIRS || f->type == GG_FIELD_RATE)
      scale_field(f, &s, by);
  for (int i = 0; i < s.n_species; i++)
    for (const gg_field *f = gg_scene_species_fields; f->key; f++) scale_field(f, &s.species[i], by);
  for (gg_change *c = s.protocol; c < s.protocol + GG_MAX_CHANGES && *c->key; c++) {
    gg_field f;
    c->at *= by.time;
    assert_true(gg_scene_key_find(c->key, GG_MAX_SPECIES, &f) >= 0);
    if (f.unit) snprintf(c->value, sizeof c->value, "%.17g", strtod(c->value, NULL) * factor_of(f.unit, by));
  }
  return s;
}

/* The same gas with its species in the opposite order. */
static gg_scene reversed(const gg_scene *scene)
{
  gg_scene s = *scene;
  const int n = s.n_species;
  for (int i = 0; i < n; i++) {
    s.species[i] = scene->species[n - 1 - i];
    for (int j = 0; j < n; j++) {
      const int here = gg_pair(i, j), there = gg_pair(n - 1 - i, n - 1 - j);
      s.collision.e[here] = scene->collision.e[there];
      s.collision.beta[here] = scene->collision.beta[there];
      s.collision.mu[here] = scene->collision.mu[there];
      s.collision.kick[GG_NORMAL_KICK][here] = scene->collision.kick[GG_NORMAL_KICK][there];
      s.collision.kick[GG_TANGENTIAL_KICK][here] = scene->collision.kick[GG_TANGENTIAL_KICK][there];
    }
  }
  return s;
}

static gg_scene scene_of(const char *yaml)
{
  gg_scene s = gg_scene_defaults();
  gg_error err = {0};
  if (gg_scene_read(&s, yaml, strlen(yaml), "test", &err) != GG_OK || gg_scene_finish(&s, &err) != GG_OK)
    fail_msg("%s: %s", yaml, err.message);
  return s;
}

static void model_of(const gg_scene *s, gg_model *m)
{
  gg_error err = {0};
  if (gg_scene_model_make(s, s->engine, m, &err) != GG_OK) fail_msg("%s", err.message);
}

static void close_to(double a, double b, double bound, const char *what)
{
  if (!(fabs(a - b) <= bound * fmax(fabs(a), fabs(b)))) fail_msg("%s: %.17g and %.17g", what, a, b);
}

/* Quantities of a model in the units of its scene, for species in the given order. */
enum { MOST = 160 };
static int physical(const gg_model *m, bool backward, double x[MOST], const char *name[MOST])
{
  int n = 0;
  const double L = m->unit.length, M = m->unit.mass, t = m->unit.time, v = L / t, T = M * v * v;
#define PUT(what, value) (name[n] = what, x[n++] = (value))
  for (int a = 0; a < 3; a++) PUT("box", m->box[a] * L), PUT("gravity", m->gravity[a] * v / t);
  PUT("shear_rate", m->shear_rate / t), PUT("temperature", m->temperature0 * T), PUT("ratio", m->ratio0);
  PUT("a2", m->a2_0), PUT("spin", m->spin0 / t), PUT("density", m->density / (L * L * L));
  for (int k = 0; k < m->n_species; k++) {
    const int i = backward ? m->n_species - 1 - k : k;
    PUT("diameter", m->diameter[i] * L), PUT("mass", m->mass[i] * M), PUT("inertia", m->inertia[i]);
    PUT("grains", (double)m->n_of[i]);
    PUT("drag", m->bath.drag[i] / t), PUT("noise", m->bath.noise[i] * v * v / t);
    PUT("torque", m->torque[i] * v / t);
    PUT("spin_drag", m->bath.spin_drag[i] / t), PUT("spin_noise", m->bath.spin_noise[i] * v * v / t);
    for (int l = 0; l <= k; l++) {
      const int j = backward ? m->n_species - 1 - l : l, o = gg_pair(i, j);
      PUT("sigma", m->sigma[o] * L), PUT("chi", m->chi[o]), PUT("e", m->e[o]), PUT("beta", m->beta[o]);
      PUT("kick", m->kick[GG_NORMAL_KICK][o] * v), PUT("kick", m->kick[GG_TANGENTIAL_KICK][o] * v);
      PUT("law", m->law.name ? m->law.scale[o] / v : 0);
    }
  }
  for (int w = 0; w < m->n_surfaces; w++) {
    const gg_surface *s = &m->surface[w];
    PUT("wall's place", s->place * L), PUT("wall's speed", s->velocity.x * v), PUT("ridges", s->radius * L);
    PUT("wall's temperature", s->temperature * T);
  }
#undef PUT
  assert_true(n <= MOST);
  return n;
}

/* Dimensions of what `physical` gives, as the names in the table of units. */
static const char *unit_of(const char *name)
{
  static const char *const units[][2] = {{"box", "length"},
                                         {"gravity", "acceleration"},
                                         {"shear_rate", "1/time"},
                                         {"temperature", "mass velocity^2"},
                                         {"spin", "1/time"},
                                         {"diameter", "length"},
                                         {"mass", "mass"},
                                         {"drag", "1/time"},
                                         {"noise", "velocity^2/time"},
                                         {"torque", "acceleration"},
                                         {"kick", "velocity"},
                                         {"spin_drag", "1/time"},
                                         {"spin_noise", "velocity^2/time"},
                                         {"sigma", "length"},
                                         {"wall's place", "length"},
                                         {"wall's speed", "velocity"},
                                         {"ridges", "length"},
                                         {"wall's temperature", "mass velocity^2"}};
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (strcmp(units[i][0], name) == 0) return units[i][1];
  return NULL;
}

static void compare_models(const gg_model *one, const gg_model *two, scaling by, bool backward, const char *yaml)
{
  double x[MOST], y[MOST];
  const char *name[MOST], *unused[MOST];
  char what[400];
  const int n = physical(one, false, x, name);
  assert_int_equal(physical(two, backward, y, unused), n);
  for (int i = 0; i < n; i++) {
    double factor = factor_of(unit_of(name[i]), by);
    if (strcmp(name[i], "density") == 0) factor = pow(by.length, -3);
    if (strcmp(name[i], "law") == 0) factor = by.time / by.length;
    snprintf(what, sizeof what, "%s: %s", yaml, name[i]);
    close_to(x[i] * factor, y[i], 1e-13, what);
  }
}

/* Every flow with every thermostat, and every key that has a unit. Species differ in everything. */
#define SPECIES                                                                                                        \
  "species: [{fraction: 0.5, diameter: 0.02, mass: 3, inertia: 0.3, drag: 2}, {fraction: 0.5, diameter: 0.03, mass: "  \
  "7}], "
#define ROUGH "collision: {e: {11: 0.8, 12: 0.9, 22: 0.7}, beta: {11: 0.1, 12: 0.3, 22: -0.5}}, "
#define SPINNERS                                                                                                       \
  "species: [{fraction: 0.5, diameter: 0.02, mass: 3, torque: 0.3}, {fraction: 0.5, diameter: 0.03, mass: 7, torque: " \
  "-0.2}], "
#define KICKS                                                                                                          \
  "collision: {e: 0.8, beta: {11: 0.1, 12: 0.3, 22: -0.5}, normal_kick: {11: 0.02, 12: 0.01, 22: 0.03}, "              \
  "tangential_kick: {11: 0.01, other: -0.02}}, "
#define COMMON "phi: 0.1, particles: 600, "
static const char *const mixtures[] = {
    "{flow: equilibrium, " COMMON SPECIES "start: {temperature: 5}}",
    "{flow: hcs, " COMMON SPECIES ROUGH "}",
    "{flow: hcs, " COMMON SPECIES ROUGH "start: {temperature: 5, rotational_temperature: 1, spin: 4, a2: -0.2}}",
    "{flow: hcs, " COMMON "species: [{fraction: 1, diameter: 0.02, mass: 3}], collision: {e: 0.9, law: viscoelastic, "
    "speed: 0.1}, start: {temperature: 5}}",
    "{flow: hss, " COMMON SPECIES ROUGH "start: {temperature: 5}}",
    "{flow: hss, thermostat: white_noise, " COMMON SPECIES ROUGH "start: {temperature: 5}}",
    "{flow: hss, gaussian_rate: 3, " COMMON SPECIES ROUGH "start: {temperature: 5}}",
    "{flow: hss, thermostat: white_noise, noise_strength: 0.2, " COMMON SPECIES ROUGH "}",
    "{flow: hss, thermostat: bath, bath: {drag: 0.5, temperature: 3, rotation: 2}, " COMMON SPECIES ROUGH "}",
    "{flow: hss, thermostat: bath, bath: {drag: 0.5, temperature: 3}, " COMMON SPECIES ROUGH
    "start: {temperature: 5, rotational_temperature: 1}}",
    "{flow: usf, shear_rate: 3, " COMMON SPECIES ROUGH "}",
    "{flow: hss, " COMMON SPECIES KICKS "}",
    "{flow: hss, " COMMON SPINNERS ROUGH "start: {spin: 4}}",
    "{flow: usf, shear_rate: 3, " COMMON SPINNERS KICKS "}",
    "{flow: hss, thermostat: bath, bath: {drag: 0.5, temperature: 3, rotation: 2}, " COMMON SPINNERS KICKS "}",
    "{flow: couette, walls: {speed: 2}, " COMMON SPECIES KICKS "}",
    "{flow: usf, shear_rate: 3, " COMMON SPECIES ROUGH "start: {temperature: 0.1, rotational_temperature: 1, spin: 4}}",
    "{flow: usf, shear_rate: 3, thermostat: bath, bath: {drag: 0.5, temperature: 3}, " COMMON SPECIES ROUGH "}",
    "{flow: small_shear, shear_rate: 3, " COMMON SPECIES "collision: {e: 0.9}}",
    "{flow: heated_shear, shear_rate: 3, noise_strength: 0.2, " COMMON SPECIES ROUGH "}",
    "{flow: heated_shear, shear_rate: 3, " COMMON SPECIES ROUGH "start: {temperature: 0.1}}",
    "{flow: couette, walls: {speed: 2}, " COMMON SPECIES ROUGH "gravity: [0.1, 0.2, 0.3]}",
    "{flow: couette, walls: {speed: 2, temperature: [1, 2]}, " COMMON SPECIES ROUGH "}",
    "{flow: poiseuille, gravity: [3, 0, 0], walls: {ridges: 0.02}, " COMMON SPECIES ROUGH "}",
    "{flow: chute, gravity: [3, -2, 0], " COMMON SPECIES ROUGH "}",
    "{flow: fourier, walls: {temperature: [2, 5], accommodation: 0.8}, " COMMON SPECIES ROUGH "}",
};
enum { MIXTURES = sizeof mixtures / sizeof *mixtures };

static void other_units_are_the_same_model(void **state)
{
  (void)state;
  const scaling all[] = {{100, 1, 1}, {1, 1e-3, 1}, {1, 1, 60}, {1e-3, 7, 0.013}};
  for (int i = 0; i < MIXTURES; i++)
    for (int engine = GG_MD; engine <= GG_DSMC; engine++)
      for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        gg_scene one = scene_of(mixtures[i]);
        if (engine == GG_DSMC && one.walls.ridges > 0) continue;
        one.engine = (gg_engine_kind)engine;
        const scaling by = allowed(&one, all[k]);
        const gg_scene two = scaled(&one, by);
        static gg_model a, b;
        model_of(&one, &a), model_of(&two, &b);
        compare_models(&a, &b, by, false, mixtures[i]);
      }
}

static void the_order_of_species_is_no_matter(void **state)
{
  (void)state;
  for (int i = 0; i < MIXTURES; i++) {
    const gg_scene one = scene_of(mixtures[i]), two = reversed(&one);
    static gg_model a, b;
    if (one.n_species < 2) continue;
    model_of(&one, &a), model_of(&two, &b);
    /* Starts that are guessed from the first species alone are no part of the gas. */
    if (one.start.temperature == GG_AUTO)
      b.temperature0 = gg_units_temperature(b.unit, a.temperature0 / gg_units_temperature(a.unit, 1));
    if (one.start.rotational_temperature == GG_AUTO) b.ratio0 = a.ratio0;
    compare_models(&a, &b, (scaling){1, 1, 1}, true, mixtures[i]);
  }
}

/* Powers of the unit of velocity in the name of a unit: "rho_p v_0^2", "d/v_0", "gamma^2 d". */
static int powers_of(const char *unit, const char *velocity)
{
  int power = 0;
  for (const char *at = unit; (at = strstr(at, velocity)); at += strlen(velocity)) {
    const int one = at[strlen(velocity)] == '^' ? at[strlen(velocity) + 1] - '0' : 1;
    power += memchr(unit, '/', (size_t)(at - unit)) ? -one : one;
  }
  return power;
}

/* Factor on velocities of results: they scale with the unit of time where that is the scene's own. */
static double velocities_of(const gg_model *a, const gg_model *b, scaling by)
{
  return b->unit.time == a->unit.time ? 1 / by.time : 1;
}

static void compare_answers(const char *yaml, const gg_theory *theory, const gg_model *a, const gg_model *b,
                            double velocity)
{
  static gg_theory_answer x, y;
  char what[400];
  const gg_status status = gg_theory_evaluate(theory, a, &x, NULL);
  assert_int_equal(gg_theory_evaluate(theory, b, &y, NULL), status);
  for (gg_quantity q = 0; status == GG_OK && q < GG_N_QUANTITIES; q++) {
    if (isnan(x.value[q]) && isnan(y.value[q])) continue;
    const double factor = pow(velocity, powers_of(gg_common_quantity_unit(q, a), "v_0"));
    const double near_zero = fabs(x.value[q]) < 1e-12 && fabs(y.value[q]) < 1e-12;
    snprintf(what, sizeof what, "%s: %s, %s", yaml, theory->name, gg_common_quantity_name(q));
    if (!near_zero) close_to(x.value[q] * factor, y.value[q], 1e-12, what);
  }
}

/* Solutions of steady states that are followed in time to a tolerance of their own are left to the models. */
static void theories_agree(void **state)
{
  (void)state;
  for (int i = 0; i < MIXTURES; i++) {
    const gg_scene one = scene_of(mixtures[i]);
    const scaling by = allowed(&one, (scaling){100, 1e-3, 60});
    const gg_scene two = scaled(&one, by);
    static gg_model a, b;
    model_of(&one, &a), model_of(&two, &b);
    for (const gg_theory *const *t = gg_theory_theories; *t; t++)
      if (!strstr((*t)->name, "enskog_hermite")) compare_answers(mixtures[i], *t, &a, &b, velocities_of(&a, &b, by));
  }
}

static void last_grains(const gg_scene *s, gg_model *m, gg_engine_grains *g)
{
  gg_engine *engine;
  gg_error err = {0};
  double elapsed;
  const gg_engine_ops *ops = gg_common_engine_of(s->engine);
  assert_int_equal(gg_run_start_make(s, NULL, NULL, m, &err), GG_OK);
  if (ops->create(m, 1, 0, &engine, &err) != GG_OK)
    fail_msg("%s, %s: %s", gg_flow_of(s->flow)->word, ops->name, err.message);
  if (engine->ops->advance(engine, 6 / gg_common_model_collision_rate(m, m->temperature0), 2000, &elapsed, &err) !=
      GG_OK)
    fail_msg("%s, %s: %s", gg_flow_of(s->flow)->word, ops->name, err.message);
  assert_int_equal(gg_common_engine_grains_make(g, (size_t)m->n, &err), GG_OK);
  gg_common_engine_grains_read(engine, m, g);
  engine->ops->destroy(engine);
}

static void runs_agree_bit_for_bit(void **state)
{
  (void)state;
  for (int i = 0; i < MIXTURES; i++)
    for (int engine = GG_MD; engine <= GG_DSMC; engine++) {
      gg_scene one = scene_of(mixtures[i]);
      if (one.walls.ridges > 0) continue; /* contacts with ridges are found by iteration */
      one.engine = (gg_engine_kind)engine;
      const scaling by = allowed(&one, (scaling){4, 0.5, 16});
      const gg_scene two = scaled(&one, by);
      static gg_model a, b;
      gg_engine_grains x = {0}, y = {0};
      last_grains(&one, &a, &x), last_grains(&two, &b, &y);
      const double factor = velocities_of(&a, &b, by);
      for (size_t k = 0; k < 3 * (size_t)a.n; k++)
        if (x.grains.c[k] * factor != y.grains.c[k])
          fail_msg("%s: %a and %a", mixtures[i], x.grains.c[k] * factor, y.grains.c[k]);
      gg_common_engine_grains_clear(&x), gg_common_engine_grains_clear(&y);
    }
}

/* Times of samples and of changes, and the gas after each change. */
static void courses_in_time_agree(void **state)
{
  (void)state;
  const char *const followed[] = {
      "{flow: hcs, " COMMON SPECIES
      "start: {temperature: 5}, run: {duration: 4}, protocol: [{at: 1, collision.e: 0.5}]}",
      "{flow: hss, start: {temperature: 5}, " COMMON SPECIES
      "run: {duration: 4}, protocol: [{at: 1, gaussian_rate: 3}]}",
      "{flow: hss, thermostat: bath, bath: {drag: 0.5, temperature: 3}, " COMMON SPECIES
      "run: {duration: 4}, protocol: [{at: 1, bath.drag: 2}, {at: 2, bath.temperature: 5}]}",
      "{flow: usf, shear_rate: 3, " COMMON SPECIES "run: {duration: 4}, protocol: [{at: 1, shear_rate: 5}]}"};
  const scaling by = {100, 1e-3, 60};
  for (size_t i = 0; i < sizeof followed / sizeof *followed; i++) {
    const gg_scene one = scene_of(followed[i]), two = scaled(&one, by);
    static gg_model a, b;
    model_of(&one, &a), model_of(&two, &b);
    for (uint64_t k = 1; k <= gg_run_protocol_samples(&one); k++) {
      const double time = gg_run_protocol_time(&one, k) * a.unit.time;
      close_to(time * by.time, gg_run_protocol_time(&two, k) * b.unit.time, 1e-12, followed[i]);
      if (k == 100) close_to(time, 4 * (100. - (gg_run_protocol_samples(&one) - 100.)) / 100, 1e-12, followed[i]);
    }
    for (int n = 1; n <= gg_scene_protocol_count(&one, INFINITY); n++) {
      gg_scene then[2];
      assert_int_equal(gg_scene_protocol_apply(&one, n, &then[0], NULL), GG_OK);
      assert_int_equal(gg_scene_protocol_apply(&two, n, &then[1], NULL), GG_OK);
      model_of(&then[0], &a), model_of(&then[1], &b);
      compare_models(&a, &b, by, false, followed[i]);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(other_units_are_the_same_model),
      cmocka_unit_test(the_order_of_species_is_no_matter),
      cmocka_unit_test(theories_agree),
      cmocka_unit_test(courses_in_time_agree),
      cmocka_unit_test(runs_agree_bit_for_bit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
