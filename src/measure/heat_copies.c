/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/heat_copies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { SPIN = 3, WEIGHTS = 6 }; /* of a grain */

static double inertia_of(const gg_model *m)
{
  return m->rule == GG_SMOOTH ? 0 : m->inertia[0];
}

gg_heat_layout gg_measure_heat_layout(const gg_model *m)
{
  const int n = inertia_of(m) > 0 ? GG_HEAT_ORDERS : GG_HEAT_SMOOTH;
  const int f = n == GG_HEAT_SMOOTH ? 1 : m->boltzmann ? 2 : GG_HEAT_FLUXES;
  gg_heat_layout l = {.n = n, .fluxes = f, .diverged = n, .distant_T = 2 * n, .distant_n = 3 * n, .carried = 4 * n};
  l.overlap = l.carried + 2, l.at_lag = l.overlap + n * n;
  l.fading = 1, l.kept = 2, l.flux[0] = 2 + n * n, l.flux[1] = l.flux[0] + f * n, l.lag = l.flux[1] + f * n;
  l.channels = l.at_lag + l.lag;
  l.steps = n == GG_HEAT_SMOOTH ? 4 : GG_HEAT_STEPS; /* with 4 kappa_r is 0.2 % low */
  return l;
}

gg_status gg_measure_heat_copies_make(gg_heat_copies *d, const gg_model *model, gg_error *err)
{
  *d = (gg_heat_copies){.model = model, .at = gg_measure_heat_layout(model), .K = inertia_of(model)};
  d->size = WEIGHTS + 3 * d->at.n;
  d->grain = gg_base_array_new((size_t)model->n, (size_t)d->size * sizeof *d->grain, err);
  return d->grain ? GG_OK : GG_FAILED;
}

void gg_measure_heat_copies_clear(gg_heat_copies *d)
{
  free(d->grain);
}

/* Correction for grains with a fixed total energy, D degrees of freedom of it: <C^j> is lower by j (j - 2)/(4 D)
 * (sonine.c). */
static double shared(const gg_heat_copies *d, int j)
{
  return 1 + j * (j - 2) / (4 * 3 * (double)(d->model->n - 1));
}

static void add_moments(const gg_heat_copies *d, double *bin)
{
  const gg_heat_layout *l = &d->at;
  double projected[GG_HEAT_ORDERS] = {0}, diverged[GG_HEAT_ORDERS] = {0}, factor[GG_HEAT_ORDERS],
         unit = 1 / (3 * (double)d->model->n);
  for (int i = 0; i < d->model->n; i++) {
    const double *c = d->grain + i * d->size, *s = c + SPIN, square = gg_heat_dot(c, c), C = sqrt(square);
    double p = 1;
    for (int k = 0; k < GG_HEAT_SMOOTH; k++) p *= C, projected[k] += p * square, diverged[k] += (4 + k) * p;
    if (l->n == GG_HEAT_SMOOTH) continue;
    const double spins = gg_heat_dot(s, s), both = gg_heat_dot(c, s);
    gg_heat_factors(C, sqrt(spins), factor);
    for (int k = GG_HEAT_SMOOTH; k < l->n; k++) {
      const gg_heat_function f = gg_heat_functions[k];
      const double along[] = {square, both * both, 0}, turned[] = {3 + f.speed, spins + f.speed * along[1] / square, 0};
      projected[k] += factor[k] * along[f.vector], diverged[k] += factor[k] * turned[f.vector];
    }
  }
  for (int k = 0; k < l->n; k++) {
    bin[l->projected + k] += unit * projected[k] * (k < GG_HEAT_SMOOTH ? shared(d, k + 3) : 1);
    bin[l->diverged + k] += unit * diverged[k] * (k < GG_HEAT_SMOOTH ? shared(d, k + 1) : 1);
  }
}

/* The impulse J = eta2 g + (eta1 - eta2) k g_n on grain 1 of a pair with c, s the difference of velocities and the
 * sum of spins; its effect on velocity and spin, k along an axis. Linear. */
