/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fluxes across the gap between walls: stress, heat, spin; and the balance of energy, slab by slab.
 *
 * Kinetic part: sums over all samples of the window, about a straight line of velocity and one of spin in each slab,
 * as in profiles.c. Collisional part: transfer along the line between both centres (Irving & Kirkwood, J. Chem.
 * Phys. 18 (1950) 817; Todd, Evans & Daivis, Phys. Rev. E 52 (1995) 1627): each slab gets the fraction of the line
 * that lies in it. The transfer from grain 1 to 2 is the impulse J, half of the energy gained by 2 minus that gained
 * by 1, and the same of the spin's angular momentum about z. Their heights differ by sigma k_y, in Monte Carlo by
 * the distance of its cells. The energy that both lose is located at the centres, half at each. A wall is a partner
 * at its place: between it and the centre of a grain that touches, fluxes are those through the wall.
 *
 * This conserves momentum and energy exactly at every height. With F the flux of energy along y, in the
 * laboratory,
 *   dF/dy = rho g.u + the power of torques - loss,
 * and means over two slabs differ by the integral of the right-hand side, weighted by a hat: 1 at the face between
 * them, 0 at their far ends. Each slab keeps the sources with that weight, so the remainder is noise and the change
 * of the energy in time, at any thickness of slabs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/surface/surface.h"
#include "measure/gap_slabs.h"
#include "measure/observable.h"

/* Sums over grains with the weight q of a field w, velocity (q = m) or omega (q = I); h: height above the middle of the
 * slab, in its thickness; v: velocity along y. */
typedef struct carried {
  double h[4];     /* q h^p */
  double w[3][3];  /* q h^p w_b */
  double v[3];     /* q h^p v */
  double wv[2][3]; /* q h^p w_b v */
  double ww[2];    /* q h^p w^2 */
  double wwv, xx;  /* q w^2 v, q w_x^2 */
} carried;

/* Sums over collisions, with the part of the line that lies in the slab: momentum, translational and rotational
 * energy, angular momentum; and at the centres, the loss. Along y with h^p, p = 0 and 1. */
typedef struct passed {
  double xx, zz, xy, momentum[2][3], energy[2], spin[2], loss[2];
} passed;

typedef struct slab {
  carried flow, spin;
  passed by;
  double power[2]; /* of torques, with h^p */
} slab;

/* Stored after the slabs: the time of their collisions; and that of the heat of the walls, which the sums of an
 * interval have. */
typedef struct walls {
  double time, interval, heat[GG_MOST_SURFACES];
} walls;

enum { DOUBLES = sizeof(slab) / sizeof(double), WALLS = sizeof(walls) / sizeof(double) };
#define NEVER (-1.0)

typedef struct fluxes {
  const gg_model *model;
  int slabs;
  struct {         /* since the last snapshot */
    double begins; /* the engine's time of that; NEVER */
    walls walls;
    passed by[GG_MOST_GAP_SLABS];
  } since;
} fluxes;

static const char *refuses(const gg_model *m)
{
  return gg_flow_is_walled(m->flow) ? NULL : "fluxes across a gap are of flows between walls";
}

static void restart(void *self)
{
  fluxes *d = self;
  memset(&d->since, 0, sizeof d->since);
  d->since.begins = NEVER;
}

static void *create(const gg_model *m, gg_error *err)
{
  fluxes *d = gg_base_array_new(1, sizeof *d, err);
  if (d) *d = (fluxes){.model = m, .slabs = gg_measure_gap_slabs(m), .since.begins = NEVER};
  return d;
}

static size_t bins(const void *self)
{
  return (size_t)((const fluxes *)self)->slabs * DOUBLES + WALLS;
}

static void *memory(void *self, size_t *bytes)
{
  fluxes *d = self;
  *bytes = sizeof d->since;
  return &d->since;
}

static void add_interval(void *self, const gg_interval *in)
{
  fluxes *d = self;
  d->since.walls.interval += in->elapsed;
  for (int w = 0; w < d->model->n_surfaces; w++) d->since.walls.heat[w] += in->transfer->surface[w].loss;
}

/* Transfer along the line from 1 to 2; spin: angular momentum about z. */
typedef struct transfer {
  gg_vec line, J;
  double energy[2], spin;
} transfer;

