/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/text_format.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "common/thermostat.h"
#include "graingas.h"
#include "scene/fields.h"

/* With `decimals` after the point; the error in units of the last digit where it has no point in it. */
static void put_estimate(double mean, double error, int decimals, char *text, size_t size)
{
  if (decimals <= 0)
    snprintf(text, size, "%.0f(%.0f)", mean, error);
  else if (error >= 1)
    snprintf(text, size, "%.*f(%.*f)", decimals, mean, decimals, error);
  else
    snprintf(text, size, "%.*f(%.0f)", decimals, mean, error * pow(10, decimals));
}

void gg_format_estimate(double mean, double error, char *text, size_t size)
{
  if (!text || !size) return;
  if (isnan(mean)) {
    snprintf(text, size, "-");
    return;
  }
  if (!isfinite(error)) {
    snprintf(text, size, "%.3g(?)", mean);
    return;
  }
  if (error < 1e-9 * fabs(mean) || !(error > 0)) { /* conserved: all its error is rounding */
    snprintf(text, size, "%.6g", mean);
    return;
  }
  double largest = fmax(fabs(mean), error);
  int exponent = (int)floor(log10(largest));
  bool scientific = exponent < -3 || exponent > 5;
  double scale = scientific ? pow(10, exponent) : 1;
  double e = error / scale;
  int decimals = 1 - (int)floor(log10(e));
  if (e * pow(10, decimals) >= 99.5) decimals--; /* 0.0996 is 0.10 */
  put_estimate(mean / scale, e, decimals, text, size);
  size_t used = strlen(text);
  if (scientific && used < size) snprintf(text + used, size - used, "e%+03d", exponent);
}

static void add_pairs(char *text, size_t size, const gg_scene *s, const char *name, gg_contact_coefficient of,
                      const double *x)
{
  const int n_species = s->n_species;
  double least = x[GG_11], most = x[GG_11];
  for (int p = 0; p < gg_pairs_of(n_species); p++) least = fmin(least, x[p]), most = fmax(most, x[p]);
  if (gg_common_speed_laws_have(&s->collision.by_speed, of, gg_pairs_of(n_species)))
    gg_base_text_append(text, size, ", %s(v)", name);
  else if (least == most)
    gg_base_text_append(text, size, ", %s %g", name, least);
  else if (n_species == 2)
    gg_base_text_append(text, size, ", %s %g/%g/%g", name, x[GG_11], x[GG_12], x[GG_22]);
  else
    gg_base_text_append(text, size, ", %s %g to %g", name, least, most);
}

/* True if a key, or a member of it ("collision.e.12"), is in a list with commas. */
static bool has(const char *list, const char *key)
{
  const size_t length = strlen(key);
  for (const char *at = list; at && (at = strstr(at, key)); at++)
    if ((at == list || at[-1] == ',') && strchr(",.", at[length])) return true;
  return false;
}

static void add_law(const gg_scene *s, const char *varied, char *text, size_t size)
{
  const gg_restitution_law law = gg_common_extension_law(s->extension);
  if (law.e)
    gg_base_text_append(text, size, ", law %s of e", law.name);
  else if (!has(varied, "collision.e"))
    add_pairs(text, size, s, "e", GG_OF_E, s->collision.e);
  if (!law.e && s->collision.law != GG_LAW_CONSTANT)
    gg_base_text_append(text, size, " (%s)", gg_common_law_name(s->collision.law));
}

static void add_surface(const gg_scene *s, const char *varied, char *text, size_t size)
{
  const bool any_beta = has(varied, "collision.beta"), any_mu = has(varied, "collision.mu");
  bool smooth = !any_beta, frictional = any_mu;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) {
    smooth &= gg_scene_pair_rule(s, p) == GG_SMOOTH && (s->collision.beta[p] == -1 || !any_mu);
    frictional |= isfinite(s->collision.mu[p]) || s->collision.by_speed.at[GG_OF_MU][p];
  }
  if (smooth) gg_base_text_append(text, size, ", smooth");
  if (!smooth && !any_beta) add_pairs(text, size, s, frictional ? "beta_0" : "beta", GG_OF_BETA, s->collision.beta);
  if (!smooth && frictional && !any_mu) add_pairs(text, size, s, "mu", GG_OF_MU, s->collision.mu);
}

void gg_files_scene_title(const gg_scene *s, const char *varied, char *text, size_t size)
{
  if (!size) return;
  const char *flow = has(varied, "flow") ? "several flows" : gg_flow_of(s->flow)->title;
  const bool optional = gg_flow_takes(s->flow, GG_NO_THERMOSTAT);
  snprintf(text, size, "%s%s", flow, optional ? gg_common_thermostats[s->thermostat].title : "");
  if (!has(varied, "phi")) gg_base_text_append(text, size, ", phi %g", s->phi);
  add_law(s, varied, text, size);
  add_surface(s, varied, text, size);
  if (gg_scene_has_kicks(s)) gg_base_text_append(text, size, ", kicks");
  if (gg_scene_has_torque(s)) gg_base_text_append(text, size, ", torque");
  if (has(varied, "species")) return;
  if (s->n_species > 2) gg_base_text_append(text, size, "; %d species", s->n_species);
  if (s->n_species == 2) {
    const gg_species *one = &s->species[0], *two = &s->species[1];
    gg_base_text_append(text, size, "; mixture %g:%g", one->fraction, two->fraction);
    if (one->mass != two->mass) gg_base_text_append(text, size, ", m_2/m_1 %g", two->mass / one->mass);
    if (one->diameter != two->diameter) gg_base_text_append(text, size, ", d_2/d_1 %g", two->diameter / one->diameter);
  }
}
