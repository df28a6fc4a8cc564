/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transport coefficients of elastic grains at rest from the fluctuations of Helfand's moments (E. Helfand, Phys.
 * Rev. 119 (1960) 1; hard spheres: B.J. Alder, D.M. Gass and T.E. Wainwright, J. Chem. Phys. 53 (1970) 3813). The
 * moment sum r e, e the energy of a grain, grows by int sum e c dt while grains fly, and at a collision by sigma k
 * times the energy transferred from one to the other; sum r m c likewise by momenta. Images of the box do not enter.
 * With dG the growth in a sampling interval h, G(t) that in a time t,
 *   d<G^2>/dt/2 = [<dG_0^2>/2 + sum_k <dG_0 dG_k>]/h, k to LAST
 * is V T^2 kappa, V T eta (momenta, without trace), V T eta_b (a third of the trace, minus its mean): the Green-Kubo
 * integral from 0 to a time between LAST and LAST + 1 intervals, without a step in time. Its kinetic part is that of
 * the kinetic flux with the whole one.
 *
 * The noise of the sum is proportional to sqrt(LAST), 2 sqrt(LAST/(3 n)) of kappa for n intervals, at any size of
 * the box: small boxes are cheapest. They lack some of the fluctuations of a flux, because energy and momentum are
 * conserved: in a dilute gas kappa is 4.2/N low, eta 0.2/N. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/observable.h"

/* Intervals, of two collisions a grain: the last one of the quantities, and of the curves. A heat flux decays by 1/e
 * in 1.9 collisions. */
enum { LAST = 6, LAGS = 32 };
enum { HEAT, STRESS = HEAT + 3, MOMENTS = STRESS + 6 }; /* stress: xx, yy, zz, xy, xz, yz */
/* Products of two intervals. */
enum { KAPPA_KINETIC, KAPPA, ETA_KINETIC, ETA, BULK, PRODUCTS };
/* Channels of a row, all 0 until LAST intervals have passed; and of bins, followed by products by lag. */
enum { COUNT, TIME, TEMPERATURE, TRACE, SUMS, CHANNELS = SUMS + PRODUCTS };
enum { AT_LAG = 1 + PRODUCTS, BINS = SUMS + (LAGS + 1) * AT_LAG };

typedef struct growth {                          /* growth of the moments in an interval */
  double kinetic[MOMENTS], all[MOMENTS], excess; /* of a third of the trace over its expected value */
} growth;

typedef struct helfand {
  const gg_model *model;
  double row[CHANNELS], pressed; /* expected value of a third of the trace, over T and time */
  struct memory {
    uint64_t snapshots;
    double time;                /* time up to which `now` has flown */
    double flux[MOMENTS];       /* kinetic, at that time */
    growth now, last[LAGS + 1]; /* last: the interval that ended with snapshot i is at i % (LAGS + 1) */
  } memory;
} helfand;

static const char *refuses(const gg_model *m)
{
  return gg_common_model_missing(m, GG_NEEDS_FLUCTUATIONS);
}

static void *create(const gg_model *model, gg_error *err)
{
  helfand *h = gg_base_array_new(1, sizeof *h, err);
  if (!h) return NULL;
  h->model = model;
  h->pressed = (double)model->n;
  for (int i = 0; i < model->n_species; i++)
    for (int j = 0; j < model->n_species; j++) {
      const int q = gg_pair(i, j);
      const double pairs = (double)model->n_of[i] * (double)model->n_of[j] / model->volume;
      h->pressed += 2 * M_PI / 3 * pairs * pow(model->sigma[q], 3) * model->chi[q];
    }
  return h;
}

static void *memory_of(void *self, size_t *bytes)
{
  helfand *h = self;
  *bytes = sizeof h->memory;
  return &h->memory;
}

static size_t width(const gg_model *m)
{
  (void)m;
  return CHANNELS;
}

static size_t bins(const void *self)
{
  (void)self;
  return BINS;
}

static void restart(void *self)
{
  ((helfand *)self)->memory.snapshots = 0;
}

static void add_flux(double mass, gg_vec c, double times, double flux[MOMENTS])
{
  const double heat = times * mass * gg_dot(c, c) / 2, m = times * mass;
  const double add[MOMENTS] = {heat * c.x,    heat * c.y,    heat * c.z,    m * c.x * c.x, m * c.y * c.y,
                               m * c.z * c.z, m * c.x * c.y, m * c.x * c.z, m * c.y * c.z};
  for (int k = 0; k < MOMENTS; k++) flux[k] += add[k];
}