/* Add the fraction `share` of the line, about the height h of the slab. */
static void add_passed(passed *p, double share, double h, const transfer *t)
{
  const double x = share * t->line.x, y = share * t->line.y, J[3] = {t->J.x, t->J.y, t->J.z};
  p->xx += x * J[0], p->xy += x * J[1], p->zz += share * t->line.z * J[2];
  for (int b = 0; b < 3; b++) p->momentum[0][b] += y * J[b], p->momentum[1][b] += y * h * J[b];
  for (int k = 0; k < 2; k++) p->energy[k] += y * t->energy[k];
  p->spin[0] += y * t->spin, p->spin[1] += y * h * t->spin;
}

/* Distribute the transfer over the slabs from height to height, in units of slabs. */
static void spread(fluxes *d, double from, double to, const transfer *t)
{
  const double low = fmin(from, to), high = fmax(from, to), length = high - low;
  const int last = (int)fmin(floor(high), d->slabs - 1);
  for (int i = (int)fmax(floor(low), 0); i <= last; i++) {
    const double a = fmax(low, i), b = fmin(high, i + 1);
    add_passed(&d->since.by[i], length > 0 ? (b - a) / length : 1, 0.5 * (a + b) - i - 0.5, t);
  }
}

static void lose(fluxes *d, double at, double energy)
{
  const int i = (int)floor(at);
  if (i < 0 || i >= d->slabs) return;
  d->since.by[i].loss[0] += energy, d->since.by[i].loss[1] += energy * (at - i - 0.5);
}

/* Gains of a grain: translational and rotational energy, angular momentum. */
typedef struct gain {
  double energy[2], spin;
} gain;

static gain gain_of(const gg_model *m, const gg_collision_record *c, int which)
{
  const int k = c->species[which];
  const gg_vec J = gg_scale(which ? 1 : -1, c->J), turn = c->turn[which];
  const double inertia = m->inertia[k] * m->mass[k];
  return (gain){{gg_dot(J, c->c[which]) + 0.5 * gg_dot(J, J) / m->mass[k],
                 inertia * (gg_dot(turn, c->s[which]) + 0.5 * gg_dot(turn, turn))},
                0.5 * inertia * m->diameter[k] * turn.z};
}

static void add_contact(fluxes *d, const gg_collision_record *c, double from, double to)
{
  const gain one = gain_of(d->model, c, 0);
  const double radius = 0.5 * d->model->diameter[c->species[0]];
  transfer t = {
      {radius * c->k.x, c->height[1] - c->height[0], radius * c->k.z}, c->J, {-one.energy[0], -one.energy[1]}, 0};
  spread(d, from, to, &t);
}

static void add_collision(void *self, const gg_collision_record *c)
{
  fluxes *d = self;
  const double per_slab = d->slabs / d->model->box[1], middle = 0.5 * d->slabs;
  const double from = c->height[0] * per_slab + middle, to = c->height[1] * per_slab + middle;
  if (c->wall) {
    add_contact(d, c, from, to);
    return;
  }
  const gain one = gain_of(d->model, c, 0), two = gain_of(d->model, c, 1);
  const double sigma = d->model->boltzmann ? 0 : d->model->sigma[gg_pair(c->species[0], c->species[1])];
  transfer t = {
      {sigma * c->k.x, c->height[1] - c->height[0], sigma * c->k.z}, c->J, {0, 0}, 0.5 * (two.spin - one.spin)};
  double lost = 0;
  for (int k = 0; k < 2; k++) {
    t.energy[k] = 0.5 * (two.energy[k] - one.energy[k]);
    lost -= one.energy[k] + two.energy[k];
  }
  spread(d, from, to, &t);
  if (!gg_common_pair_loses(d->model, c->species[0], c->species[1])) return; /* rounding alone */
  lose(d, from, 0.5 * lost);
  lose(d, to, 0.5 * lost);
}

static void add_carried(carried *c, double q, double h, const double w[3], double v)
{
  const double power[4] = {q, q * h, q * h * h, q * h * h * h}, ww = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  c->h[3] += power[3], c->wwv += q * ww * v, c->xx += q * w[0] * w[0];
  for (int p = 0; p < 3; p++) {
    c->h[p] += power[p], c->v[p] += power[p] * v;
    for (int b = 0; b < 3; b++) c->w[p][b] += power[p] * w[b];
  }
  for (int p = 0; p < 2; p++) {
    c->ww[p] += power[p] * ww;
    for (int b = 0; b < 3; b++) c->wv[p][b] += power[p] * w[b] * v;
  }
}

