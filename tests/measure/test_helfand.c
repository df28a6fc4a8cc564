/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helfand's moments: planted collisions of known jumps, each repeated in the next interval, give coefficients known
 * in closed form; the first point of a curve has half of them; a grain between two collisions adds its flux times
 * the time of its flight. */
#include "curve_test.h"
#include "scene/model_of_scene.h"

enum { N = 6, SAMPLES = 40000 };
static const double speed = 0.7, interval = 0.3;

/* Pairs of opposite velocities along the axes: no heat flux, no stress but the pressure; T = v^2/3. */
static void at_rest(gg_snapshot *s)
{
  for (int i = 0; i < N; i++)
    for (int a = 0; a < 3; a++) s->c[a][i] = i / 2 == a ? (i % 2 ? speed : -speed) : 0;
}

typedef struct planted {
  gg_model model;
  gg_snapshot s;
  void *self;
  double *bin, sum[64], row[64];
} planted;

static const gg_observable *const helfand = &gg_measure_helfand;

static void start(planted *p)
{
  *p = (planted){.model = ct_model(GG_EQUILIBRIUM, 0.2, -1, N, 1)};
  p->self = helfand->create(&p->model, NULL);
  p->bin = calloc(helfand->curves->bins(p->self), sizeof *p->bin);
  assert_true(p->self && p->bin && helfand->rows->width(&p->model) <= 64);
  assert_int_equal(gg_measure_snapshot_init(&p->s, &p->model, false, NULL), GG_OK);
  helfand->restart(p->self);
}

static void end(planted *p)
{
  gg_measure_snapshot_clear(&p->s);
  helfand->destroy(p->self);
  free(p->bin);
}

static void sample(planted *p)
{
  at_rest(&p->s);
  p->s.elapsed = interval;
  helfand->curves->add_snapshot(p->self, &p->s, p->bin);
  helfand->rows->finish(p->self, &(gg_interval){.model = &p->model, .elapsed = interval, .velocity_factor = 1}, p->row);
  for (size_t k = 0; k < helfand->rows->width(&p->model); k++) p->sum[k] += p->row[k] / SAMPLES;
}

static double value(const planted *p, gg_quantity q)
{
  gg_function f;
  assert_true(gg_measure_derived_find(helfand->rows->derived, q, &f));
  return gg_function_value(f, p->sum, &p->model);
}

/* An impulse of length 1 on a grain at rest: half of 1 is transferred over the distance, <k_x^2>/4 = 1/12; stress k
 * J without trace: 1/18; a third of its trace: 1/27. Twice each: four times the square of one. */
static void planted_jumps_give_known_coefficients(void **state)
{
  (void)state;
  static const gg_quantity q[] = {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, GG_Q_VISCOSITY_REDUCED,
                                  GG_Q_BULK_VISCOSITY_REDUCED};
  static const char *const curve[] = {"thermal_conductivity_up_to", "viscosity_up_to", "bulk_viscosity_up_to"};
  static const double square[] = {1. / 12, 1. / 18, 1. / 27}, components[] = {3, 5, 1};
  planted p;
  gg_rng rng = gg_common_rng_seed(11, 0);
  start(&p);
  gg_collision_record now = {.J = {0, 0, 0}};
  for (int k = 0; k < SAMPLES; k++) {
    gg_collision_record before = now;
    p.s.time = before.time = now.time = (k + 1) * interval;
    now.k = gg_rng_direction(&rng), now.J = gg_rng_direction(&rng);
    helfand->collisions->add(p.self, &before);
    helfand->collisions->add(p.self, &now);
    sample(&p);
  }
  const gg_model *m = &p.model;
  const double T = speed * speed / 3, nu0 = gg_common_model_nu0(m, T);
  const double unit[] = {4. / 15 * nu0 / (m->density * T * T), nu0 / (m->density * T), nu0 / (m->density * T)};
  gg_curves list = {.model = m, .curve = calloc(GG_MOST_CURVES, sizeof *list.curve)};
  for (size_t k = 0; k < helfand->curves->bins(p.self); k++) p.bin[k] /= SAMPLES;
  helfand->curves->of_bins(p.self, p.bin, &list);
  for (int k = 0; k < 3; k++) {
    const double right = unit[k] * 2 * square[k] / (interval * m->volume * T);
    const double error = right * sqrt(8 / (components[k] * SAMPLES)); /* of seven products, neighbours alike */
    ct_expect(curve[k], value(&p, q[k]), error, right, 0.06 * right);
    ct_expect(curve[k], ct_find(&list, curve[k])->value[0], right * sqrt(1. / SAMPLES), right / 2, 0.07 * right);
  }
  gg_measure_curves_clear(&list);
  end(&p);
}

/* One grain is hit once, at a third of an interval, and again at its end: a flux of heat m v^3/2 along x for the
 * remaining time, and the transfer of the impulses. Its square makes the only nonzero row. */
static void a_flight_adds_flux_times_time(void **state)
{
  (void)state;
  planted p;
  start(&p);
  for (int k = 0; k < 12; k++) {
    const double last = k * interval;
    p.s.time = last + interval;
    if (k == 11) {
      gg_collision_record hit = {.k = {1, 0, 0}, .J = {2, 0, 0}, .time = last + interval / 3};
      helfand->collisions->add(p.self, &hit); /* partner 1 gets -2, too */
    }
    sample(&p);
  }
  const double T = speed * speed / 3, nu0 = gg_common_model_nu0(&p.model, T), n = p.model.density, kinetic = 0;
  /* Heat: partners separate, +4 and -4 over 2/3 of the interval, sum 0; 2 over the distance. Stress xx: 8 of both
   * over 2/3, 2 over the distance; without trace a third and minus a sixth: products 2/3 of the square, over 10. */
  const double xx = 8 * interval * 2 / 3, all = xx + 2, rows = 12 - 1 - 6;
  const double expected[] = {4. / 15 * nu0 / (n * T * T) * 2 * 2 / 3. / 2, nu0 / (n * T) * all * all * 2 / 30 / 2,
                             nu0 / (n * T) * all * xx * 2 / 30 / 2, kinetic};
  const gg_quantity q[] = {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, GG_Q_VISCOSITY_REDUCED, GG_Q_VISCOSITY_REDUCED_KINETIC,
                           GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC};
  for (int k = 0; k < 4; k++)
    assert_true(fabs(value(&p, q[k]) - expected[k] / (rows * interval * p.model.volume * T)) < 1e-12);
  end(&p);
}

static void models_without_it_give_the_reason(void **state)
{
  (void)state;
  gg_scene s = gg_scene_defaults();
  gg_model m;
  for (int flow = 0; flow < GG_N_FLOWS; flow++)
    for (int elastic = 0; elastic < 2; elastic++)
      for (int engine = 0; engine <= GG_DSMC; engine++) {
        s = gg_scene_defaults();
        s.flow = (gg_flow)flow, s.phi = 0.1, s.collision.e[0] = elastic ? 1 : 0.9, s.collision.beta[0] = -1;
        if (gg_scene_model_make(&s, (gg_engine_kind)engine, &m, NULL) != GG_OK) continue;
        const bool fine = elastic && engine == GG_MD && (flow == GG_EQUILIBRIUM || flow == GG_HCS);
        assert_int_equal(helfand->refuses(&m) == NULL, fine);
        m.wave = 0.3; /* its stress is no fluctuation */
        assert_non_null(helfand->refuses(&m));
      }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(planted_jumps_give_known_coefficients),
                                     cmocka_unit_test(a_flight_adds_flux_times_time),
                                     cmocka_unit_test(models_without_it_give_the_reason)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
