/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/enskog_hermite.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "measure/velocity_distributions.h"
#include "theory/answer.h"
#include "theory/hermite/component.h"
#include "theory/hermite/hermite_mixture.h"
#include "theory/hermite/isotropic.h"
#include "theory/hermite/shear.h"

static const char name[] = "enskog_hermite";

/* One approximation: the marginal of each species and axis, and T_i/T; the spins of one rough species. */
typedef struct solution {
  gg_hermite_component marginal[GG_MAX_SPECIES][3], spin[3];
  double share[GG_MAX_SPECIES];
} solution;

/* The last three approximations, the last first. */
typedef struct series {
  int n;
  bool isotropic, spins;
  solution rung[3];
} series;

static solution *next(series *s)
{
  s->rung[2] = s->rung[1], s->rung[1] = s->rung[0];
  s->n++;
  return &s->rung[0];
}

/* Size of the last step, in the coefficients that matter most. */
static double last_step(const series *s, int n_species)
{
  double most = s->n < 2 ? INFINITY : 0;
  for (int i = 0; i < n_species; i++)
    for (int a = 0; a < 3; a++)
      for (int k = 3; k <= 6 && s->n > 1; k++)
        most = fmax(most, fabs(s->rung[0].marginal[i][a].t[k] - s->rung[1].marginal[i][a].t[k]));
  return most;
}

/* Degrees under shear: the second only if the first leaves more than `good`; the last for mixtures, which take
 * longer. */
enum {
  FIRST_DEGREE = 4,
  GOOD_DEGREE = 10,
  LAST_DEGREE = 12,
  MIXED_DEGREE = 8,
  ISOTROPIC_DEGREE = 18,
  MOST_SQUARES = 7
};
static const double good = 1e-4;

static void put_marginals(gg_hermite_shear *h, solution *x)
{
  for (int i = 0; i < h->gas.n_species; i++)
    for (int a = 0; a < 3; a++) x->marginal[i][a] = gg_hermite_component_of(&h->op.basis, &h->state[i], a);
}

static gg_status sheared(const gg_model *m, series *s, gg_error *err)
{
  gg_hermite_shear h;
  int last = gg_hermite_shear_last_degree(m->n_species);
  if (!last) return gg_base_fail(err, GG_BAD_INPUT, "these are too many species");
  GG_TRY(gg_hermite_shear_begin(&h, m, err));
  gg_status status = GG_OK;
  for (int degree = FIRST_DEGREE; degree <= last && status == GG_OK; degree += 2) {
    if (degree > GOOD_DEGREE && last_step(s, m->n_species) < good) break;
    status = gg_hermite_shear_solve(&h, degree, err);
    if (status == GG_OK) put_marginals(&h, next(s));
  }
  bool widened = false;
  if (status == GG_OK) status = gg_hermite_shear_widen(&h, &widened, err);
  if (status == GG_OK && widened) put_marginals(&h, next(s));
  gg_hermite_shear_end(&h);
  return status;
}

static gg_status one_isotropic(const gg_model *m, series *s, gg_error *err)
{
  double frequency = m->density * m->chi[0] * m->sigma[0] * m->sigma[0];
  const gg_heating heating = gg_theory_heating_of(m);
  for (int degree = FIRST_DEGREE; degree <= ISOTROPIC_DEGREE; degree += 2) {
    gg_hermite_isotropic h;
    GG_TRY(gg_stop_check(m->stop, err));
    GG_TRY(gg_hermite_isotropic_solve(&h, degree, frequency, m->contact[0][0].jn, &heating, err));
    solution *x = next(s);
    x->share[0] = 1;
    for (int a = 0; a < 3; a++) x->marginal[0][a] = gg_hermite_component_of(&h.op.basis, &h.state, 2);
    gg_hermite_isotropic_end(&h);
  }
  return GG_OK;
}

