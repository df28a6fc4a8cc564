/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rate at which spins escape friction, from the distribution p(ln s) of one grain's spin in units of the cooling
 * gas (m = T = n chi d^2 = 1, s a surface velocity). In these units spins grow at the rate x = zeta/2, and collisions
 * make them jump:
 *   x dp/du = gain(u) - nu(u) p(u) + source(u),   u = ln s,
 * from 0.1 to 100 thermal spins, with grains set out at the thermal spin. The flux at the upper end, over the number of
 * grains below it, is the rate of escape. Partners are Maxwellian, with theta/T and zeta of two Maxwellians.
 *
 * A grain that slides is heated by friction: its own temperature T_f is found from the balance of its energy. Grains
 * that escape are those that few collisions brake, and collisions heat as well: T_f is taken halfway between T and that
 * of the balance. The rate is then 0.8 to 1.5 times that of Monte Carlo up to mu = 0.8, and 0.4 times at e = 0.7,
 * mu = 1 (validation/escape). With all of the heating it is 0.00007 to 1.5 times, without it 1.5 to 110 times that. */
#include "theory/spin_escape.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "common/thermostat.h"
#include "theory/linear_solve.h"
#include "theory/two_maxwellian.h"

enum { POINTS = 4, AZIMUTHS = 8, CONTACTS = POINTS * POINTS * POINTS * AZIMUTHS, NODES = 174, TEMPERATURES = 12 };
#define LOWEST 0.1 /* of the grid of spins, in thermal spins; the next node is STEP further in ln s */
#define STEP 0.04

/* Contact of the grain at unit variances: g_n over its spread, tangential velocity along the slip of the grain's own
 * spin and across, sine of the angle between spin and k, weight. */
typedef struct contact {
  double normal, along, across, sine, weight;
} contact;

typedef struct gas {
  gg_grain grain;
  double mu, theta, growth; /* growth: x */
  contact contact[CONTACTS];
} gas;

/* Gauss's rule: Laguerre's weight exp(-x) on (0, inf), or Legendre's on (0, 1). */
static bool rule(const gsl_integration_fixed_type *type, double nodes[POINTS], double weights[POINTS])
{
  gsl_integration_fixed_workspace *w = gsl_integration_fixed_alloc(type, POINTS, 0, 1, 0, 0);
  for (int i = 0; w && i < POINTS; i++) {
    nodes[i] = gsl_integration_fixed_nodes(w)[i];
    weights[i] = gsl_integration_fixed_weights(w)[i];
  }
  if (w) gsl_integration_fixed_free(w);
  return w != NULL;
}

/* Contacts weighted by g_n, k uniform over the sphere. */
static bool make_contacts(contact *next)
{
  double x[POINTS], wx[POINTS], c[POINTS], wc[POINTS];
  if (!rule(gsl_integration_fixed_laguerre, x, wx) || !rule(gsl_integration_fixed_legendre, c, wc)) return false;
  for (int n = 0; n < POINTS; n++)
    for (int t = 0; t < POINTS; t++)
      for (int k = 0; k < POINTS; k++)
        for (int a = 0; a < AZIMUTHS; a++) {
          const double speed = sqrt(2 * x[t]), azimuth = (a + 0.5) * M_PI / AZIMUTHS;
          *next++ = (contact){sqrt(2 * x[n]), speed * cos(azimuth), speed * sin(azimuth), sqrt(1 - c[k] * c[k]),
                              wx[n] * wx[t] * wc[k] / AZIMUTHS};
        }
  return true;
}

/* Collision rate of a grain at temperature `own`. */
static double rate_at(double own)
{
  return 4 * M_PI * sqrt((1 + own) / (2 * M_PI));
}

typedef struct kick {
  double spin, energy; /* s after the contact; mean change of C^2 of the grain */
} kick;

/* Contact of a grain of spin s. The mean of its velocity C at a given relative velocity c is own/(1 + own) c. */
static kick kick_of(const gas *g, double s, double own, const contact *c)
{
  const double K = g->grain.K, V = 1 + own, Vt = V + g->theta / K, normal = sqrt(V) * c->normal;
  const double a = sqrt(Vt) * c->along, b = sqrt(Vt) * c->across, along = a + s * c->sine, gt = hypot(along, b);
  const double slide = g->mu * g->grain.eta1 * normal, j = g->grain.eta2 * gt < slide ? g->grain.eta2 : slide / gt;
  const double Jn = g->grain.eta1 * normal, Jt = j * gt, turned = Jt / K;
  const double work = Jn * normal + V / Vt * j * (a * along + b * b);
  const double left = s * s - 2 * s * c->sine * j * along / K + turned * turned;
  return (kick){sqrt(fmax(left, 0)), Jn * Jn + Jt * Jt - 2 * own / V * work};
}

typedef struct balance {
  const gas *gas;
  double s;
} balance;

/* Growth of the grain's own temperature. */
static double heating(double own, void *context)
{
  const balance *b = context;
  double change = 0;
  for (int i = 0; i < CONTACTS; i++)
    change += b->gas->contact[i].weight * kick_of(b->gas, b->s, own, &b->gas->contact[i]).energy;
  return 2 * b->gas->growth * own + rate_at(own) * change / 3;
}