static void fly(struct memory *memory, double until)
{
  for (int k = 0; k < MOMENTS; k++) memory->now.kinetic[k] += memory->flux[k] * (until - memory->time);
  memory->time = until;
}

static void add_collision(void *self, const gg_collision_record *c)
{
  helfand *h = self;
  struct memory *memory = &h->memory;
  if (memory->snapshots == 0) return;
  const double one = h->model->mass[c->species[0]], two = h->model->mass[c->species[1]];
  const gg_vec J = c->J, after[2] = {gg_sub(c->c[0], gg_scale(1 / one, J)), gg_add(c->c[1], gg_scale(1 / two, J))};
  const gg_vec way = gg_scale(h->model->sigma[gg_pair(c->species[0], c->species[1])], c->k);
  const double energy = gg_dot(J, c->c[1]) + gg_dot(J, J) / (2 * two);
  const double jump[MOMENTS] = {energy * way.x,
                                energy * way.y,
                                energy * way.z,
                                way.x * J.x,
                                way.y * J.y,
                                way.z * J.z,
                                (way.x * J.y + way.y * J.x) / 2,
                                (way.x * J.z + way.z * J.x) / 2,
                                (way.y * J.z + way.z * J.y) / 2};
  fly(memory, c->time);
  for (int i = 0; i < 2; i++) {
    add_flux(i ? two : one, c->c[i], -1, memory->flux);
    add_flux(i ? two : one, after[i], 1, memory->flux);
  }
  for (int k = 0; k < MOMENTS; k++) memory->now.all[k] += jump[k];
}

static double trace(const double *moments)
{
  return (moments[STRESS] + moments[STRESS + 1] + moments[STRESS + 2]) / 3;
}

static double heat_product(const double *a, const double *b)
{
  return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / 3;
}

/* For a tensor without trace 10 times that of its xy. */
static double shear_product(const double *a, const double *b)
{
  double sum = -3 * trace(a) * trace(b);
  for (int k = 0; k < 6; k++) sum += (k < 3 ? 1 : 2) * a[STRESS + k] * b[STRESS + k];
  return sum / 10;
}

static void multiply(const growth *a, const growth *b, double *to)
{
  to[KAPPA] = heat_product(a->all, b->all);
  to[KAPPA_KINETIC] = (heat_product(a->kinetic, b->all) + heat_product(a->all, b->kinetic)) / 2;
  to[ETA] = shear_product(a->all, b->all);
  to[ETA_KINETIC] = (shear_product(a->kinetic, b->all) + shear_product(a->all, b->kinetic)) / 2;
  to[BULK] = a->excess * b->excess;
}

/* An interval has ended: its products with those before, half of that with itself. */
static void correlate(helfand *h, double elapsed, double T, double *bin)
{
  struct memory *memory = &h->memory;
  const uint64_t now = memory->snapshots;
  const growth *latest = &memory->last[now % (LAGS + 1)];
  const double of_all[SUMS] = {1, elapsed, T, latest->excess};
  double sums[PRODUCTS] = {0};
  for (int k = 0; k < SUMS; k++) bin[k] += of_all[k];
  for (uint64_t lag = 0; lag <= LAGS && lag < now; lag++) {
    double product[PRODUCTS], *at = bin + SUMS + lag * AT_LAG;
    multiply(latest, &memory->last[(now - lag) % (LAGS + 1)], product);
    at[0]++;
    for (int k = 0; k < PRODUCTS; k++) {
      const double p = lag ? product[k] : product[k] / 2;
      at[1 + k] += p;
      if (lag <= LAST) sums[k] += p;
    }
  }
  if (now <= LAST) return;
  memcpy(h->row, of_all, sizeof of_all);
  memcpy(h->row + SUMS, sums, sizeof sums);
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  helfand *h = self;
  struct memory *memory = &h->memory;
  double flux[MOMENTS] = {0};
  for (size_t i = 0; i < s->n; i++)
    add_flux(h->model->mass[gg_snapshot_species(s, i)], (gg_vec){s->c[0][i], s->c[1][i], s->c[2][i]}, 1, flux);
  if (memory->snapshots > 0) {
    fly(memory, s->time);
    growth *latest = &memory->last[memory->snapshots % (LAGS + 1)];
    *latest = memory->now;
    for (int k = 0; k < MOMENTS; k++) latest->all[k] += latest->kinetic[k];
    const double T = trace(flux) / (double)s->n;
    latest->excess = trace(latest->all) - h->pressed * T * s->elapsed;
    correlate(h, s->elapsed, T, bin);
  }
  memory->now = (growth){.excess = 0};
  memory->time = s->time;
  memcpy(memory->flux, flux, sizeof flux);
  memory->snapshots++;
}