static void add_sums(double *to, const void *from, size_t n)
{
  for (size_t k = 0; k < n; k++) to[k] += ((const double *)from)[k];
}

/* Add the collisions since the last snapshot. Before the first one of a window their time is unknown. */
static void add_collisions(fluxes *d, double now, slab *slabs)
{
  if (d->since.begins >= 0) {
    d->since.walls.time = now - d->since.begins;
    for (int i = 0; i < d->slabs; i++)
      add_sums((double *)&slabs[i].by, &d->since.by[i], sizeof(passed) / sizeof(double));
    add_sums((double *)&slabs[d->slabs], &d->since.walls, WALLS);
  }
  restart(d);
  d->since.begins = now;
}

static void add_snapshot(void *self, const gg_snapshot *s, double *bin)
{
  fluxes *d = self;
  const gg_model *m = d->model;
  slab *slabs = (slab *)(void *)bin;
  add_collisions(d, s->time, slabs);
  for (size_t g = 0; g < s->n; g++) {
    const double y = s->r[1][g] / m->box[1] * d->slabs, v[3] = {s->c[0][g], s->c[1][g], s->c[2][g]};
    const int i = (int)floor(y), k = gg_snapshot_species(s, g);
    if (i < 0 || i >= d->slabs) continue; /* above an open top */
    add_carried(&slabs[i].flow, m->mass[k], y - i - 0.5, v, v[1]);
    if (!s->s[0]) continue;
    const double omega[3] = {gg_snapshot_omega(s, 0, g), gg_snapshot_omega(s, 1, g), gg_snapshot_omega(s, 2, g)};
    add_carried(&slabs[i].spin, gg_moment_of_inertia(m, k), y - i - 0.5, omega, v[1]);
    const double power = m->torque[k] / gg_model_radius(m, k) * gg_moment_of_inertia(m, k) * omega[2];
    slabs[i].power[0] += power, slabs[i].power[1] += power * (y - i - 0.5);
  }
}

/* at + slope h, of each component. */
typedef struct line {
  double at[3], slope[3];
} line;

static line line_of(const carried *c)
{
  line l;
  const double centre = c->h[1] / c->h[0], width = c->h[2] - centre * c->h[1];
  for (int b = 0; b < 3; b++) {
    l.slope[b] = (c->w[1][b] - centre * c->w[0][b]) / width;
    l.at[b] = c->w[0][b] / c->h[0] - l.slope[b] * centre;
  }
  return l;
}

/* Next to a wall centres may occupy a small part of a slab: if that is less than half, the variance is below
 * half^2/12. */
static bool is_filled(const carried *c)
{
  return c->h[0] > 0 && c->h[2] - c->h[1] * c->h[1] / c->h[0] > c->h[0] / 48;
}

/* The line of the nearest filled slab, extrapolated. */
static line line_at(const fluxes *d, const slab *slabs, int i, bool spin)
{
  for (int far = 0; far < d->slabs; far++)
    for (int sign = -1; sign <= 1; sign += 2) {
      const int k = i + sign * far;
      if (k < 0 || k >= d->slabs || !is_filled(&slabs[k].flow)) continue;
      line l = line_of(spin ? &slabs[k].spin : &slabs[k].flow);
      for (int b = 0; b < 3; b++) l.at[b] += l.slope[b] * (i - k);
      return l;
    }
  return (line){{NAN, NAN, NAN}, {NAN, NAN, NAN}};
}

/* sum q (w_b - W_b)(v - U), U of component y. */
static double carried_along_y(const carried *c, const line *W, const line *U, int b)
{
  const double at = W->at[b], slope = W->slope[b], u = U->at[1], du = U->slope[1];
  return c->wv[0][b] - at * c->v[0] - slope * c->v[1] - u * c->w[0][b] - du * c->w[1][b] + at * u * c->h[0] +
         (at * du + slope * u) * c->h[1] + slope * du * c->h[2];
}

/* sum q (w_b - W_b)^2, of `raw` = sum q w_b^2. */
static double square_about(const carried *c, const line *W, int b, double raw)
{
  const double at = W->at[b], slope = W->slope[b];
  return raw - 2 * (at * c->w[0][b] + slope * c->w[1][b]) + at * at * c->h[0] + 2 * at * slope * c->h[1] +
         slope * slope * c->h[2];
}