static inline void kick(const gg_model *m, double K, int axis, const double *c, const double *s, double *dc, double *ds)
{
  const double eta1 = m->contact[0][0].jn, eta2 = m->contact[0][0].jt;
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  dc[axis] = -eta1 * c[axis], dc[j] = dc[k] = ds[0] = ds[1] = ds[2] = 0;
  if (K == 0) return;
  dc[j] = -eta2 * (c[j] + s[k]), dc[k] = -eta2 * (c[k] - s[j]); /* g = c - k x s */
  ds[j] = -dc[k] / K, ds[k] = dc[j] / K;                        /* -(k x J)/K */
}

/* A pair along an axis: grain 1 and its partner, ahead, the relative velocity; grain 1 after a collision. */
typedef struct axis_pair {
  const double *c[2], *s[2];
  double g, after_c[3], after_s[3], energy[2]; /* energy: gained, of translation and rotation */
} axis_pair;

static inline axis_pair meet(const gg_heat_copies *d, const double *one, const double *two, int axis)
{
  const double K = d->K;
  const bool ahead = one[axis] > two[axis];
  const double *a = ahead ? one : two, *b = ahead ? two : one;
  axis_pair m = {{a, b}, {a + SPIN, b + SPIN}, a[axis] - b[axis], {0}, {0}, {0}};
  double c[3], s[3], dc[3], ds[3];
  for (int k = 0; k < 3; k++) c[k] = a[k] - b[k], s[k] = a[SPIN + k] + b[SPIN + k];
  kick(d->model, K, axis, c, s, dc, ds);
  for (int k = 0; k < 3; k++) {
    m.after_c[k] = a[k] + dc[k], m.after_s[k] = a[SPIN + k] + ds[k];
    m.energy[0] += dc[k] * (a[k] + dc[k] / 2), m.energy[1] += K * ds[k] * (a[SPIN + k] + ds[k] / 2);
  }
  return m;
}

/* Derivative of the energies times g, if grain 2 has more of velocity and spin by a fraction, and grain 1 less. */
static void tilt(const gg_heat_copies *d, const axis_pair *m, int axis, double *of)
{
  const double K = d->K, *a = m->c[0], *b = m->c[1], *s = m->s[0], *t = m->s[1];
  double c[3], w[3], dc[3], ds[3];
  for (int k = 0; k < 3; k++) c[k] = -a[k] - b[k], w[k] = t[k] - s[k];
  kick(d->model, K, axis, c, w, dc, ds);
  of[0] = m->energy[0] * c[axis], of[1] = m->energy[1] * c[axis];
  for (int k = 0; k < 3; k++) { /* of (x'^2 - x^2)/2, x growing by -x */
    of[0] += m->g * (m->after_c[k] * (dc[k] - a[k]) + a[k] * a[k]);
    of[1] += m->g * K * (m->after_s[k] * (ds[k] - s[k]) + s[k] * s[k]);
  }
}

/* Add a pair: partners a diameter away have another temperature, or density. */
static void add_axis_pair(const gg_heat_copies *d, const axis_pair *m, int axis, double w, double *bin)
{
  const gg_heat_layout *l = &d->at;
  const double *partner = m->c[1], *spin = m->s[1];
  double before[GG_HEAT_ORDERS], after[GG_HEAT_ORDERS], along[GG_HEAT_ORDERS], c[3], dc[3], ds[3], carried[2];
  for (int k = 0; k < 3; k++) c[k] = -partner[k];
  kick(d->model, d->K, axis, c, spin, dc, ds);
  gg_heat_values(l->n, sqrt(gg_heat_dot(m->c[0], m->c[0])), m->c[0], m->s[0], axis, before);
  gg_heat_values(l->n, sqrt(gg_heat_dot(m->after_c, m->after_c)), m->after_c, m->after_s, axis, after);
  gg_heat_slopes(l->n, m->after_c, m->after_s, dc, ds, axis, along);
  tilt(d, m, axis, carried);
  for (int k = 0; k < l->n; k++) {
    const double change = after[k] - before[k];
    bin[l->distant_T + k] += w / 2 * (m->g * along[k] - partner[axis] * change);
    bin[l->distant_n + k] += w * m->g * change;
  }
  for (int k = 0; k < 2; k++) bin[l->carried + k] += w / 8 * carried[k];
}

