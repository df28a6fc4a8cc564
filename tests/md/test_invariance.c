/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the first hundred collisions are the same (pairs in order, and times to 10^-8 of a mean free time) wherever
 * the sheared boundary is, after translations, after half a turn about the vorticity, after displacements by whole
 * boxes, and for any grid of cells, at rest or co-moving, and neighbour lists. So are averages of long runs. */
#include <stdio.h>
#include <string.h>

#include "md/row_motion.h"
#include "md_test.h"

enum { EVENTS = 100, MAX_N = 200 };

typedef struct history {
  uint32_t pair[EVENTS][2];
  double time[EVENTS];
} history;

/* A copy of e's state at its present time, in an engine whose events are not yet predicted. */
static gg_md *copy_of(const gg_md *e)
{
  gg_md *c;
  gg_error err;
  assert_int_equal(gg_md_allocate(&e->model, &c, &err), GG_OK);
  c->box.offset0 = gg_md_offset(&e->box, e->k.now);
  for (uint32_t i = 0; i < e->n; i++) {
    c->grain[i] = e->grain[i];
    c->grain[i].r = gg_md_position(e, e->falls, &e->grain[i], e->k.now);
    c->grain[i].r.x =
        gg_wrap(c->grain[i].r.x, e->box.edge[0], e->box.inverse[0]); /* a co-moving row may have left the box */
    c->grain[i].t = 0;
    c->grain[i].counter = 0;
    if (e->spin) c->spin[i] = e->spin[i];
    c->id[i] = e->id[i];
  }
  return c;
}

static void begin(gg_md *e)
{
  gg_error err;
  assert_int_equal(gg_md_begin(e, &err), GG_OK);
}

static void record(gg_md *e, history *h)
{
  uint32_t before[MAX_N];
  double time = 0;
  for (int k = 0; k < EVENTS; k++) {
    for (uint32_t i = 0; i < e->n; i++) before[i] = e->grain[i].counter;
    time += md_collide(e, 1);
    int n = 0;
    for (uint32_t i = 0; i < e->n; i++)
      if (e->grain[i].counter != before[i]) h->pair[k][n++] = i;
    assert_int_equal(n, 2);
    h->time[k] = time;
  }
}

static void same(const gg_md *e, const history *a, const history *b)
{
  for (int k = 0; k < EVENTS; k++) {
    assert_int_equal(a->pair[k][0], b->pair[k][0]);
    assert_int_equal(a->pair[k][1], b->pair[k][1]);
    assert_true(fabs(a->time[k] - b->time[k]) < 1e-8 * e->k.mean_free_time);
  }
}

/* Translates all grains. Under shear the frame moves along; a grain that leaves the box is replaced by its image. */
static void shift(gg_md *e, gg_vec by)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->r = gg_add(g->r, by);
    g->v.x += e->model.shear_rate * by.y;
    double layers = gg_floor(g->r.y / e->box.edge[1]);
    g->r.y -= layers * e->box.edge[1];
    g->r.x -= layers * e->box.offset0;
    g->v.x -= layers * e->box.image_velocity;
    g->r.x = gg_wrap(g->r.x, e->box.edge[0], e->box.inverse[0]);
    g->r.z = gg_wrap(g->r.z, e->box.edge[2], e->box.inverse[2]);
  }
}

/* Half a turn about z through the middle of the box maps the shear flow onto itself. */
static void turn(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_md_grain *g = &e->grain[i];
    g->r.x = e->box.edge[0] - g->r.x;
    g->r.y = e->box.edge[1] - g->r.y;
    g->v.x = -g->v.x, g->v.y = -g->v.y;
    if (e->spin) e->spin[i].x = -e->spin[i].x, e->spin[i].y = -e->spin[i].y;
  }
}

