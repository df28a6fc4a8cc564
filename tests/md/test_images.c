/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: in every neighbour search, across periodic, sheared and walled boxes, the unwrapped position of a grain is
 * continuous in time and moves as the grain does, also while the shear rate changes and is reversed; counting images
 * changes no bit of the trajectory; the counts do not depend on the number of threads, and are kept by a checkpoint and
 * by an engine that continues from another. */
#include <stdlib.h>
#include <string.h>

#include "md/md_operations.h"
#include "md/parallel/parallel.h"
#include "md_test.h"

static const md_case cases[] = {{GG_EQUILIBRIUM, 30, 0.2, 1, -1, INFINITY, {0}},    /* plain cells */
                                {GG_EQUILIBRIUM, 150, 0.01, 1, -1, INFINITY, {0}},  /* overlapping cells */
                                {GG_EQUILIBRIUM, 120, 0.45, 1, 0, INFINITY, {0}},   /* lists */
                                {GG_USF, 30, 0.2, 0.8, -1, INFINITY, {0}},          /* plain cells */
                                {GG_USF, 210, 0.3, 0.9, 0.3, INFINITY, {0}},        /* co-moving rows */
                                {GG_USF, 150, 0.01, 0.8, -1, INFINITY, {0}},        /* overlapping rows */
                                {GG_USF, 120, 0.45, 0.9, 0, 0.4, {1.3, 0.8, 1}},    /* lists */
                                {GG_COUETTE, 100, 0.2, 0.9, -1, INFINITY, {0}},     /* between walls */
                                {GG_POISEUILLE, 120, 0.4, 0.9, -1, INFINITY, {0}}}; /* and in a field */
enum { CASES = sizeof cases / sizeof *cases, MOST = 6000 };

/* Unwrapped position, peculiar velocity and image of every grain by its number. */
typedef struct view {
  gg_vec r[MOST], c[MOST];
  int32_t image[MOST][3];
  double slid; /* whole way of the image above */
} view;

static void look(void *context, const gg_chunk *chunk)
{
  view *v = context;
  for (size_t k = 0; k < chunk->n; k++) {
    const size_t i = (size_t)chunk->id[k];
    v->c[i] = (gg_vec){chunk->c[0][k], chunk->c[1][k], chunk->c[2][k]};
    v->r[i] = (gg_vec){chunk->r[0][k], chunk->r[1][k], chunk->r[2][k]};
    for (int a = 0; a < 3; a++) v->image[i][a] = chunk->image[a][k];
  }
}

static void view_of(gg_md *e, view *v)
{
  const gg_engine_state s = gg_engine_state_of(&e->base);
  gg_md_ops.snapshot(&e->base, true, look, v);
  v->slid = s.offset + s.turns * e->box.edge[0];
  for (uint32_t i = 0; i < e->n; i++) {
    const int32_t *n = v->image[i];
    v->r[i] =
        gg_add(v->r[i], (gg_vec){n[0] * e->box.edge[0] + n[1] * v->slid, n[1] * e->box.edge[1], n[2] * e->box.edge[2]});
  }
}

static void advance(gg_md *e, double dt)
{
  gg_error err = {0};
  if (gg_md_ops.advance(&e->base, dt, UINT64_MAX, NULL, &err) != GG_OK) fail_msg("%s", err.message);
}

static gg_md *create(const gg_model *m, bool images)
{
  gg_md *e = md_create(m, 5);
  if (images && gg_md_ops.keep_images(&e->base, NULL) != GG_OK) fail();
  return e;
}

/* The largest speed in the laboratory. The engine has velocities of the image in the box. */
static double fastest(const view *v, uint32_t n, double rate, double height)
{
  double most = 0;
  for (uint32_t i = 0; i < n; i++)
    most = fmax(most, sqrt(gg_dot(v->c[i], v->c[i])) + fabs(rate * (v->r[i].y - 0.5 * height)));
  return most;
}

static void unwrapped_positions_are_continuous(void **state)
{
  (void)state;
  static view before, after;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = md_model(cases[c]);
    gg_md *e = create(&m, true);
    double rate = m.shear_rate, least = fmin(m.box[0], fmin(m.box[1], m.box[2]));
    int entered[3] = {0};
    view_of(e, &before);
    for (int k = 0; k < 4000; k++) {
      if (k % 1000 == 999 && gg_model_is_sheared(&m)) {
        const double rates[] = {-2, 0, 3, 1};
        if (gg_md_ops.shear(&e->base, rate = rates[k / 1000], NULL) != GG_OK) fail();
      }
      const double v = fastest(&before, e->n, rate, m.box[1]), dt = fmin(0.05 * least / v, 0.2 * e->k.mean_free_time);
      advance(e, dt);
      view_of(e, &after);
      const double gravity = fabs(m.gravity[0]) + fabs(m.gravity[1]);
      for (uint32_t i = 0; i < e->n; i++) {
        gg_vec way = gg_sub(after.r[i], before.r[i]);
        way.x -= rate * dt * (0.5 * (after.r[i].y + before.r[i].y) - 0.5 * m.box[1]); /* with the flow there */
        const double most = 4 * dt * v + gravity * dt * dt;
        if (!(sqrt(gg_dot(way, way)) <= most + 1e-9))
          fail_msg("case %d: grain %u moved by %g of %g at step %d", c, i, sqrt(gg_dot(way, way)), most, k);
        for (int a = 0; a < 3; a++) entered[a] += after.image[i][a] != before.image[i][a];
      }
      before = after;
    }
    if (entered[0] < 20 || entered[2] < 20 || (entered[1] < 20) != m.walled)
      fail_msg("case %d: %d, %d, %d images were entered", c, entered[0], entered[1], entered[2]);
    md_destroy(e);
  }
}