/* sum q (w - W)^2 (v - U)/2 */
static double heat_carried(const carried *c, const line *W, const line *U)
{
  const double u = U->at[1], du = U->slope[1];
  double sum = c->wwv - u * c->ww[0] - du * c->ww[1];
  for (int b = 0; b < 3; b++) {
    const double at = W->at[b], slope = W->slope[b];
    sum -= 2 * (at * (c->wv[0][b] - u * c->w[0][b] - du * c->w[1][b]) +
                slope * (c->wv[1][b] - u * c->w[1][b] - du * c->w[2][b]));
    sum += at * at * (c->v[0] - u * c->h[0] - du * c->h[1]) + 2 * at * slope * (c->v[1] - u * c->h[1] - du * c->h[2]) +
           slope * slope * (c->v[2] - u * c->h[2] - du * c->h[3]);
  }
  return 0.5 * sum;
}

/* Profiles of the slabs, in the order of the table; then those of the faces between them. */
enum { KINETIC, COLLISIONAL, TOTAL, PARTS };
enum { XX, YY, ZZ, XY, YX, HEAT, ROTATIONAL, COUPLE, KINDS };
enum { DIVERGENCE, WORK, LOSS, RESIDUAL, TERMS };
typedef struct profile {
  double of[KINDS][PARTS];
  double energy; /* flux in the laboratory */
} profile;

static profile profile_of(const fluxes *d, const slab *slabs, int i)
{
  const slab *at = &slabs[i];
  const passed *by = &at->by;
  const double volume = d->model->volume / d->slabs, time = ((const walls *)(const void *)&slabs[d->slabs])->time;
  const double each = d->model->stress_unit / volume, rate = each / time;
  const line U = line_at(d, slabs, i, false), W = line_at(d, slabs, i, true);
  const bool spins = d->model->rule != GG_SMOOTH;
  profile p = {{{0}}, 0};
  double(*of)[PARTS] = p.of;
  of[XX][KINETIC] = square_about(&at->flow, &U, 0, at->flow.xx);
  of[YY][KINETIC] = carried_along_y(&at->flow, &U, &U, 1);
  of[ZZ][KINETIC] = square_about(&at->flow, &U, 2, at->flow.ww[0] - at->flow.xx - at->flow.wv[0][1]);
  of[XY][KINETIC] = of[YX][KINETIC] = carried_along_y(&at->flow, &U, &U, 0);
  of[HEAT][KINETIC] = heat_carried(&at->flow, &U, &U);
  of[XX][COLLISIONAL] = by->xx, of[YY][COLLISIONAL] = by->momentum[0][1], of[ZZ][COLLISIONAL] = by->zz;
  of[XY][COLLISIONAL] = by->xy, of[YX][COLLISIONAL] = by->momentum[0][0];
  of[HEAT][COLLISIONAL] = by->energy[0];
  for (int b = 0; b < 3; b++) of[HEAT][COLLISIONAL] -= U.at[b] * by->momentum[0][b] + U.slope[b] * by->momentum[1][b];
  if (spins) {
    of[ROTATIONAL][KINETIC] = heat_carried(&at->spin, &W, &U);
    of[ROTATIONAL][COLLISIONAL] = by->energy[1] - W.at[2] * by->spin[0] - W.slope[2] * by->spin[1];
    of[COUPLE][KINETIC] = carried_along_y(&at->spin, &W, &U, 2);
    of[COUPLE][COLLISIONAL] = by->spin[0];
  }
  for (int k = 0; k < KINDS; k++) {
    of[k][KINETIC] *= each, of[k][COLLISIONAL] *= rate;
    of[k][TOTAL] = of[k][KINETIC] + of[k][COLLISIONAL];
  }
  p.energy = each * 0.5 * (at->flow.wwv + at->spin.wwv) + rate * (by->energy[0] + by->energy[1]);
  return p;
}

/* Sources of a slab, weighted with the part of the hat that is 1 at its upper or lower face: power of gravity and
 * torques, loss. */