static gg_status mixed_isotropic(const gg_model *m, series *s, gg_error *err)
{
  gg_hermite_mixture h = {.drive = gg_theory_heating_of(m)};
  for (int most = FIRST_DEGREE / 2; most <= MOST_SQUARES; most++) {
    double even[GG_RADIAL_MOST + 1], T = 0;
    GG_TRY(gg_hermite_mixture_solve(&h, m, most, err));
    solution *x = next(s);
    for (int i = 0; i < m->n_species; i++) {
      gg_hermite_component marginal = {.degree = 2 * most};
      gg_hermite_radial_marginal(&h.radial, h.alpha[i], even);
      for (int l = 0; l <= most; l++) marginal.t[2 * l] = even[l];
      for (int a = 0; a < 3; a++) x->marginal[i][a] = marginal;
      x->share[i] = m->mass[i] * h.scale[i] * h.scale[i] * gg_hermite_mixture_square(&h, i);
      T += gg_theory_fraction(m, i) * x->share[i];
    }
    for (int i = 0; i < m->n_species; i++) x->share[i] /= T;
  }
  return GG_OK;
}

static gg_status rough(const gg_model *m, series *s, gg_error *err)
{
  gg_rough_marginals x;
  GG_TRY(gg_rough_marginals_of(m, &x, err));
  for (int rung = 0; rung < 3; rung++) {
    memcpy(s->rung[rung].marginal[0], x.of[rung][0], sizeof x.of[rung][0]);
    memcpy(s->rung[rung].spin, x.of[rung][1], sizeof x.of[rung][1]);
    s->rung[rung].share[0] = 1;
  }
  return GG_OK;
}

static void put(const gg_model *m, unsigned measure, const series *s, const solution *x, gg_curves *list)
{
  double bin[GG_HISTOGRAM];
  for (int i = 0; i < m->n_species && measure & GG_MEASURE_VELOCITY_DISTRIBUTIONS; i++)
    for (int a = 0; a < 3; a++) {
      list->group = "velocity_distributions";
      gg_hermite_component_histogram(&x->marginal[i][a], bin);
      gg_measure_velocity_curves_put(list, (gg_velocity_component){m->n_species, i, false, a}, bin, 0);
    }
  for (int a = 0; a < 3 && s->spins && measure & GG_MEASURE_VELOCITY_DISTRIBUTIONS; a++) {
    gg_hermite_component_histogram(&x->spin[a], bin);
    gg_measure_velocity_curves_put(list, (gg_velocity_component){m->n_species, 0, true, a}, bin, 0);
  }
  for (int i = 0; i < m->n_species && s->isotropic && measure & GG_MEASURE_SONINE; i++) {
    gg_sonine_sums sums = {.temperature_ratio = x->share[i]};
    list->group = "sonine";
    gg_hermite_component_speeds(&x->marginal[i][0], &sums);
    gg_measure_sonine_curves_put(list, m, i, &sums);
  }
}

static const double share = 0.25;

static double step(const gg_curve *a, const gg_curve *b, size_t i)
{
  return fabs(a->value[i] - b->value[i]);
}

static size_t middle_of(const gg_curve *c)
{
  size_t at = 0;
  for (size_t i = 0; i < c->n; i++)
    if (fabs(c->x[i]) < fabs(c->x[at])) at = i;
  return at;
}

/* The scale of an error: a distribution's own value; for other curves the largest known value. */
static double scale_of(const gg_curve *c)
{
  double most = 0;
  for (size_t i = 0; i < c->n && !c->log_y; i++)
    if (c->error[i] <= share * fabs(c->value[i])) most = fmax(most, fabs(c->value[i]));
  return most;
}

/* Cut the curve on one side of the middle where it is no longer known. Returns the last known x. */
static double cut(gg_curve *c, double scale, size_t from, int direction)
{
  double last = c->x[from];
  bool known = true;
  for (size_t i = from; i < c->n; i += (size_t)direction) { /* below 0 the index wraps around, and the loop ends */
    known = known && c->error[i] <= share * (c->log_y ? c->value[i] : scale) && (!c->log_y || c->value[i] > 0);
    if (known)
      last = c->x[i];
    else
      c->value[i] = c->error[i] = NAN;
  }
  return last;
}

