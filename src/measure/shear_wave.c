/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The decay of a transverse wave with which a gas starts (common/shear_wave.h), and the shear viscosity from it. The
 * amplitude a obeys da/dt = -(eta/rho) k^2 a, and eta = eta* nT/nu_0(T) goes as sqrt(T). With the path
 * ds = sqrt(T) dt, T that of the velocities about the wave, the decay is exponential in a gas that cools or heats, too:
 *
 *     da/ds = -q a,   eta* = q rho nu_0(1)/(n k^2).
 *
 * The Gaussian thermostat acts on the wave as on every velocity. With the energy K of the centres it multiplies them in
 * a time dt by 1 + (loss + dK)/(2K). Without this factor the gas is one that cools freely, in a time of its own, and
 * the amplitude b obeys the equation above with the viscosity of the cooling gas. (In flow: small_shear the thermostat
 * acts on velocities about the flow: there eta* is another coefficient.) Drag would change the stress, too.
 *
 * Momentum that grains exchange at random disturbs b by white noise. The estimate with the least error is that of
 * least squares in the increments of b, whose weights w are proportional to b itself. An estimate of q gives them:
 *
 *     q = -int w db/int w b ds = [w b]/int w b ds - q_0,   w = exp(-q_0 s),
 *
 * of means over replicas, in which b stands linearly. The relative error of N grains in all is 2 v_0/(a_0 sqrt(N)),
 * however long the wave is. At first the stress has to build up: the first collisions are left out. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/shear_wave.h"
#include "common/thermostat.h"
#include "measure/displacement.h"
#include "measure/observable.h"

/* Collisions per grain that are left out. The stress relaxes in 1.25 of them or so, in a dense gas in fewer. */
enum { LEFT_OUT = 10 };

/* Channels: [w b] from the first sample to the last, int w b ds. */
enum { FALL, INTEGRAL, CHANNELS };

/* Sums of a point of the curves, one for each sample but the last: a sample is known after the snapshot at its end.
 * Samples beyond the last point have none. */
enum { MOST_POINTS = 256 };
enum { COUNT, TIME, PATH, GROWTH, AMPLITUDE, ROW, WIDTH = ROW + CHANNELS };

typedef struct shear_wave {
  const gg_model *model;
  gg_wave_sums sums; /* of the row that has begun, and the square of all velocities */
  double square;
  struct wave_state {
    double a, T, energy; /* of the last row, in the engine's units; T about the wave; energy in units of mass/2 */
    double unit;         /* the engine's velocities over those of the start */
    double path, growth; /* s; logarithm of a/b */
    double began;        /* w b of the first sample that counts, noise included: it may be below 0 */
    uint64_t counts;     /* 1: that sample was taken */
    double row[CHANNELS];
    double time;              /* since the start */
    uint64_t samples, points; /* rows since the start, and points that are in the bins */
  } now;
} shear_wave;

static const char *refuses(const gg_model *m)
{
  if (!(m->wave > 0)) return "there is no wave; give start.wave and run.duration";
  if (m->n_species > 1 || m->rule != GG_SMOOTH || gg_model_has_speed(m))
    return "measured of one species of smooth grains with a constant e";
  if (m->bath.on && m->bath.drag[0] != 0) return "drag, or a given gaussian_rate, acts on the wave, too";
  return NULL;
}

static void *create(const gg_model *model, gg_error *err)
{
  shear_wave *w = gg_base_array_new(1, sizeof *w, err);
  if (!w) return NULL;
  w->model = model;
  w->now.unit = 1;
  return w;
}

static void *memory_of(void *self, size_t *bytes)
{
  shear_wave *w = self;
  *bytes = sizeof w->now;
  return &w->now;
}

/* The sums begin anew at the present state. */
static void restart(void *self)
{
  struct wave_state *s = &((shear_wave *)self)->now;
  *s = (struct wave_state){.a = s->a, .T = s->T, .energy = s->energy, .unit = 1};
}

static size_t width(const gg_model *m)
{
  (void)m;
  return CHANNELS;
}

static void begin(void *self)
{
  shear_wave *w = self;
  w->sums = (gg_wave_sums){0};
  w->square = 0;
}