static void add_sources(const fluxes *d, const slab *slabs, int i, bool upper, double *power, double *loss)
{
  const slab *at = &slabs[i];
  const double volume = d->model->volume / d->slabs, time = ((const walls *)(const void *)&slabs[d->slabs])->time;
  const double unit = d->model->stress_unit / volume, sign = upper ? 1 : -1;
  for (int b = 0; b < 3; b++)
    *power += unit * d->model->gravity[b] * (0.5 * at->flow.w[0][b] + sign * at->flow.w[1][b]);
  *power += unit * (0.5 * at->power[0] + sign * at->power[1]);
  *loss += unit / time * (0.5 * at->by.loss[0] + sign * at->by.loss[1]);
}

/* Terms at the face above slab i: dq/dy, the work of the stress on the shear, the loss by collisions, and the
 * remainder dq/dy - work + loss. */
static void terms_of(const fluxes *d, const slab *slabs, const profile *p, int i, double term[TERMS])
{
  const double height = d->model->box[1] / d->slabs;
  double power = 0, loss = 0, heat[2];
  for (int k = 0; k < 2; k++) {
    add_sources(d, slabs, i + k, k == 0, &power, &loss);
    heat[k] = p[i + k].of[HEAT][TOTAL] + p[i + k].of[ROTATIONAL][TOTAL];
  }
  term[DIVERGENCE] = (heat[1] - heat[0]) / height;
  term[WORK] = power - (p[i + 1].energy - heat[1] - p[i].energy + heat[0]) / height;
  term[LOSS] = loss;
  term[RESIDUAL] = term[DIVERGENCE] - term[WORK] + term[LOSS];
}

static const struct {
  const char *name, *label; /* profile_<name>, profile_<name>_kinetic, ... */
  gg_quantity like;         /* quantity with the same unit; for couple stress times a length */
  int axis[2];              /* components whose sign the image changes; -1: none */
  bool axial, spins;        /* the second component is axial, is one of spins */
} kinds[KINDS] = {
    [XX] = {"P_xx", "P_{xx}", GG_Q_PRESSURE, {0, 0}, false, false},
    [YY] = {"P_yy", "P_{yy}", GG_Q_PRESSURE, {1, 1}, false, false},
    [ZZ] = {"P_zz", "P_{zz}", GG_Q_PRESSURE, {2, 2}, false, false},
    [XY] = {"P_xy", "P_{xy}", GG_Q_PRESSURE, {0, 1}, false, false},
    [YX] = {"P_yx", "P_{yx}", GG_Q_PRESSURE, {1, 0}, false, false},
    [HEAT] = {"q_y", "q_y", GG_Q_WALL_HEAT_FLUX, {1, -1}, false, false},
    [ROTATIONAL] = {"q_y_rotational", "q_y^r", GG_Q_WALL_HEAT_FLUX, {1, -1}, false, true},
    [COUPLE] = {"M_yz", "M_{yz}", GG_Q_PRESSURE, {1, 2}, true, true},
};
static const struct {
  const char *name, *label;
} terms[TERMS] = {
    [DIVERGENCE] = {"profile_heat_divergence", "dq_y/dy"},
    [WORK] = {"profile_stress_work", "-P_{ya} du_a/dy"},
    [LOSS] = {"profile_loss", "Γ"},
    [RESIDUAL] = {"profile_energy_residual", "residual"},
};

static double image_of(const gg_model *m, int kind)
{
  const gg_wall_symmetry symmetry = gg_wall_symmetry_of(m);
  double sign = gg_wall_image(symmetry, false, kinds[kind].axis[0]);
  if (kinds[kind].axis[1] >= 0) sign *= gg_wall_image(symmetry, kinds[kind].axial, kinds[kind].axis[1]);
  return sign;
}

/* The mean of a profile and its image. */
static void fold(const gg_model *m, double *value, size_t n, double sign)
{
  if (gg_wall_symmetry_of(m) == GG_NO_SYMMETRY) return;
  for (size_t i = 0; i <= (n - 1) / 2; i++) {
    const double mean = 0.5 * (value[i] + sign * value[n - 1 - i]);
    value[i] = mean, value[n - 1 - i] = sign * mean;
  }
}

static gg_curve *new_curve(const fluxes *d, gg_curves *list, size_t n, const char *name, const char *panel,
                           const char *label, const char *unit)
{
  gg_curve *c = gg_measure_curve_add(list, n, name, panel, label);
  gg_measure_curve_axes(c, "y", gg_measure_curve_unit(d->model, "length"), panel, unit);
  c->folded = gg_wall_symmetry_of(d->model) != GG_NO_SYMMETRY;
  return c;
}