/* A random number of cells that fits and is enough for co-moving rows. */
static void set_comoving_grid(gg_md *e, gg_rng *rng)
{
  const int32_t least[3] = {GG_MD_FEWEST_COMOVING, 4, 4};
  int32_t n[3];
  gg_error err;
  gg_md_cells_count(&e->box, gg_md_reach(&e->model), n);
  for (int a = 0; a < 3; a++) {
    assert_true(n[a] >= least[a]);
    n[a] = least[a] + (int32_t)gg_rng_below(rng, (uint32_t)(n[a] - least[a]) + 1);
  }
  assert_int_equal(gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(&e->model), &err), GG_OK);
  e->search.kind = GG_MD_COMOVING_ROWS;
  assert_int_equal(gg_md_make_rows(e, &err), GG_OK);
  gg_md_align_rows(e);
}

/* A random number of cells that fits, or one. */
static void set_random_grid(gg_md *e, gg_rng *rng, bool one)
{
  int32_t n[3];
  gg_error err;
  gg_md_cells_count(&e->box, gg_md_reach(&e->model), n);
  for (int a = 0; a < 3; a++) n[a] = one ? 1 : 1 + (int32_t)gg_rng_below(rng, (uint32_t)n[a]);
  assert_int_equal(gg_md_cells_make(&e->cells, &e->box, n, gg_md_reach(&e->model), &err), GG_OK);
}

static void check(md_case c, uint64_t seed, bool comoving)
{
  gg_model m = md_model(c);
  gg_md *e = md_create(&m, seed), *copy = copy_of(e);
  history first, other;
  md_collide(e, 500);
  md_destroy(copy);
  copy = copy_of(e);
  begin(copy);
  record(copy, &first);
  md_destroy(copy);
  gg_rng rng = gg_common_rng_seed(seed, 9);
  for (int k = 0; k < (comoving ? 24 : 18); k++) {
    gg_error err;
    copy = copy_of(e);
    if (k < 6)
      shift(copy, (gg_vec){gg_rng_uniform(&rng) * m.box[0], gg_rng_uniform(&rng) * m.box[1],
                           gg_rng_uniform(&rng) * m.box[2]});
    else if (k == 6)
      turn(copy);
    else if (k < 12)
      set_random_grid(copy, &rng, k == 7);
    else if (k < 16)
      assert_int_equal(gg_md_make_lists(copy, 0.05 * (k - 11), &err), GG_OK);
    else if (k < 18)
      copy->box.offset0 += (k == 16 ? 1 : -2) * copy->box.edge[0];
    else
      set_comoving_grid(copy, &rng);
    begin(copy);
    record(copy, &other);
    same(copy, &first, &other);
    md_destroy(copy);
  }
  md_destroy(e);
}

static void periodic_collisions_are_invariant(void **state)
{
  (void)state;
  check((md_case){GG_HCS, 60, 0.05, 0.9, 0, INFINITY, {0}}, 1, false);
  check((md_case){GG_HCS, 100, 0.5, 0.9, -1, INFINITY, {1, 1.3, 1.1}}, 2, false);
}

static void sheared_collisions_are_invariant(void **state)
{
  (void)state;
  check((md_case){GG_USF, 60, 0.02, 0.9, -1, INFINITY, {0}}, 1, true);
  check((md_case){GG_USF, 100, 0.2, 0.9, 0, INFINITY, {2, 1, 1}}, 2, true);
  check((md_case){GG_USF, 100, 0.2, 0.9, 0, INFINITY, {1, 2, 1}}, 3, false);
  check((md_case){GG_USF, 120, 0.5, 0.7, 0.5, 0.3, {0}}, 4, false);
}

/* Means over a long run and their standard errors. */
typedef struct averages {
  double mean[3], error[3]; /* temperature, collision rate, kinetic P_xy over density */
} averages;
enum { BLOCKS = 30, SAMPLES = 100 };

static void sample(const gg_md *e, double *T, double *xy)
{
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec r = gg_md_position(e, e->falls, &e->grain[i], e->k.now), c = e->grain[i].v;
    c.x -= e->model.shear_rate * (r.y - 0.5 * e->box.edge[1]);
    *T += gg_dot(c, c) / (3.0 * e->n * SAMPLES);
    *xy += c.x * c.y / (e->n * (double)SAMPLES);
  }
}