static void add_chunk(void *self, const gg_chunk *g)
{
  shear_wave *w = self;
  const double *const *c = g->whole_c[0] ? g->whole_c : g->c;
  for (size_t i = 0; i < g->n; i++) {
    gg_wave_add(&w->sums, 1, gg_wave_profile(w->model, g->r[1][i]), c[0][i]);
    w->square += c[0][i] * c[0][i] + c[1][i] * c[1][i] + c[2][i] * c[2][i];
  }
}

/* Estimate of q: Enskog's viscosity of elastic grains. Errors depend on it, the result does not. */
static double expected_decay(const gg_model *m)
{
  const double k = gg_wave_number(m), chi = m->chi[0], y = m->boltzmann ? 0 : m->phi * chi;
  const double eta = (1 + 1.6 * y) * (1 + 1.6 * y) / chi + 768 / (25 * M_PI) * (m->boltzmann ? 0 : m->phi * y);
  return eta * k * k / gg_common_model_nu0(m, 1);
}

/* Logarithm of the factor by which the thermostat has multiplied velocities; `before`: the energy at the beginning. */
static double growth_of(const gg_model *m, const gg_interval *in, double before, double now)
{
  const double middle = (before + now) / 2;
  if (!gg_common_keeps_energy(m)) return 0;
  return (2 * in->transfer->loss[GG_11] + now - before) / (2 * middle);
}

/* Integral of w b over a step of the path, of an exponential function that falls by about 2 q_0 step: less than that of
 * the trapezoid. */
static double integral_of(double before, double now, double step, double q0)
{
  const double x = q0 * step;
  return (before + now) / 2 * step * (x > 1e-6 ? tanh(x) / x : 1);
}

static void finish(void *self, const gg_interval *in, double *row)
{
  shear_wave *w = self;
  struct wave_state *s = &w->now;
  const gg_model *m = w->model;
  const double factor = in->velocity_factor, q0 = expected_decay(m), a = gg_wave_amplitude(&w->sums);
  const double T0 = s->T * factor * factor, energy0 = s->energy * factor * factor, b0 = s->a / s->unit;
  const double weighted0 = b0 * exp(-s->growth - q0 * s->path);
  s->a = a, s->energy = w->square;
  s->T = (w->square - (double)m->n * a * a / 2) / (3 * (double)m->n);
  s->unit *= factor;
  if (in->elapsed > 0) {
    const double step = gg_measure_displacement_path(sqrt(T0), sqrt(s->T), in->elapsed);
    s->growth += growth_of(m, in, energy0, w->square);
    s->path += step, s->time += in->elapsed * s->unit;
    s->samples++;
    const double weighted = a / s->unit * exp(-s->growth - q0 * s->path);
    if (s->counts) {
      s->row[FALL] = s->began - weighted;
      s->row[INTEGRAL] += integral_of(weighted0, weighted, step, q0);
    } else if (s->path * gg_common_model_collision_rate(m, 1) >= LEFT_OUT) {
      s->began = weighted, s->counts = 1;
    }
  }
  for (int k = 0; k < CHANNELS; k++) row[k] = s->row[k];
}

/* q of the sums of rows; NaN where none counts. */
static double decay(const double *mean, const gg_model *m)
{
  return mean[INTEGRAL] > 0 ? mean[FALL] / mean[INTEGRAL] - expected_decay(m) : NAN;
}

static double viscosity(const double *mean, const gg_model *m)
{
  const double k = gg_wave_number(m);
  return decay(mean, m) * gg_common_model_nu0(m, 1) / (k * k);
}

static const gg_derived derived[] = {
    {GG_Q_VISCOSITY_REDUCED, .of = viscosity,
     .unknown =
         "too short: the fit of the wave leaves out the first 10 collisions a grain; give run.duration a larger value"},
    GG_DERIVED_END,
};

static size_t bins_of(const void *self)
{
  (void)self;
  return MOST_POINTS * WIDTH;
}

static bool is_of_transient(const void *self)
{
  (void)self;
  return true;
}

static void add_snapshot(void *self, const gg_snapshot *snapshot, double *bins)
{
  struct wave_state *s = &((shear_wave *)self)->now;
  (void)snapshot;
  if (s->points > s->samples || s->points >= MOST_POINTS) return;
  double *at = bins + s->points++ * WIDTH;
  at[COUNT] += 1, at[TIME] += s->time, at[PATH] += s->path, at[GROWTH] += s->growth, at[AMPLITUDE] += s->a / s->unit;
  for (int k = 0; k < CHANNELS; k++) at[ROW + k] += s->row[k];
}

