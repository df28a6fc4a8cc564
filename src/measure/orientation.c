/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orientation of spins to velocities: the angle Psi between C and Omega = omega - <omega> of each grain (Brilliantov,
 * Poeschel, Kranz & Zippelius, Phys. Rev. Lett. 98 (2007) 128001), its distribution and Lambda = <cos^2 Psi>; and the
 * same for the instantaneous velocities c and omega. Without correlation Lambda = 1/3, P(cos Psi) = 1/2 and
 * P(cos^2 Psi) = 1/(2 |cos Psi|). */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "measure/local_frame.h"
#include "measure/observable.h"
#include "simd/clones.h"

enum { BINS = 50, COS = 0, SQUARE = BINS, SUM = 2 * BINS, COUNT, SET };

static const char *refuses(const gg_model *m)
{
  return m->rule == GG_SMOOTH ? "smooth grains do not spin" : NULL;
}

static void *create(const gg_model *m, gg_error *err)
{
  (void)m;
  return gg_base_array_new(1, 1, err);
}

static size_t bins(const void *self)
{
  (void)self;
  return 2 * (size_t)SET;
}

/* Number of grains at a time, component by component. */
enum { GRAINS = 128 };
typedef struct vectors {
  double x[3][GRAINS];
} vectors;

/* The cosine between both vectors of each grain, 2 if one of them is at rest and has no direction. */
GG_CLONES static void cosines(const vectors *c, const vectors *w, double *restrict cosine)
{
  for (size_t i = 0; i < GRAINS; i++) {
    double cc = c->x[0][i] * c->x[0][i] + c->x[1][i] * c->x[1][i] + c->x[2][i] * c->x[2][i];
    double ww = w->x[0][i] * w->x[0][i] + w->x[1][i] * w->x[1][i] + w->x[2][i] * w->x[2][i];
    double cw = c->x[0][i] * w->x[0][i] + c->x[1][i] * w->x[1][i] + c->x[2][i] * w->x[2][i];
    double product = cc * ww;
    cosine[i] = product > 0 ? cw / sqrt(product) : 2;
  }
}

static int bin_of(double x)
{
  int k = (int)(x * BINS);
  return k < 0 ? 0 : k >= BINS ? BINS - 1 : k;
}

static void count(const vectors *c, const vectors *w, size_t n, double *bin)
{
  double cosine[GRAINS], sum = 0, grains = 0;
  cosines(c, w, cosine);
  for (size_t i = 0; i < n; i++) {
    double square = cosine[i] * cosine[i];
    if (square > 2) continue;
    bin[COS + bin_of((cosine[i] + 1) / 2)]++;
    bin[SQUARE + bin_of(square)]++;
    sum += square;
    grains++;
  }
  bin[SUM] += sum;
  bin[COUNT] += grains;
}

static gg_vec at(double *const x[3], size_t i)
{
  return (gg_vec){x[0][i], x[1][i], x[2][i]};
}

static gg_vec spin_of(const gg_snapshot *s, size_t i)
{
  if (!s->frame) return at(s->s, i);
  return gg_measure_local_frame_spin(s->frame, s->r[1][i], at(s->s, i), gg_snapshot_species(s, i));
}

/* Mean spin by species: grains of two sizes spin at different mean rates. */
static gg_vec mean_spin(const gg_snapshot *s, int species)
{
  gg_vec sum = {0, 0, 0};
  double n = 0;
  for (size_t i = 0; i < s->n; i++)
    if (gg_snapshot_species(s, i) == species) sum = gg_add(sum, spin_of(s, i)), n++;
  return gg_scale(n > 0 ? 1 / n : 0, sum);
}