static averages average(gg_md *e)
{
  averages a = {{0}, {0}};
  double sum2[3] = {0};
  md_collide(e, 100 * e->n);
  for (int b = 0; b < BLOCKS; b++) {
    double x[3] = {0}, time = 0;
    for (int k = 0; k < SAMPLES; k++) {
      time += md_collide(e, e->n / 2);
      sample(e, &x[0], &x[2]);
    }
    x[1] = SAMPLES / time;
    for (int q = 0; q < 3; q++) a.mean[q] += x[q] / BLOCKS, sum2[q] += x[q] * x[q] / BLOCKS;
  }
  for (int q = 0; q < 3; q++) a.error[q] = sqrt((sum2[q] - a.mean[q] * a.mean[q]) / (BLOCKS - 1));
  return a;
}

static void long_averages_are_invariant(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_USF, 64, 0.3, 0.8, 0, INFINITY, {0}});
  gg_md *e = md_create(&m, 5);
  averages first = {{0}, {0}};
  for (int k = 0; k < 4; k++) { /* unchanged; the boundary elsewhere; one cell; lists */
    gg_md *copy = copy_of(e);
    gg_error err;
    gg_rng rng = gg_common_rng_seed(1, 1);
    if (k == 1) shift(copy, (gg_vec){1.3, 0.4 * m.box[1], 0.2});
    if (k == 2) set_random_grid(copy, &rng, true);
    if (k == 3) assert_int_equal(gg_md_make_lists(copy, 0.15, &err), GG_OK);
    begin(copy);
    averages a = average(copy);
    if (k == 0) first = a;
    for (int q = 0; q < 3; q++) {
      double sigma = sqrt(a.error[q] * a.error[q] + first.error[q] * first.error[q]);
      if (!(fabs(a.mean[q] - first.mean[q]) <= 4 * sigma && sigma < 0.02 * fabs(a.mean[q])))
        fail_msg("variant %d, mean %d: %g and %g, standard error %g", k, q, a.mean[q], first.mean[q], sigma);
    }
    md_destroy(copy);
  }
  md_destroy(e);
}

/* Places in a snapshot, and the number of grains that have flown out of the box and are shown as their images. */
typedef struct shown {
  const gg_md *e;
  gg_vec r[200];
  uint32_t n, wrapped;
} shown;

static void take(void *context, const gg_chunk *c)
{
  shown *x = context;
  for (size_t i = 0; i < c->n; i++) {
    const gg_md_grain *g = &x->e->grain[x->n];
    double y = gg_md_position(x->e, x->e->falls, g, x->e->k.now).y;
    x->wrapped += y < 0 || y >= x->e->box.edge[1];
    x->r[x->n++] = (gg_vec){c->r[0][i], c->r[1][i], c->r[2][i]};
  }
}

static double nearest_pair(const shown *x)
{
  double least = INFINITY;
  for (uint32_t i = 0; i < x->n; i++)
    for (uint32_t j = 0; j < i; j++) {
      gg_vec dr = gg_sub(x->r[i], x->r[j]), dv = {0, 0, 0};
      gg_md_minimum_image(&x->e->box, 1, x->e->k.now, &dr, &dv);
      least = fmin(least, gg_dot(dr, dr));
    }
  return sqrt(least);
}

/* Snapshots have all grains in the box and no two overlapping: under shear the right image is shown. */
static void places_are_shown_in_the_box(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_USF, 200, 0.4, 0.8, -1, INFINITY, {0}});
  gg_md *e = md_create(&m, 6);
  uint32_t wrapped = 0;
  for (int k = 0; k < 200; k++) {
    shown x = {.e = e};
    md_collide(e, 53);
    gg_md_ops.snapshot(&e->base, true, take, &x);
    for (uint32_t i = 0; i < x.n; i++)
      for (int a = 0; a < 3; a++) assert_true(gg_along(&x.r[i], a) >= 0 && gg_along(&x.r[i], a) < m.box[a]);
    assert_true(nearest_pair(&x) > 1 - 1e-9);
    wrapped += x.wrapped;
  }
  printf("# %d times a grain was shown at its image\n", (int)wrapped);
  assert_true(wrapped > 100);
  md_destroy(e);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic_collisions_are_invariant), cmocka_unit_test(sheared_collisions_are_invariant),
      cmocka_unit_test(long_averages_are_invariant), cmocka_unit_test(places_are_shown_in_the_box)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
