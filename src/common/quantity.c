/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/quantity.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "common/thermostat.h"
#include "graingas.h"

enum unit {
  UNIT_NONE,
  UNIT_TEMPERATURE,
  UNIT_STRESS,
  UNIT_VISCOSITY,
  UNIT_RATE,
  UNIT_LENGTH,
  UNIT_SPIN,
  UNIT_POWER,
  UNIT_HEAT_FLUX,
  N_UNITS
};
enum scale { SHEARED, SHEARED_BOLTZMANN, THERMAL, THERMAL_BOLTZMANN, N_SCALES };

/* Temperatures are <C.C>/3, velocities squared, with m of species 1 as the unit of mass. */
static const char *const unit_names[N_SCALES][N_UNITS] = {
    [SHEARED] = {"1", "d^2 gamma^2", "rho_p d^2 gamma^2", "rho_p d^2 gamma", "gamma", "d", "gamma", "rho_p d^2 gamma^3",
                 "rho_p d^3 gamma^3"},
    [SHEARED_BOLTZMANN] = {"1", "(gamma/(n d^2))^2", "n m (gamma/(n d^2))^2", "n m gamma/(n d^2)^2", "gamma",
                           "1/(n d^2)", "gamma", "n m gamma^3/(n d^2)^2", "n m (gamma/(n d^2))^3"},
    [THERMAL] = {"1", "v_0^2", "rho_p v_0^2", "rho_p d v_0", "v_0/d", "d", "v_0/d", "rho_p v_0^3/d", "rho_p v_0^3"},
    [THERMAL_BOLTZMANN] = {"1", "v_0^2", "n m v_0^2", "n m v_0/(n d^2)", "n d^2 v_0", "1/(n d^2)", "v_0/d",
                           "n m v_0^3 (n d^2)", "n m v_0^3"},
};

/* Names of the members of a family. */
#define NUMBERED(name)                                                                                                 \
  name "_1", name "_2", name "_3", name "_4", name "_5", name "_6", name "_7", name "_8", name "_9", name "_10",       \
      name "_11", name "_12", name "_13", name "_14", name "_15", name "_16"
_Static_assert(GG_MAX_SPECIES <= 16, "a name for every species");

#define NAMES_OF_ONE(id, name, ...) static const char *const names_##id[] = {name};
#define NAMES_OF_EACH(id, name, ...) static const char *const names_##id[] = {NUMBERED(name)};
GG_QUANTITIES(NAMES_OF_ONE, NAMES_OF_EACH)

typedef struct row {
  gg_quantity first;
  int members; /* one, or a member a species */
  const char *const *names;
  const char *symbol, *word;
  enum unit unit;
  unsigned mask;
  const char *doc, *formula;
} row;