static void counting_changes_no_bit(void **state)
{
  (void)state;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = md_model(cases[c]);
    gg_md *one = create(&m, false), *two = create(&m, true);
    md_collide(one, 5000), md_collide(two, 5000);
    assert_true(md_hash_all(one) == md_hash_all(two));
    md_destroy(one), md_destroy(two);
  }
}

static void threads_count_the_same_images(void **state)
{
  (void)state;
  static const md_case large[] = {
      {GG_EQUILIBRIUM, 5000, 0.1, 1, -1, INFINITY, {1, 1, 4}}, {GG_EQUILIBRIUM, 6000, 0.02, 1, -1, INFINITY, {1, 1, 4}},
      {GG_EQUILIBRIUM, 6000, 0.5, 1, -1, INFINITY, {1, 1, 4}}, {GG_USF, 6000, 0.3, 0.9, 0, INFINITY, {1, 1, 4}},
      {GG_USF, 6000, 0.02, 0.8, 0.5, 0.3, {1, 1, 4}},          {GG_USF, 6000, 0.5, 0.9, -1, INFINITY, {1, 1, 4}}};
  static view one, three;
  for (size_t c = 0; c < sizeof large / sizeof *large; c++) {
    const gg_model m = md_model(large[c]);
    gg_md *serial = create(&m, true), *parallel = create(&m, true);
    gg_md_use_threads(parallel, 3, false);
    md_collide(serial, 40000), md_collide(parallel, 40000);
    view_of(serial, &one), view_of(parallel, &three);
    assert_memory_equal(one.image, three.image, m.n * sizeof *one.image);
    assert_memory_equal(one.r, three.r, m.n * sizeof *one.r);
    md_destroy(serial), md_destroy(parallel);
  }
}

static void a_checkpoint_and_another_engine_keep_the_images(void **state)
{
  (void)state;
  static view one, two, three;
  for (int c = 0; c < CASES; c++) {
    const gg_model m = md_model(cases[c]);
    gg_md *e = create(&m, true);
    gg_archive a = {0};
    gg_engine *restored = NULL, *next = NULL;
    gg_error err = {0};
    md_collide(e, 20000);
    assert_int_equal(gg_md_ops.save(&e->base, &a, &err), GG_OK);
    assert_int_equal(gg_md_ops.restore(&m, &a, &restored, &err), GG_OK);
    view_of(e, &one);
    double *r = calloc(6 * e->n, sizeof *r), *v = r + 3 * e->n;
    for (uint32_t i = 0; i < e->n; i++)
      for (int k = 0; k < 3; k++) {
        const double ways[3] = {one.image[i][0] * m.box[0] + one.image[i][1] * one.slid, one.image[i][1] * m.box[1],
                                one.image[i][2] * m.box[2]};
        r[3 * i + k] = gg_along(&one.r[i], k) - ways[k], v[3 * i + k] = gg_along(&one.c[i], k);
        if (r[3 * i + k] < 0) r[3 * i + k] = 0; /* rounding */
      }
    if (gg_md_ops.create_with(&m, 0, 0, &(gg_grain_arrays){.r = r, .c = v}, &e->base, &next, &err) != GG_OK)
      fail_msg("case %d: %s", c, err.message);
    view_of((gg_md *)next, &three);
    for (uint32_t i = 0; i < e->n; i++) {
      const gg_vec way = gg_sub(one.r[i], three.r[i]);
      if (!(gg_dot(way, way) < 1e-16 * gg_dot(one.r[i], one.r[i]) + 1e-16))
        fail_msg("case %d: grain %u is elsewhere by %g", c, i, sqrt(gg_dot(way, way)));
    }
    md_collide(e, 2000), md_collide((gg_md *)restored, 2000);
    view_of(e, &one), view_of((gg_md *)restored, &two);
    assert_memory_equal(one.r, two.r, m.n * sizeof *one.r);
    free(r);
    gg_base_archive_clear(&a);
    md_destroy(e), md_destroy((gg_md *)restored), md_destroy((gg_md *)next);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(unwrapped_positions_are_continuous),
                                     cmocka_unit_test(counting_changes_no_bit),
                                     cmocka_unit_test(threads_count_the_same_images),
                                     cmocka_unit_test(a_checkpoint_and_another_engine_keep_the_images)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