/* Pairs at a random distance in the ensemble's order. */
static void add_pairs(const gg_heat_copies *d, gg_rng *rng, double *bin)
{
  const uint32_t n = (uint32_t)d->model->n, shift = 1 + gg_rng_below(rng, n - 1), size = (uint32_t)d->size;
  const double w = 1 / (6 * (double)n);
  for (uint32_t i = 0; i < n; i++)
    for (int k = 0; k < 3; k++) {
      const axis_pair m = meet(d, d->grain + i * size, d->grain + (i + shift) % n * size, k);
      add_axis_pair(d, &m, k, w, bin);
    }
}

/* Make copies at T = 1; the weights are b_n without its momentum. */
static void copy(gg_heat_copies *d, const gg_snapshot *s, double T)
{
  const double unit = 1 / sqrt(T);
  const int n = d->at.n;
  memset(d->momentum, 0, sizeof d->momentum);
  for (size_t i = 0; i < s->n; i++) {
    double *g = d->grain + i * (size_t)d->size, b[GG_HEAT_ORDERS];
    for (int a = 0; a < 3; a++) g[a] = s->c[a][i] * unit, g[SPIN + a] = n == GG_HEAT_SMOOTH ? 0 : s->s[a][i] * unit;
    const double C = sqrt(gg_heat_dot(g, g));
    for (int a = 0; a < 3; a++) {
      gg_heat_values(n, C, g, g + SPIN, a, b);
      for (int k = 0; k < n; k++) g[WEIGHTS + 3 * k + a] = b[k], d->momentum[k] += g[a] * b[k] / (3 * (double)s->n);
    }
  }
  for (size_t i = 0; i < s->n; i++) {
    double *g = d->grain + i * (size_t)d->size;
    for (int k = 0; k < n; k++)
      for (int a = 0; a < 3; a++) g[WEIGHTS + 3 * k + a] -= g[a] * d->momentum[k];
  }
}

/* Add <b_m w_n> of a grain, preceded by <C w_n>. */
static inline void add_overlap(int n, const double *g, double sum[][GG_HEAT_ORDERS])
{
  const double *s = g + SPIN, C = sqrt(gg_heat_dot(g, g)), both = gg_heat_dot(g, s);
  double factor[GG_HEAT_ORDERS], across[3];
  if (n > GG_HEAT_SMOOTH) {
    gg_heat_factors(C, sqrt(gg_heat_dot(s, s)), factor);
    for (int a = 0; a < 3; a++) across[a] = gg_heat_crossed(s, g, a);
  }
  for (int k = 0; k < n; k++) {
    const double *w = g + WEIGHTS + 3 * k;
    double p = gg_heat_dot(g, w);
    if (n > GG_HEAT_SMOOTH) {
      const double part[] = {p, gg_heat_dot(s, w) * both, gg_heat_dot(across, w)};
      for (int m = GG_HEAT_SMOOTH; m < n; m++) sum[1 + m][k] += factor[m] * part[gg_heat_functions[m].vector];
    }
    for (int m = 0; m <= GG_HEAT_SMOOTH; m++, p *= C) sum[m][k] += p;
  }
}

/* <b_m w_n> of the copies in units of their own T, which is returned; b_m without momentum, which w_n has only as
 * noise. */
