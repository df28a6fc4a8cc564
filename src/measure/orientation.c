/* Orientation of spins to velocities: the angle Psi between C and Omega = omega - <omega> of each grain (Brilliantov,
 * Poeschel, Kranz & Zippelius, Phys. Rev. Lett. 98 (2007) 128001), its distribution and Lambda = <cos^2 Psi>; and the
 * same for the instantaneous velocities c and omega. Without correlation Lambda = 1/3, P(cos Psi) = 1/2 and
 * P(cos^2 Psi) = 1/(2 |cos Psi|). */
#include <math.h>
#include <stdlib.h>

#include "measure/local_frame.h"
#include "measure/observable.h"

enum { BINS = 50, COS = 0, SQUARE = BINS, SUM = 2 * BINS, COUNT, SET };

static const char *refuses(const gg_model *m)
{
  return m->rule == GG_SMOOTH ? "smooth grains do not spin" : NULL;
}

static void *create(const gg_model *m, gg_error *err)
{
  (void)m;
  return gg_new_array(1, 1, err);
}

static size_t bins(const void *self)
{
  (void)self;
  return 2 * (size_t)SET;
}

static int bin_of(double x)
{
  int k = (int)(x * BINS);
  return k < 0 ? 0 : k >= BINS ? BINS - 1 : k;
}

static void count(gg_vec c, gg_vec w, double *bin)
{
  double product = gg_dot(c, c) * gg_dot(w, w);
  if (!(product > 0)) return; /* a grain at rest has no direction */
  double cosine = gg_dot(c, w) / sqrt(product);
  bin[COS + bin_of((cosine + 1) / 2)]++;
  bin[SQUARE + bin_of(cosine * cosine)]++;
  bin[SUM] += cosine * cosine;
  bin[COUNT]++;
}

static gg_vec at(double *const x[3], size_t i)
{
  return (gg_vec){x[0][i], x[1][i], x[2][i]};
}

/* By species: grains of two sizes spin at different mean rates. */
static gg_vec mean_spin(const gg_snapshot *s, int species)
{
  gg_vec sum = {0, 0, 0};
  double n = 0;
  for (size_t i = 0; i < s->n; i++)
    if (gg_snapshot_species(s, i) == species) sum = gg_add(sum, at(s->s, i)), n++;
  return gg_scale(n > 0 ? 1 / n : 0, sum);
}

/* Between walls peculiar velocities are about the flow of the slab; elsewhere they are what a snapshot holds. */
static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  (void)self;
  const gg_model *m = s->model;
  gg_vec mean[GG_MAX_SPECIES];
  gg_local_frame frame;
  double shear = s->r[1] ? m->shear_rate : 0, middle = m->box[1] / 2;
  for (int k = 0; k < m->n_species; k++) mean[k] = mean_spin(s, k);
  if (m->walled) gg_local_frame_of_snapshot(&frame, s);
  for (size_t i = 0; i < s->n; i++) {
    gg_vec c = at(s->c, i), w = at(s->s, i), C = m->walled ? gg_local_frame_velocity(&frame, s->r[1][i], c) : c;
    count(C, gg_sub(w, mean[gg_snapshot_species(s, i)]), bin);
    if (shear != 0) c.x += shear * (s->r[1][i] - middle);
    count(c, w, bin + SET);
  }
}

static gg_curve *histogram(gg_curves *list, const char *name, const char *panel, const char *label, const double *bin,
                           double grains, double from, double to)
{
  gg_curve *c = gg_curve_add(list, BINS, name, panel, label);
  double width = (to - from) / BINS;
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = from + ((double)i + 0.5) * width;
    c->value[i] = bin[i] / (grains * width);
  }
  return c;
}

/* Any direction as likely as any other: uniform in the cosine; of its square, the mean over a bin. */
static double squares_of_uniform(double x, const double *width)
{
  return (sqrt(x + *width / 2) - sqrt(fmax(x - *width / 2, 0))) / *width;
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  (void)self;
  /* The sheared Monte Carlo ensemble has no places, and so no velocities but the peculiar ones. */
  bool both = !list->model->homogeneous || list->model->shear_rate == 0;
  static const char *const names[2][2] = {{"orientation_cos", "orientation_cos2"},
                                          {"orientation_cos_instantaneous", "orientation_cos2_instantaneous"}};
  static const char *const labels[] = {"peculiar", "instantaneous"};
  for (int k = 0; k < 1 + both; k++, bin += SET) {
    gg_curve *c = histogram(list, names[k][0], "P(cos Ψ)", labels[k], bin + COS, bin[COUNT], -1, 1);
    gg_curve_axes(c, "cos Ψ", "1", "P", "1");
    gg_curve_beside(c, "no correlation", gg_level, &(double){0.5});
    gg_curve_put_number(c, "Lambda", bin[SUM] / bin[COUNT], "1");
    c = histogram(list, names[k][1], "P(cos^2 Ψ)", labels[k], bin + SQUARE, bin[COUNT], 0, 1);
    gg_curve_axes(c, "cos^2 Ψ", "1", "P", "1");
    gg_curve_beside(c, "no correlation", squares_of_uniform, &(double){1.0 / (double)c->n});
    c->log_y = true;
  }
}

const gg_observable gg_orientation = {
    GG_OBSERVABLE(ORIENTATION, orientation),
    .create = create,
    .destroy = free,
    .refuses = refuses,
    .bins = bins,
    .every = 2,
    .positions = true,
    .add_snapshot = add_snapshot,
    .curves = curves,
};
