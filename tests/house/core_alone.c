/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program of the core alone: it makes a model without a scene, advances both engines, and evaluates a theory. It is
 * linked with graingas-core and nothing else of the library, so that it fails to link once the core needs the rest. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "common/engine.h"
#include "common/quantity.h"
#include "theory/theory_list.h"

/* Smooth grains with e = 0.8 in uniform shear flow, phi = 0.2. */
static gg_model sheared(bool ensemble, int n)
{
  gg_model m = {.flow = GG_USF, .ensemble = ensemble, .homogeneous = ensemble, .n = n, .n_species = 1, .n_of = {n},
                .fraction = {1}, .unit = {1, 1, 1}, .contact_time = 1e-5, .time_step = GG_AUTO, .frame_cells = 1};
  for (int i = 0; i < GG_MAX_SPECIES; i++) m.diameter[i] = m.mass[i] = 1, m.inertia[i] = 0.4;
  m.e[0] = 0.8, m.beta[0] = -1, m.mu[0] = INFINITY;
  m.shear_rate = 1;
  gg_common_model_set_size(&m, 0.2, (const double[3]){1, 1, 1});
  gg_common_model_set_pairs(&m);
  assert_int_equal(gg_common_model_set_walls(&m, &(gg_walls){0}, NULL), GG_OK);
  gg_common_model_set_start(&m, GG_AUTO);
  return m;
}

static void add_squares(void *context, const gg_chunk *chunk)
{
  double *sum = context;
  for (size_t i = 0; i < chunk->n; i++)
    for (int a = 0; a < 3; a++) *sum += chunk->c[a][i] * chunk->c[a][i] / 3;
}

/* <T> over 300 collisions per grain, after 100. */
static double temperature(const gg_engine_ops *ops, const gg_model *m)
{
  gg_error err;
  gg_engine *engine;
  double sum = 0, elapsed;
  const int samples = 150;
  assert_int_equal(ops->accepts(m, &err), GG_OK);
  assert_int_equal(ops->create(m, 1, 0, &engine, &err), GG_OK);
  assert_int_equal(ops->advance(engine, INFINITY, 50 * (uint64_t)m->n, &elapsed, &err), GG_OK);
  for (int k = 0; k < samples; k++) {
    assert_int_equal(ops->advance(engine, INFINITY, (uint64_t)m->n, &elapsed, &err), GG_OK);
    ops->snapshot(engine, false, add_squares, &sum);
  }
  ops->destroy(engine);
  return sum / (samples * (double)m->n);
}

/* Both engines agree within the few per cent that a gas of 500 grains allows; Lun's theory for e near 1 within 20 %. */
static void engines_and_theory_agree_without_a_scene(void **state)
{
  (void)state;
  const gg_model in_box = sheared(false, 500), ensemble = sheared(true, 5000);
  const double md = temperature(&gg_md_ops, &in_box), dsmc = temperature(&gg_dsmc_ops, &ensemble);
  gg_theory_answer answer;
  assert_int_equal(gg_theory_evaluate(&gg_theory_lun1991, &in_box, &answer, NULL), GG_OK);
  const double lun = answer.value[GG_Q_TEMPERATURE];
  print_message("# T: md %.4f, dsmc %.4f, lun1991 %.4f\n", md, dsmc, lun);
  assert_true(fabs(md / dsmc - 1) < 0.06);
  assert_true(fabs(lun / dsmc - 1) < 0.2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(engines_and_theory_agree_without_a_scene)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