static double overlap(const gg_heat_copies *d, double *to)
{
  const int many = d->model->n, n = d->at.n;
  double squares = 0, sum[GG_HEAT_ORDERS + 1][GG_HEAT_ORDERS] = {{0}};
  for (int i = 0; i < many; i++) {
    const double *g = d->grain + i * d->size;
    squares += gg_heat_dot(g, g);
    if (n == GG_HEAT_SMOOTH)
      add_overlap(GG_HEAT_SMOOTH, g, sum);
    else
      add_overlap(GG_HEAT_ORDERS, g, sum);
  }
  const double T = squares / (3 * (double)many), unit = 1 / (3 * (double)many);
  for (int m = 0; m < n; m++)
    for (int k = 0; k < n; k++)
      to[m * n + k] =
          unit * (pow(T, -gg_heat_functions[m].degree / 2.) * sum[m + 1][k] - d->momentum[m] / sqrt(T) * sum[0][k]);
  return T;
}

/* Fluxes of the weights, T that of the copies: kinetic ones are two of the functions b, collisional transfer is that
 * of pairs. */
static void fluxes(const gg_heat_copies *d, gg_rng *rng, double T, const double *overlaps,
                   double (*flux)[GG_HEAT_ORDERS])
{
  const double K = d->K, frequency = 4 * M_PI / 3 * d->model->density * d->model->chi[0];
  const gg_heat_layout *l = &d->at;
  const uint32_t many = (uint32_t)d->model->n;
  memset(flux, 0, GG_HEAT_FLUXES * sizeof *flux);
  for (int k = 0; k < l->n; k++) {
    flux[GG_HEAT_TRANSLATION][k] = overlaps[GG_HEAT_ENERGY * l->n + k] / 2;
    if (l->fluxes > 1) flux[GG_HEAT_ROTATION][k] = K / 2 * overlaps[GG_HEAT_SPIN_ENERGY * l->n + k];
  }
  if (l->fluxes < GG_HEAT_FLUXES) return;
  const double unit = -frequency / (2 * 6 * (double)many * T * sqrt(T));
  const uint32_t shift = 1 + gg_rng_below(rng, many - 1), size = (uint32_t)d->size;
  for (uint32_t i = 0; i < many; i++)
    for (int a = 0; a < 3; a++) {
      const double *one = d->grain + i * size, *two = d->grain + (i + shift) % many * size;
      const axis_pair m = meet(d, one, two, a);
      for (int k = 0; k < l->n; k++) {
        const double w = unit * m.g * (one[WEIGHTS + 3 * k + a] + two[WEIGHTS + 3 * k + a]);
        flux[GG_HEAT_CARRIED_TRANSLATION][k] += w * m.energy[0], flux[GG_HEAT_CARRIED_ROTATION][k] += w * m.energy[1];
      }
    }
}

/* For rough grains: the tangential impulse, and its effect on spins; `normal` is half of c12's along k. */
static void rub(const gg_heat_copies *d, double *a, double *b, const double c12[3], const double normal[3])
{
  const double length = sqrt(gg_heat_dot(normal, normal)), eta2 = d->model->contact[0][0].jt;
  double J[3], spins[3];
  for (int i = 0; i < 3; i++) spins[i] = a[SPIN + i] + b[SPIN + i];
  for (int i = 0; i < 3; i++) {
    J[i] = eta2 * (c12[i] - normal[i] - gg_heat_crossed(normal, spins, i) / length);
    a[i] -= J[i], b[i] += J[i];
  }
  for (int i = 0; i < 3; i++) {
    const double twist = gg_heat_crossed(normal, J, i) / (length * d->K);
    a[SPIN + i] -= twist, b[SPIN + i] -= twist;
  }
}

/* Collide two copies: both get the sum of their weights, and the velocities after a collision: with r uniform on the
 * sphere c12 - |c12| r is twice the normal velocity. */
static void collide(const gg_heat_copies *d, double *a, double *b, const double c12[3], double speed, gg_rng *rng)
{
  const gg_vec r = gg_rng_direction(rng);
  const double turned[3] = {r.x, r.y, r.z}, eta = d->model->contact[0][0].jn;
  double normal[3];
  for (int k = 0; k < 3; k++) {
    normal[k] = (c12[k] - speed * turned[k]) / 2;
    a[k] -= eta * normal[k], b[k] += eta * normal[k];
  }
  if (d->K > 0) rub(d, a, b, c12, normal);
  for (int k = WEIGHTS; k < d->size; k++) a[k] = b[k] = a[k] + b[k];
}