/* Heat through a wall, upwards. */
static void put_walls(const fluxes *d, const walls *sums, gg_curve *c)
{
  const gg_model *m = d->model;
  double heat[GG_MOST_SURFACES];
  for (int w = 0; w < m->n_surfaces; w++) heat[w] = m->surface[w].side * sums->heat[w];
  for (int w = 0; w < m->n_surfaces; w++) {
    const int image = gg_wall_symmetry_of(m) != GG_NO_SYMMETRY ? gg_surface_image(m, w) : -1;
    const double mean = image < 0 ? heat[w] : 0.5 * (heat[w] - heat[image]);
    char name[40];
    snprintf(name, sizeof name, "wall_q_y_%s", m->surface[w].word);
    gg_measure_curve_put_number(c, name, mean * m->stress_unit * m->box[1] / (m->volume * sums->interval),
                                gg_common_quantity_unit(GG_Q_WALL_HEAT_FLUX, m));
  }
}

static void put_kind(const fluxes *d, const profile *p, int kind, int part, const walls *sums, gg_curves *list)
{
  static const char *const suffix[PARTS] = {"_kinetic", "_collisional", ""}, *const mark[PARTS] = {", k", ", c", ""};
  const gg_model *m = d->model;
  char name[48], label[24], unit[40];
  snprintf(name, sizeof name, "profile_%s%s", kinds[kind].name, suffix[part]);
  snprintf(label, sizeof label, "%s%s", kinds[kind].label, mark[part]);
  snprintf(unit, sizeof unit, "%s%s%s", gg_common_quantity_unit(kinds[kind].like, m), kind == COUPLE ? " " : "",
           kind == COUPLE ? gg_measure_curve_unit(m, "length") : "");
  gg_curve *c = new_curve(d, list, (size_t)d->slabs, name, kinds[kind].label, label, unit);
  for (size_t i = 0; i < c->n; i++) {
    c->x[i] = ((double)i + 0.5) * m->box[1] / d->slabs;
    c->value[i] = p[i].of[kind][part];
  }
  fold(m, c->value, c->n, image_of(m, kind));
  if (kind == HEAT && part == TOTAL && sums->interval > 0) put_walls(d, sums, c);
}

static void put_terms(const fluxes *d, const slab *slabs, const profile *p, gg_curves *list)
{
  for (int t = 0; t < TERMS; t++) {
    gg_curve *c = new_curve(d, list, (size_t)d->slabs - 1, terms[t].name, "balance of energy", terms[t].label,
                            gg_common_quantity_unit(GG_Q_DISSIPATION, d->model));
    for (size_t i = 0; i < c->n; i++) {
      double term[TERMS];
      terms_of(d, slabs, p, (int)i, term);
      c->x[i] = ((double)i + 1) * d->model->box[1] / d->slabs;
      c->value[i] = term[t];
    }
    fold(d->model, c->value, c->n, 1);
  }
}

static void curves(const void *self, const double *mean, gg_curves *list)
{
  const fluxes *d = self;
  const slab *slabs = (const slab *)(const void *)mean;
  profile p[GG_MOST_GAP_SLABS];
  for (int i = 0; i < d->slabs; i++) p[i] = profile_of(d, slabs, i);
  for (int kind = 0; kind < KINDS; kind++)
    for (int part = PARTS - 1; part >= 0 && (!kinds[kind].spins || d->model->rule != GG_SMOOTH); part--)
      put_kind(d, p, kind, part, (const walls *)(const void *)&slabs[d->slabs], list);
  put_terms(d, slabs, p, list);
}

const gg_observable gg_measure_fluxes = {
    GG_OBSERVABLE(FLUXES, fluxes),
    .create = create,
    .destroy = free,
    .refuses = refuses,
    .memory = memory,
    .positions = true,
    .restart = restart,
    .curves =
        &(const gg_observable_curves){
            .bins = bins, .every = 1, .add_snapshot = add_snapshot, .add_interval = add_interval, .of_bins = curves},
    .collisions = &(const gg_observable_collisions){.add = add_collision, .of_walls_too = true},
    .cost = {.ns = {95, 55}},
};
