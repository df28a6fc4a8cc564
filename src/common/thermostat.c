/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/thermostat.h"

#include <math.h>

#include "common/portable_math.h"

const gg_thermostat_row gg_common_thermostats[GG_N_THERMOSTATS] = {
    [GG_NO_THERMOSTAT] = {"none", "no thermostat; the default except in flows that need one", "", GG_UNHEATED},
    [GG_GAUSSIAN] = {"gaussian", "force along the velocity that replaces the energy lost in collisions; spins get none",
                     ", heated", GG_HEAT_SCALES},
    [GG_WHITE_NOISE] = {"white_noise", "random kicks of all grains", ", heated", GG_HEAT_KICKS},
    [GG_BATH] = {"bath", "drag and random kicks, as in a fluid of temperature bath.temperature", ", in a bath",
                 GG_HEAT_BATHES},
    [GG_INJECTION] = {"injection",
                      "no thermostat: kicks at contact or torques give the energy; the default with them in hss", "",
                      GG_UNHEATED},
};

gg_heat gg_common_heat_of(const gg_model *m)
{
  return m->bath.on ? GG_HEAT_BATHES : gg_common_thermostats[gg_flow_thermostat(m->flow, m->thermostat)].heat;
}

/* Mean energy that a collision of Maxwellians destroys: <g_n^2> = 2 <c12_x^2>, <g_t^2> = 2 (<c12_x^2> + <s_x^2>). */
static double loss_per_collision(const gg_model *m, int i, int j)
{
  const int o = gg_pair(i, j);
  const gg_contact *c = &m->contact[i][j];
  double T = m->temperature0, normal = T * (1 - m->e[o] * m->e[o]);
  if (gg_common_rule_select(m->beta[o], m->mu[o]) == GG_SMOOTH) return normal;
  double spread = T * (c->im1 + c->im2) + m->ratio0 * T * (c->ik1 + c->ik2);
  return normal + (1 - m->beta[o] * m->beta[o]) * spread / gg_inverse_mt(c);
}

/* Energy that collisions destroy, per grain and time. */
static double loss_per_grain(const gg_model *m)
{
  double loss = 0;
  for (int i = 0; i < m->n_species; i++)
    for (int j = 0; j < m->n_species; j++) {
      int o = gg_pair(i, j);
      double spread = m->temperature0 * (1 / m->mass[i] + 1 / m->mass[j]);
      double rate = m->sigma[o] * m->sigma[o] * m->chi[o] * sqrt(8 * M_PI * spread) * m->density / 2;
      loss += gg_model_part(m, m->fraction[i], j) * rate * loss_per_collision(m, i, j);
    }
  return loss;
}

double gg_common_thermostat_noise(const gg_model *m)
{
  double mass = 0;
  for (int i = 0; i < m->n_species; i++) mass += gg_model_part(m, m->mass[i], i);
  return loss_per_grain(m) / (1.5 * mass);
}

double gg_common_thermostat_kicks(const gg_model *m)
{
  return gg_common_heat_of(m) == GG_HEAT_KICKS ? gg_common_thermostat_noise(m) : 0;
}

/* Power that kicks and torques give, per grain, at a temperature: rates in terms of their values at T = 1. Only the
 * order of magnitude of the friction of spins is known. */
typedef struct injection {
  double D, torque;            /* largest ones, for the scale of T */
  double rate, steady, speedy; /* collisions per grain, what kicks give in each, and that over sqrt(T) */
  double turning;
} injection;

