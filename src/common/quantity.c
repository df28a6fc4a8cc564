#include "common/quantity.h"

#include <string.h>

enum unit {
  UNIT_NONE,
  UNIT_TEMPERATURE,
  UNIT_STRESS,
  UNIT_VISCOSITY,
  UNIT_RATE,
  UNIT_LENGTH,
  UNIT_SPIN,
  UNIT_POWER,
  N_UNITS
};
enum scale { SHEARED, SHEARED_BOLTZMANN, THERMAL, THERMAL_BOLTZMANN, N_SCALES };

/* Temperatures are <C.C>/3, velocities squared, with m of species 1 as the unit of mass. */
static const char *const unit_names[N_SCALES][N_UNITS] = {
    [SHEARED] = {"1", "d^2 gamma^2", "rho_p d^2 gamma^2", "rho_p d^2 gamma", "gamma", "d", "gamma",
                 "rho_p d^2 gamma^3"},
    [SHEARED_BOLTZMANN] = {"1", "(gamma/(n d^2))^2", "n m (gamma/(n d^2))^2", "n m gamma/(n d^2)^2", "gamma",
                           "1/(n d^2)", "gamma", "n m gamma^3/(n d^2)^2"},
    [THERMAL] = {"1", "v_0^2", "rho_p v_0^2", "rho_p d v_0", "v_0/d", "d", "v_0/d", "rho_p v_0^3/d"},
    [THERMAL_BOLTZMANN] = {"1", "v_0^2", "n m v_0^2", "n m v_0/(n d^2)", "n d^2 v_0", "1/(n d^2)", "v_0/d",
                           "n m v_0^3 (n d^2)"},
};

#define GG_QUANTITY_ROW(id, name, unit, doc) {name, unit, doc},
static const struct {
  const char *name;
  enum unit unit;
  const char *doc;
} table[] = {GG_QUANTITIES(GG_QUANTITY_ROW)};
#undef GG_QUANTITY_ROW

const char *gg_quantity_name(gg_quantity q)
{
  return table[q].name;
}
const char *gg_quantity_doc(gg_quantity q)
{
  return table[q].doc;
}

gg_quantity gg_quantity_find(const char *name)
{
  int q = 0;
  while (q < GG_N_QUANTITIES && strcmp(table[q].name, name) != 0) q++;
  return (gg_quantity)q;
}

int gg_quantities_of(const gg_model *m)
{
  return GG_N_QUANTITIES + gg_extension_quantities(m->extension);
}

static const gg_quantity_definition *own(const gg_model *m, gg_quantity q)
{
  return gg_extension_quantity(m->extension, (int)q - GG_N_QUANTITIES);
}

const char *gg_quantity_name_in(const gg_model *m, gg_quantity q)
{
  return q < GG_N_QUANTITIES ? gg_quantity_name(q) : own(m, q)->name;
}
const char *gg_quantity_doc_in(const gg_model *m, gg_quantity q)
{
  return q < GG_N_QUANTITIES ? gg_quantity_doc(q) : own(m, q)->doc;
}

gg_quantity gg_quantity_find_in(const gg_model *m, const char *name)
{
  for (int q = 0; q < gg_quantities_of(m); q++)
    if (strcmp(gg_quantity_name_in(m, (gg_quantity)q), name) == 0) return (gg_quantity)q;
  return GG_MOST_QUANTITIES;
}

const char *gg_quantity_unit(gg_quantity q, const gg_model *model)
{
  if (q >= GG_N_QUANTITIES) return own(model, q)->unit;
  bool sheared = model->shear_rate != 0 || model->flow == GG_COUETTE;
  int scale =
      sheared ? (model->boltzmann ? SHEARED_BOLTZMANN : SHEARED) : (model->boltzmann ? THERMAL_BOLTZMANN : THERMAL);
  return unit_names[scale][table[q].unit];
}