#define ROW_OF_ONE(id, name, symbol, word, unit, mask, doc, formula)                                                   \
  {GG_Q_##id, 1, names_##id, symbol, word, UNIT_##unit, mask, doc, formula},
#define ROW_OF_EACH(id, name, symbol, word, unit, mask, doc, formula)                                                  \
  {GG_Q_##id, GG_MAX_SPECIES, names_##id, symbol, word, UNIT_##unit, mask, doc, formula},
static const row table[] = {GG_QUANTITIES(ROW_OF_ONE, ROW_OF_EACH)};
enum { ROWS = sizeof table / sizeof *table };

static const row *row_of(gg_quantity q)
{
  const row *r = table;
  while (q >= r->first + (gg_quantity)r->members) r++;
  return r;
}

const char *gg_common_quantity_name(gg_quantity q)
{
  const row *r = row_of(q);
  return r->names[q - r->first];
}
const char *gg_common_quantity_doc(gg_quantity q)
{
  return row_of(q)->doc;
}
const char *gg_common_quantity_formula(gg_quantity q)
{
  return row_of(q)->formula;
}
const char *gg_common_quantity_word(gg_quantity q)
{
  return row_of(q)->word;
}
const char *gg_common_quantity_symbol(gg_quantity q, char *text, size_t size)
{
  const row *r = row_of(q);
  if (r->members == 1)
    snprintf(text, size, "%s", r->symbol);
  else
    snprintf(text, size, "%s_{%d}", r->symbol, (int)(q - r->first) + 1);
  return text;
}

gg_quantity gg_common_quantity_find(const char *name)
{
  int q = 0;
  while (q < GG_N_QUANTITIES && strcmp(gg_common_quantity_name((gg_quantity)q), name) != 0) q++;
  return (gg_quantity)q;
}

unsigned gg_common_quantity_mask(gg_quantity q)
{
  return q < GG_N_QUANTITIES ? row_of(q)->mask : 0;
}
gg_quantity gg_common_quantity_family(gg_quantity q)
{
  return q < GG_N_QUANTITIES ? row_of(q)->first : GG_N_QUANTITIES;
}

gg_quantity gg_common_quantity_next(int q, unsigned mask)
{
  for (q++; q < GG_N_QUANTITIES; q++)
    if (gg_common_quantity_mask((gg_quantity)q) & mask) break;
  return (gg_quantity)q;
}

gg_quantity gg_common_quantity_of_history(int k)
{
  int q = -1;
  while (k-- >= 0) q = (int)gg_common_quantity_next(q, GG_FOLLOWED);
  return (gg_quantity)q;
}

/* How many of a row this model has. */
static int members_in(const row *r, const gg_model *m)
{
  int species = m->n_species > 2 ? m->n_species : 2;
  return r->members < species ? r->members : species;
}

int gg_common_quantity_set_of(const gg_model *m)
{
  int n = gg_common_extension_quantities(m->extension);
  for (int i = 0; i < ROWS; i++) n += members_in(&table[i], m);
  return n;
}

gg_quantity gg_common_quantity_at(const gg_model *m, int index)
{
  for (int i = 0; i < ROWS; i++) {
    int members = members_in(&table[i], m);
    if (index < members) return (gg_quantity)((int)table[i].first + index);
    index -= members;
  }
  return (gg_quantity)(GG_N_QUANTITIES + index);
}

static const gg_quantity_definition *user_defined(const gg_model *m, gg_quantity q)
{
  return gg_common_extension_quantity(m->extension, (int)q - GG_N_QUANTITIES);
}

const char *gg_common_quantity_name_in(const gg_model *m, gg_quantity q)
{
  return q < GG_N_QUANTITIES ? gg_common_quantity_name(q) : user_defined(m, q)->name;
}
const char *gg_common_quantity_doc_in(const gg_model *m, gg_quantity q)
{
  return q < GG_N_QUANTITIES ? gg_common_quantity_doc(q) : user_defined(m, q)->doc;
}

gg_quantity gg_common_quantity_find_in(const gg_model *m, const char *name)
{
  for (int i = 0; i < gg_common_quantity_set_of(m); i++) {
    gg_quantity q = gg_common_quantity_at(m, i);
    if (strcmp(gg_common_quantity_name_in(m, q), name) == 0) return q;
  }
  return GG_MOST_QUANTITIES;
}

const char *gg_common_quantity_unit(gg_quantity q, const gg_model *model)
{
  if (q >= GG_N_QUANTITIES) return user_defined(model, q)->unit;
  bool sheared = gg_flow_is_timed_by_shear(model->flow);
  int scale =
      sheared ? (model->boltzmann ? SHEARED_BOLTZMANN : SHEARED) : (model->boltzmann ? THERMAL_BOLTZMANN : THERMAL);
  return unit_names[scale][row_of(q)->unit];
}

/* Check the needs in turn; the reason of the first that is not met. */
const char *gg_common_model_missing(const gg_model *m, unsigned needs)
{
  const bool smooth = m->rule == GG_SMOOTH, cools = gg_flow_cools(m->flow), heated = gg_flow_is_heated(m->flow);
  const bool rests = m->elastic && !m->walled && (cools || m->flow == GG_EQUILIBRIUM);
  const bool fluctuates = rests && !m->ensemble && !(m->wave > 0);
  const bool noisy = m->bath.on || m->kicks || m->turns || gg_common_heat_of(m) == GG_HEAT_KICKS;
  const bool turned = gg_common_model_is_turned(m), sheared = gg_model_is_sheared(m);
  const bool alike = m->n_surfaces < 2 || m->surface[0].temperature == m->surface[1].temperature;
  const struct {
    unsigned need;
    bool unmet;
    const char *reason;
  } rules[] = {
      {GG_NEEDS_SPINS, smooth, "smooth grains do not spin"},
      {GG_NEEDS_MEAN_SPIN, m->walled, "between walls it depends on y; see profile_spin_z"},
      {GG_NEEDS_MEAN_SPIN, !sheared && m->spin0 == 0 && !turned,
       "without shear, torque, tangential kicks or start.spin there is no mean spin"},
      {GG_NEEDS_MEAN_SPIN, m->boltzmann,
       "in the Boltzmann limit the mean spin, a share of thermal ones, is infinite in units of the shear rate"},
      {GG_NEEDS_LAG, !m->turns, "without a torque spins roll with the flow; see graingas theory"},
      {GG_NEEDS_LAG, m->kick[GG_TANGENTIAL_KICK][0] != 0, "kicks along the surfaces have a stress of their own"},
      {GG_NEEDS_LAG, m->n_species > 1, "measured in one species"},
      {GG_NEEDS_TRANSFER, m->boltzmann, "no collisional transfer in the Boltzmann limit"},
      {GG_NEEDS_VOLUME, m->boltzmann, "an ideal gas in the Boltzmann limit: Z = 1 by definition"},
      {GG_NEEDS_SCALE_SHOWN, cools, "decays in free cooling; see the history"},
      {GG_NEEDS_SCALE, cools, "decays in free cooling"},
      {GG_NEEDS_SHEAR, !sheared, "there is no shear"},
      {GG_NEEDS_NO_WALLS, m->walled, "between walls the gas is not homogeneous"},
      {GG_NEEDS_WALLS, !m->walled, "there are no walls"},
      {GG_NEEDS_UNEQUAL_WALLS, alike, "there are no two walls of different temperatures"},
      {GG_NEEDS_WORK, !sheared && !m->walled && !noisy, "nothing does work on the grains"},
      {GG_NEEDS_LOSS, m->elastic || (m->elastic_grains && gg_model_has_thermal_walls(m)), "collisions conserve energy"},
      {GG_NEEDS_BOX, m->homogeneous, "the Monte Carlo ensemble has no box"},
      {GG_NEEDS_COOLING, !cools && !heated, "only in cooling and heated flows"},
      {GG_NEEDS_COOLING, heated && !smooth, "the energy loss of rough grains does not depend on one temperature alone"},
      {GG_NEEDS_NO_SHEAR, sheared, "see the kurtosis in sheared flows"},
      {GG_NEEDS_ONE_SPECIES, m->n_species > 1, "see c_1 and c_2 for mixtures"},
      {GG_NEEDS_LINEAR_RESPONSE, !m->linear_response && !fluctuates && !(m->wave > 0),
       "needs flow: small_shear, start.wave, or md of elastic grains at rest"},
      {GG_NEEDS_FLUCTUATIONS, !fluctuates, "measured in md of elastic grains at rest, without start.wave"},
      {GG_NEEDS_THEORY, true, "given by theories only; see graingas theory"},
      {GG_NEEDS_HEAT_FLUX, sheared || m->walled || heated, "only in cooling gases and at rest"},
      {GG_NEEDS_HEAT_FLUX, m->n_species > 1 || m->rule == GG_FRICTIONAL, "measured of one species without friction"},
      {GG_NEEDS_HEAT_FLUX, !smooth && !m->homogeneous, "of rough grains needs engine: dsmc"},
      {GG_NEEDS_HEAT_FLUX, m->law.name != NULL, "with a law of restitution the cooling gas is never the same"},
      {GG_NEEDS_HEAT_FLUX, !m->homogeneous && !fluctuates, "needs engine: dsmc, or elastic grains"},
      {GG_NEEDS_MIXTURE, m->n_species == 1, "there is one species only"},
  };
  for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
    if ((needs & rules[i].need) && rules[i].unmet) return rules[i].reason;
  return NULL;
}

const char *gg_common_quantity_missing(const gg_model *model, gg_quantity q)
{
  return gg_common_model_missing(model, gg_common_quantity_mask(q));
}

const char *gg_common_quantity_when(gg_quantity q, char *text, size_t size)
{
  static const struct {
    unsigned need;
    const char *words;
  } words[] = {
      {GG_NEEDS_THEORY, "theories only"},
      {GG_NEEDS_LINEAR_RESPONSE,
       "flow: small_shear; start.wave (viscosity_reduced); md of elastic grains at rest with measure: helfand"},
      {GG_NEEDS_FLUCTUATIONS, "md of elastic grains at rest with measure: helfand"},
      {GG_NEEDS_HEAT_FLUX, "dsmc with measure: conductivity, cooling or at rest; md of elastic grains with measure: "
                           "helfand (smooth grains); one species"},
      {GG_NEEDS_SPINS, "rough grains"},
      {GG_NEEDS_MEAN_SPIN, "shear, a torque, tangential kicks or start.spin, without walls, phi above 0"},
      {GG_NEEDS_LAG, "a torque, one species"},
      {GG_NEEDS_SHEAR, "shear"},
      {GG_NEEDS_WALLS, "walls"},
      {GG_NEEDS_NO_WALLS, "no walls"},
      {GG_NEEDS_UNEQUAL_WALLS, "walls of two temperatures"},
      {GG_NEEDS_WORK, "shear, walls, a bath, noise, kicks or torques"},
      {GG_NEEDS_NO_SHEAR, "no shear"},
      {GG_NEEDS_ONE_SPECIES, "one species"},
      {GG_NEEDS_MIXTURE, "mixtures"},
      {GG_NEEDS_LOSS, "collisions that lose energy"},
      {GG_NEEDS_COOLING, "free cooling, or heated smooth grains"},
      {GG_NEEDS_TRANSFER | GG_NEEDS_VOLUME, "phi above 0"},
      {GG_NEEDS_BOX, "md"},
      {GG_NEEDS_SCALE | GG_NEEDS_SCALE_SHOWN, "no free cooling"},
  };
  const unsigned mask = gg_common_quantity_mask(q);
  *text = '\0';
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (mask & words[i].need) gg_base_text_append(text, size, "%s%s", *text ? "; " : "", words[i].words);
  if (!*text) snprintf(text, size, "always");
  return text;
}