static injection injection_of(const gg_model *m)
{
  static const double friction = 0.3; /* of a spin, per collision */
  injection in = {.rate = gg_common_model_collision_rate(m, 1)};
  for (int i = 0; i < m->n_species; i++) {
    const double torque = m->torque[i], Km = m->inertia[i] * m->mass[i];
    in.torque = fmax(in.torque, Km * fabs(torque));
    in.turning += m->fraction[i] * Km * torque * torque / (friction * in.rate);
    for (int j = 0; j < m->n_species; j++) {
      const int o = gg_pair(i, j);
      const double mr = 1 / gg_inverse_mr(&m->contact[i][j]);
      const double part = 0.5 * m->fraction[i] * m->fraction[j];
      for (int k = 0; k < GG_N_KICKS; k++) {
        in.D = fmax(in.D, fabs(m->kick[k][o]));
        in.steady += part * 2 * mr * m->kick[k][o] * m->kick[k][o];
      }
      in.speedy += part * 2 * mr * m->kick[GG_NORMAL_KICK][o] * m->e[o] * sqrt(M_PI / (2 * mr));
    }
  }
  return in;
}

/* A power of two near the temperature of the balance, so that bisection scales with the units, bit for bit: that of
 * shear, of kicks, of a torque, of drag against noise, or of heating against the loss. */
static double temperature_near(double sheared, const injection *in, double noise, double drag, double loss)
{
  if (sheared > 0) return ldexp(1, ilogb(sheared));
  if (in->D > 0) return ldexp(1, 2 * ilogb(in->D));
  if (in->torque > 0) return ldexp(1, ilogb(in->torque));
  if (drag > 0 && noise > 0) return ldexp(1, ilogb(noise / drag));
  if (drag < 0 && loss > 0) return ldexp(1, 2 * ilogb(-drag / loss));
  return noise > 0 && loss > 0 ? ldexp(1, (int)floor(ilogb(noise / loss) * 2. / 3)) : 1;
}

/* Per grain and time: what noise brings, what drag takes at T = 1, and the loss at T = 1. Between them the balance
 * falls through zero once: T by bisection, in square roots alone. */
double gg_common_thermostat_balance(const gg_model *m, double sheared)
{
  double noise = 0, drag = 0, loss = loss_per_grain(m) / (m->temperature0 * sqrt(m->temperature0));
  for (int i = 0; i < m->n_species; i++) {
    const double share = m->fraction[i];
    noise += 1.5 * share * m->mass[i] * m->bath.noise[i];
    drag += 3 * share * m->bath.drag[i];
  }
  loss = fmax(loss, 0); /* of an e above 1 at this temperature, by its law: not at all temperatures */
  const injection in = injection_of(m);
  const double near = temperature_near(sheared, &in, noise, drag, loss);
  if (gg_model_is_injected(m) && !(loss > 0) && !(drag > 0)) return near; /* it heats up for ever */
  double low = 1e-100 * near, high = 1e100 * near;
  for (int round = 0; round < 60; round++) {
    const double T = sqrt(low) * sqrt(high), root = sqrt(T);
    const double given = in.rate * root * (in.steady + in.speedy * root) + in.turning / root;
    if (noise + loss * sheared * root + given > (drag + loss * root) * T)
      low = T;
    else
      high = T;
  }
  return sqrt(low) * sqrt(high);
}

/* e^-y, (1 - e^-y)/y, and of the distribution of times u in (0, 1) with weight e^(y u) the mean and variance. For small
 * y their differences are series. */
gg_relaxation gg_common_relaxation(double drag, double dt)
{
  const double y = 2 * drag * dt, decay = gg_exponential(-drag * dt), y2 = y * y;
  gg_relaxation r = {.decay = decay};
  if (fabs(y) < 0.25) {
    double term = 1;
    for (int k = 2; k < 16; k++) r.spread += term, term *= -y / k;
    r.mean = 0.5 + y / 12 * (1 - y2 / 60 * (1 - y2 / 42));
    r.width = (1 - y2 / 20 * (1 - y2 / 25.2 * (1 - y2 / 28.57))) / 12;
  } else {
    const double rest = 1 - decay * decay;
    r.spread = rest / y;
    r.mean = 1 / rest - 1 / y;
    r.width = 1 / y2 - decay * decay / (rest * rest);
  }
  r.spread *= dt, r.mean *= dt, r.width *= dt * dt;
  return r;
}