/* The last approximation, with the distance of each point from the limit as its error: the last step, or a tenth of
 * the last two, whichever is larger. From x = 0 outwards, a curve ends where it is no longer known: a distribution
 * (drawn over a logarithmic axis) where it is not above 0 or not within a quarter of itself, any other curve where
 * it is not within a quarter of its largest value so far. Beyond, its values are NaN; the numbers "known_from",
 * "known_to" are the ends. `before` and `earlier`: the previous approximations, of the same shape; earlier may be
 * NULL. */
static void converge(gg_curves *last, const gg_curves *before, const gg_curves *earlier)
{
  for (int k = 0; k < last->n; k++) {
    gg_curve *c = &last->curve[k];
    for (size_t i = 0; i < c->n; i++) {
      c->error[i] = step(c, &before->curve[k], i);
      if (earlier) c->error[i] = fmax(c->error[i], step(c, &earlier->curve[k], i) / 10);
    }
    for (int i = 0; i < c->n_numbers; i++) {
      double value = c->number[i].value, error = fabs(value - before->curve[k].number[i].value);
      if (earlier) error = fmax(error, fabs(value - earlier->curve[k].number[i].value) / 10);
      c->number[i].error = error;
    }
    size_t middle = middle_of(c);
    double scale = scale_of(c), to = cut(c, scale, middle, 1), from = middle ? cut(c, scale, middle, -1) : c->x[0];
    gg_measure_curve_put_setting(c, "known_from", from, c->x_unit);
    gg_measure_curve_put_setting(c, "known_to", to, c->x_unit);
  }
}

static gg_status write(const gg_model *m, unsigned measure, const series *s, gg_curves *list, gg_error *err)
{
  gg_curves before[2] = {{.model = m}, {.model = m}};
  put(m, measure, s, &s->rung[0], list);
  put(m, measure, s, &s->rung[1], &before[0]);
  put(m, measure, s, &s->rung[2], &before[1]);
  bool failed = list->failed || before[0].failed || before[1].failed;
  if (!failed) converge(list, &before[0], &before[1]);
  for (int k = 0; k < 2; k++) gg_measure_curves_clear(&before[k]);
  return failed ? gg_base_out_of_memory(err) : GG_OK;
}

gg_status gg_hermite_curves(const gg_model *m, unsigned measure, gg_curves *list, gg_error *err)
{
  series s = {.isotropic = m->flow != GG_USF && m->flow != GG_HEATED_SHEAR, .spins = m->rule != GG_SMOOTH};
  gg_error why;
  if (!(measure & GG_MEASURE_VELOCITY_DISTRIBUTIONS) && !(s.isotropic && measure & GG_MEASURE_SONINE)) return GG_OK;
  if (m->rule != GG_SMOOTH && m->n_species > 1)
    return gg_theory_reject(err, name, "has no distributions of rough mixtures");
  if (s.spins && !s.isotropic)
    return gg_theory_reject(
        err, name, "has no distributions of sheared rough grains: its series, of degree 6, is too short for them");
  if (!s.isotropic) GG_TRY(gg_theory_require_steady_shear(m, name, err));
  gg_status status = s.spins             ? rough(m, &s, &why)
                     : !s.isotropic      ? sheared(m, &s, &why)
                     : m->n_species == 1 ? one_isotropic(m, &s, &why)
                                         : mixed_isotropic(m, &s, &why);
  if (status != GG_OK && s.spins) return gg_base_fail(err, status, "%s", why.message); /* names the theory */
  return status == GG_OK ? write(m, measure, &s, list, err)
                         : gg_theory_reject(err, name, "fails here: %s", why.message);
}