typedef struct decaying {
  const gg_model *m;
  size_t n; /* points */
  double point[MOST_POINTS][WIDTH];
} decaying;

static void read_points(decaying *d, const double *bins)
{
  for (d->n = 0; d->n < MOST_POINTS && bins[d->n * WIDTH + COUNT] > 0; d->n++)
    for (int k = 0; k < WIDTH; k++) d->point[d->n][k] = bins[d->n * WIDTH + k] / bins[d->n * WIDTH + COUNT];
}

/* Decay at q by the last point, beside the amplitude: its height by least squares. */
static void put_fit(const decaying *d, gg_curve *c)
{
  const double q = decay(d->point[d->n - 1] + ROW, d->m);
  double above = 0, below = 0;
  gg_measure_curve_beside(c, "exp(-q s)", gg_measure_curve_level, &(double){NAN});
  for (size_t i = 0; c->reference && i < c->n; i++) {
    c->reference[i] = exp(d->point[i][GROWTH] - q * d->point[i][PATH]);
    if (d->point[i][PATH] * gg_common_model_collision_rate(d->m, 1) < LEFT_OUT) continue;
    above += c->reference[i] * c->value[i], below += c->reference[i] * c->reference[i];
  }
  for (size_t i = 0; c->reference && i < c->n; i++) c->reference[i] *= above / below;
}

static gg_curve *put_curve(const decaying *d, const char *name, const char *symbol, const char *unit, gg_curves *list)
{
  gg_curve *c = gg_measure_curve_add(list, d->n, name, symbol, "measured");
  gg_measure_curve_axes(c, "t", gg_measure_curve_unit(d->m, "time"), symbol, unit);
  for (size_t i = 0; i < c->n; i++) c->x[i] = d->point[i][TIME];
  return c;
}

/* Fraction by which eta* of a finite wave in a dilute elastic gas exceeds that of a long one, over (k l)^2: -0.25(3),
 * from waves in Monte Carlo at phi = 0 with k l = 0.23, 0.36 and 0.45. The sign is that of the BGK model, whose rate is
 * smaller than eta k^2/rho by the fraction (k tau)^2 T/m. Grad's 13 moments have the other sign: the third moments
 * that they leave out are of the same order. */
#define CORRECTION (-0.25)

static void curves(const void *self, const double *bins, gg_curves *list)
{
  decaying d = {.m = ((const shear_wave *)self)->model};
  const double path = 1 / (M_SQRT2 * M_PI * d.m->density * d.m->chi[0]), kl = gg_wave_number(d.m) * path;
  read_points(&d, bins);
  if (d.n < 2) return;
  gg_curve *c = put_curve(&d, "shear_wave", "a", gg_measure_curve_unit(d.m, "velocity"), list);
  for (size_t i = 0; i < c->n; i++) c->value[i] = d.point[i][AMPLITUDE];
  put_fit(&d, c);
  gg_measure_curve_put_setting(c, "wavelength", d.m->box[1], gg_measure_curve_unit(d.m, "length"));
  gg_measure_curve_put_setting(c, "wavenumber_times_path", kl, "1");
  gg_measure_curve_put_setting(c, "expected_correction", CORRECTION * kl * kl, "1");
  c = put_curve(&d, "viscosity_of_wave", "η^*", "1", list);
  for (size_t i = 0; i < c->n; i++) c->value[i] = viscosity(d.point[i] + ROW, d.m);
}

const gg_observable gg_measure_shear_wave = {
    GG_OBSERVABLE(SHEAR_WAVE, shear_wave),
    .create = create,
    .destroy = free,
    .memory = memory_of,
    .refuses = refuses,
    .positions = true,
    .restart = restart,
    .rows =
        &(const gg_observable_rows){
            .width = width, .begin = begin, .add_chunk = add_chunk, .finish = finish, .derived = derived},
    .curves = &(const gg_observable_curves){.bins = bins_of,
                                            .every = 1,
                                            .of_transient = is_of_transient,
                                            .add_snapshot = add_snapshot,
                                            .of_bins = curves},
    .cost = {.ns = {2, 2}},
};