static void reject(const gg_heat_copies *d, double *a, double *b, double odds)
{
  for (int k = WEIGHTS; k < d->size; k++) {
    const double one = a[k], two = b[k];
    a[k] -= odds * two, b[k] -= odds * one;
  }
}

/* Far above all relative speeds at T = 1, so that rejection factors are small. */
static const double majorant = 12;

/* One step with as many candidates as grains; returns the time that they represent. */
static double step(gg_heat_copies *d, gg_rng *rng)
{
  const uint32_t n = (uint32_t)d->model->n;
  const double sigma = d->model->sigma[0];
  for (uint32_t candidate = 0; candidate < n; candidate++) {
    const uint32_t i = gg_rng_below(rng, n), j = gg_rng_below(rng, n - 1);
    double *a = d->grain + (size_t)i * (size_t)d->size, *b = d->grain + (size_t)(j < i ? j : j + 1) * (size_t)d->size;
    double c12[3];
    for (int k = 0; k < 3; k++) c12[k] = a[k] - b[k];
    const double speed = sqrt(gg_heat_dot(c12, c12)), p = fmin(speed / majorant, 0.9);
    if (gg_rng_uniform(rng) < p)
      collide(d, a, b, c12, speed, rng);
    else
      reject(d, a, b, p / (1 - p));
  }
  return 2 / ((1 - 1. / n) * M_PI * d->model->density * d->model->chi[0] * sigma * sigma * majorant);
}

/* The lags, one after the other. Time from step to step: the gas cools as 1/(1 + rate t). Integrals by the
 * trapezoidal rule, with Gregory's correction at both ends. */
static void follow(gg_heat_copies *d, gg_rng *rng, double *start, double *lag)
{
  const gg_heat_layout *l = &d->at;
  double speed = sqrt(overlap(d, start)), before[2][GG_HEAT_FLUXES][GG_HEAT_ORDERS],
         sum[2][GG_HEAT_FLUXES][GG_HEAT_ORDERS] = {{{0}}}, time = 0;
  double at[GG_HEAT_FLUXES][GG_HEAT_ORDERS];
  fluxes(d, rng, speed * speed, start, before[0]);
  memcpy(before[1], before[0], sizeof before[0]);
  for (int k = 0; k < l->steps; k++, lag += l->lag) {
    const double dt = step(d, rng), last = speed;
    speed = sqrt(overlap(d, lag + l->kept));
    const double span = 2 * dt * speed * last / (speed + last);
    lag[l->time] = time += span;
    lag[l->fading] = 1 / speed;
    fluxes(d, rng, speed * speed, lag + l->kept, at);
    for (int j = 0; j < l->fluxes * l->n; j++) {
      const int q = j / l->n, n = j % l->n;
      for (int f = 0; f < 2; f++) {
        const double now = f ? at[q][n] : at[q][n] / speed, slope = (now - before[f][q][n]) / 12;
        sum[f][q][n] += span * ((before[f][q][n] + now) / 2 + (k == 0 ? slope : 0));
        lag[l->flux[f] + j] = sum[f][q][n] - span * slope;
        before[f][q][n] = now;
      }
    }
  }
}

static double temperature_of(const gg_snapshot *s)
{
  double cc = 0;
  for (int a = 0; a < 3; a++)
    for (size_t i = 0; i < s->n; i++) cc += s->c[a][i] * s->c[a][i];
  return cc / (3 * (double)s->n);
}

void gg_measure_heat_copies_follow(gg_heat_copies *d, const gg_snapshot *s, gg_rng *rng, double *row)
{
  copy(d, s, temperature_of(s));
  add_moments(d, row);
  if (!d->model->boltzmann) add_pairs(d, rng, row);
  follow(d, rng, row + d->at.overlap, row + d->at.at_lag);
}