/* The row is that of the snapshot at the end of its interval; 0 before averaging. */
static void finish(void *self, const gg_interval *in, double *row)
{
  helfand *h = self;
  (void)in;
  memcpy(row, h->row, sizeof h->row);
  memset(h->row, 0, sizeof h->row);
}

/* In units of kappa_0 or eta_0 (quantity.h). */
static double reduced(const double *mean, const gg_model *m, int product, double sum)
{
  const double T = mean[TEMPERATURE] / mean[COUNT], nu0 = gg_common_model_nu0(m, T), p = m->density * T;
  const double coefficient = sum / (mean[TIME] * m->volume * T);
  return product <= KAPPA ? 4. / 15 * nu0 / p * coefficient / T : nu0 / p * coefficient;
}

/* The square of the mean, times `lags`, to be subtracted if there is a mean. */
static double without_mean(const double *mean, int product, double lags)
{
  return product == BULK ? (lags + 0.5) * mean[TRACE] * mean[TRACE] / mean[COUNT] : 0;
}

static double of_means(const double *mean, const gg_model *m, int product)
{
  return reduced(mean, m, product, mean[SUMS + product] - without_mean(mean, product, LAST));
}

static double kappa_kinetic(const double *mean, const gg_model *m)
{
  return of_means(mean, m, KAPPA_KINETIC);
}
static double kappa(const double *mean, const gg_model *m)
{
  return of_means(mean, m, KAPPA);
}
static double eta_kinetic(const double *mean, const gg_model *m)
{
  return of_means(mean, m, ETA_KINETIC);
}
static double eta(const double *mean, const gg_model *m)
{
  return of_means(mean, m, ETA);
}
static double bulk(const double *mean, const gg_model *m)
{
  return of_means(mean, m, BULK);
}

static const gg_derived derived[] = {
    {GG_Q_THERMAL_CONDUCTIVITY_REDUCED, .of = kappa},
    {GG_Q_THERMAL_CONDUCTIVITY_REDUCED_KINETIC, .of = kappa_kinetic},
    {GG_Q_VISCOSITY_REDUCED, .of = eta},
    {GG_Q_VISCOSITY_REDUCED_KINETIC, .of = eta_kinetic},
    {GG_Q_BULK_VISCOSITY_REDUCED, .of = bulk},
    GG_DERIVED_END,
};

/* Coefficients of the integral up to a time: where they are constant the time is long enough. */
static void put(const helfand *h, const double *bin, int product, const char *name, const char *panel,
                const char *label, gg_curves *list)
{
  gg_curve *c = gg_measure_curve_add(list, LAGS + 1, name, panel, label);
  gg_measure_curve_axes(c, "ν_0 t", "1", label, "1");
  const double step = bin[TIME] / bin[COUNT] * gg_common_model_nu0(h->model, bin[TEMPERATURE] / bin[COUNT]);
  double sum = 0;
  for (int lag = 0; lag <= LAGS && c->n; lag++) {
    const double *at = bin + SUMS + lag * AT_LAG;
    sum += at[1 + product] / at[0];
    c->x[lag] = (lag + 0.5) * step;
    c->value[lag] = reduced(bin, h->model, product, bin[COUNT] * sum - without_mean(bin, product, lag));
  }
}

static void curves(const void *self, const double *bin, gg_curves *list)
{
  const helfand *h = self;
  if (!gg_common_model_missing(h->model, GG_NEEDS_HEAT_FLUX))
    put(h, bin, KAPPA, "thermal_conductivity_up_to", "thermal conductivity", "κ*", list);
  put(h, bin, ETA, "viscosity_up_to", "viscosity", "η*", list);
  put(h, bin, BULK, "bulk_viscosity_up_to", "bulk viscosity", "η_b*", list);
}

const gg_observable gg_measure_helfand = {
    GG_OBSERVABLE(HELFAND, helfand),
    .create = create,
    .destroy = free,
    .memory = memory_of,
    .refuses = refuses,
    .restart = restart,
    .rows = &(const gg_observable_rows){.width = width, .finish = finish, .derived = derived},
    .curves = &(const gg_observable_curves){.bins = bins, .every = 1, .add_snapshot = add_snapshot, .of_bins = curves},
    .collisions = &(const gg_observable_collisions){.add = add_collision},
    .cost = {.ns = {40, 0}},
};