/* Velocity and spin, both peculiar: between walls about flow and spin of the slab, elsewhere those of the snapshot. */
static void take_peculiar(const gg_snapshot *s, size_t from, size_t n, const gg_vec mean[GG_MAX_SPECIES], vectors *c,
                          vectors *w)
{
  for (size_t k = 0; k < n; k++) {
    size_t i = from + k;
    gg_vec C = at(s->c, i), W = gg_sub(spin_of(s, i), mean[gg_snapshot_species(s, i)]);
    if (s->frame) C = gg_measure_local_frame_velocity(s->frame, s->r[1][i], C);
    c->x[0][k] = C.x, c->x[1][k] = C.y, c->x[2][k] = C.z;
    w->x[0][k] = W.x, w->x[1][k] = W.y, w->x[2][k] = W.z;
  }
}

static void take_instantaneous(const gg_snapshot *s, size_t from, size_t n, vectors *c, vectors *w)
{
  double shear = s->r[1] ? s->model->shear_rate : 0, middle = s->model->box[1] / 2;
  for (int a = 0; a < 3; a++)
    for (size_t k = 0; k < n; k++) c->x[a][k] = s->c[a][from + k], w->x[a][k] = s->s[a][from + k];
  for (size_t k = 0; k < n && shear != 0; k++) c->x[0][k] += shear * (s->r[1][from + k] - middle);
}

/* The sheared Monte Carlo ensemble has no positions, and so only peculiar velocities. */
static bool has_both(const gg_model *m)
{
  return !m->homogeneous || !gg_model_is_sheared(m);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  (void)self;
  const gg_model *m = s->model;
  gg_vec mean[GG_MAX_SPECIES];
  vectors c = {{{0}}}, w = {{{0}}};
  for (int k = 0; k < m->n_species; k++) mean[k] = mean_spin(s, k);
  for (size_t from = 0; from < s->n; from += GRAINS) {
    size_t n = s->n - from < GRAINS ? s->n - from : GRAINS;
    take_peculiar(s, from, n, mean, &c, &w);
    count(&c, &w, n, bin);
    if (!has_both(m)) continue;
    take_instantaneous(s->whole ? s->whole : s, from, n, &c, &w);
    count(&c, &w, n, bin + SET);
  }
}

static gg_curve *histogram(gg_curves *list, const char *name, const char *panel, const char *label, const double *bin,
                           double grains, double from, double to)
{
  gg_curve *c = gg_measure_curve_add(list, BINS, name, panel, label);
  double width = (to - from) / BINS;
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = from + ((double)i + 0.5) * width;
    c->value[i] = bin[i] / (grains * width);
  }
  return c;
}

/* For isotropic directions: uniform in the cosine; of its square, the mean over a bin. */
static double squares_of_uniform(double x, const double *width)
{
  return (sqrt(x + *width / 2) - sqrt(fmax(x - *width / 2, 0))) / *width;
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  (void)self;
  static const char *const names[2][2] = {{"orientation_cos", "orientation_cos2"},
                                          {"orientation_cos_instantaneous", "orientation_cos2_instantaneous"}};
  static const char *const labels[] = {"peculiar", "instantaneous"};
  for (int k = 0; k < 1 + has_both(list->model); k++, bin += SET) {
    gg_curve *c = histogram(list, names[k][0], "P(cos Ψ)", labels[k], bin + COS, bin[COUNT], -1, 1);
    gg_measure_curve_axes(c, "cos Ψ", "1", "P", "1");
    gg_measure_curve_beside(c, "no correlation", gg_measure_curve_level, &(double){0.5});
    gg_measure_curve_put_number(c, "Lambda", bin[SUM] / bin[COUNT], "1");
    c = histogram(list, names[k][1], "P(cos^2 Ψ)", labels[k], bin + SQUARE, bin[COUNT], 0, 1);
    gg_measure_curve_axes(c, "cos^2 Ψ", "1", "P", "1");
    gg_measure_curve_beside(c, "no correlation", squares_of_uniform, &(double){1.0 / (double)c->n});
    c->log_y = true;
  }
}

const gg_observable gg_measure_orientation = {
    GG_OBSERVABLE(ORIENTATION, orientation),
    .create = create,
    .destroy = free,
    .refuses = refuses,
    .positions = true,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 2, .framed = true, .add_snapshot = add_snapshot, .of_bins = curves},
    .cost = {.ns = {10, 2.5}},
};