static double node(const gas *g, double i)
{
  return LOWEST * sqrt(g->theta / g->grain.K) * exp(STEP * i);
}

/* Temperature of the grain over the nodes: halfway to the balance, at some of them, linear between. */
static void own_temperatures(const gas *g, double own[NODES])
{
  double at[TEMPERATURES];
  const double apart = (NODES - 1.0) / (TEMPERATURES - 1);
  for (int k = 0; k < TEMPERATURES; k++) {
    balance b = {g, node(g, k * apart)};
    double high = 2;
    while (heating(high, &b) > 0 && high < 1e6) high *= 2;
    at[k] = (1 + gg_theory_root_between(heating, &b, 1e-3, high)) / 2;
  }
  for (int i = 0; i < NODES; i++) {
    const int k = i == NODES - 1 ? TEMPERATURES - 2 : (int)(i / apart);
    own[i] = at[k] + (i / apart - k) * (at[k + 1] - at[k]);
  }
}

/* Column j of the collision operator C, by rows: gain at node i from a grain at node j, less its loss. */
static void put_collisions(const gas *g, int j, double own, double *C)
{
  const double rate = rate_at(own), lowest = node(g, 0);
  for (int k = 0; k < CONTACTS; k++) {
    const double s = kick_of(g, node(g, j), own, &g->contact[k]).spin;
    const double at = fmin(s > lowest ? log(s / lowest) / STEP : 0, NODES - 1.001), part = at - floor(at);
    const size_t i = (size_t)at;
    C[i * NODES + (size_t)j] += rate * g->contact[k].weight * (1 - part);
    C[(i + 1) * NODES + (size_t)j] += rate * g->contact[k].weight * part;
  }
  C[j * NODES + j] -= rate;
}

/* Maxwellian in s at theta, per ln s. */
static double source(int i)
{
  const double s = LOWEST * exp(STEP * i);
  return s * s * s * exp(-s * s / 2);
}

/* M p = right, the trapezoidal rule between neighbouring nodes; nothing enters at the lowest. */
static void put_equations(const gas *g, const double *C, double *M)
{
  double *right = M + NODES * NODES;
  for (int j = 0; j < NODES; j++) M[j] = j == 0;
  right[0] = 0;
  for (int i = 1; i < NODES; i++) {
    double *row = M + i * NODES;
    for (int j = 0; j < NODES; j++) row[j] = -0.5 * STEP * (C[(i - 1) * NODES + j] + C[i * NODES + j]);
    row[i] += g->growth, row[i - 1] -= g->growth;
    right[i] = 0.5 * STEP * (source(i - 1) + source(i));
  }
}

static double escapes_of(const gas *g)
{
  double own[NODES], number = 0, rate = NAN;
  double *C = calloc(NODES * NODES, sizeof *C), *M = gg_theory_linear_new(NODES);
  if (!C || !M) gg_base_memory_lacked();
  own_temperatures(g, own);
  for (int j = 0; C && j < NODES; j++) put_collisions(g, j, own[j], C);
  if (C && M) put_equations(g, C, M);
  if (C && M && gg_theory_linear_solve(NODES, M)) {
    const double *p = M + NODES * NODES;
    for (int i = 0; i < NODES; i++) number += p[i] * STEP;
    const double found = g->growth * p[NODES - 1] / number / rate_at(1);
    rate = found < 0 ? 0 : found; /* a rate that is not a number stays so */
  }
  free(C), free(M);
  return rate;
}

bool gg_theory_is_metastable(const gg_model *m)
{
  const bool cools = gg_flow_cools(m->flow) || (m->linear_response && gg_common_heat_of(m) == GG_UNHEATED);
  return cools && m->rule == GG_FRICTIONAL;
}

double gg_theory_spin_escape(const gg_model *m)
{
  if (!gg_theory_is_metastable(m) || m->n_species > 1 || m->law.name || gg_model_is_injected(m)) return NAN;
  gas *g = calloc(1, sizeof *g);
  double rate = NAN;
  gg_base_gsl_enter();
  if (!g) gg_base_memory_lacked();
  if (g && make_contacts(g->contact)) {
    g->grain = gg_theory_grain_of(m), g->mu = m->mu[0];
    g->theta = gg_theory_ratio_cooling(g->grain, g->mu);
    g->growth = rate_at(1) / 6 * gg_theory_cooling_at(g->grain, g->mu, g->theta);
    if (isfinite(g->theta)) rate = escapes_of(g);
  }
  free(g);
  gg_base_gsl_leave();
  return rate;
}

gg_status gg_theory_require_lasting(const gg_model *m, const char *theory, gg_error *err)
{
  const double rate = gg_theory_is_metastable(m) ? gg_theory_spin_escape(m) : 0;
  if (!(rate > GG_MOST_ESCAPES)) return GG_OK;
  return gg_theory_reject(err, theory,
                          "describes steady states; this gas has none: grains that spin fast escape friction, a "
                          "fraction of %.1g per collision a grain, and theta/T then grows without end",
                          rate);
}

const char *gg_theory_beyond_metastable(const gg_model *m)
{
  return gg_theory_is_metastable(m)
             ? "a metastable state: grains that spin fast escape friction one by one, and theta/T "
               "then grows without end"
             : NULL;
}
