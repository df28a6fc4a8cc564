/* Which quantities a scene has, and why it lacks the others: a table of conditions, not a test in every formula. */
#include "measure/rheology.h"

typedef bool condition(const gg_model *m);

static bool smooth(const gg_model *m)
{
  return m->rule == GG_SMOOTH;
}
static bool cooling(const gg_model *m)
{
  return m->flow == GG_HCS;
}
static bool unsheared(const gg_model *m)
{
  return m->shear_rate == 0;
}
static bool sheared(const gg_model *m)
{
  return m->shear_rate != 0;
}
static bool boltzmann(const gg_model *m)
{
  return m->boltzmann;
}
static bool conserving(const gg_model *m)
{
  return m->elastic;
}
static bool homogeneous(const gg_model *m)
{
  return m->homogeneous;
}
static bool one_species(const gg_model *m)
{
  return m->n_species == 1;
}
static bool mixture(const gg_model *m)
{
  return m->n_species > 1;
}
static bool neither_cools(const gg_model *m)
{
  return m->flow != GG_HCS && m->flow != GG_HSS;
}
static bool always(const gg_model *m)
{
  (void)m;
  return true;
}
static bool nonlinear(const gg_model *m)
{
  return !m->linear_response;
}
static bool heated_rough(const gg_model *m)
{
  return m->flow == GG_HSS && m->rule != GG_SMOOTH;
}

static const struct {
  condition *holds;
  const char *reason;
  gg_quantity first, last; /* quantities it takes away, in table order */
} rules[] = {
    {smooth, "smooth grains do not spin", GG_Q_ROTATIONAL_TEMPERATURE, GG_Q_SPIN_Z},
    {smooth, "smooth grains do not spin", GG_Q_COS2_PSI, GG_Q_COS2_PSI},
    {smooth, "smooth grains do not spin", GG_Q_KURTOSIS_WX, GG_Q_SKEWNESS_WZ},
    {unsheared, "without shear there is no mean spin", GG_Q_SPIN_Z, GG_Q_SPIN_Z},
    {boltzmann, "in the Boltzmann limit collisions do not feel the shear: no mean spin", GG_Q_SPIN_Z, GG_Q_SPIN_Z},
    {boltzmann, "no collisional transfer in the Boltzmann limit", GG_Q_P_XX_COLLISIONAL, GG_Q_P_YX_COLLISIONAL},
    {boltzmann, "an ideal gas in the Boltzmann limit: Z = 1 by definition", GG_Q_COMPRESSIBILITY, GG_Q_COMPRESSIBILITY},
    {cooling, "decays in free cooling; see the history", GG_Q_TEMPERATURE, GG_Q_ROTATIONAL_TEMPERATURE},
    {cooling, "decays in free cooling", GG_Q_PRESSURE, GG_Q_PRESSURE},
    {cooling, "decays in free cooling", GG_Q_P_XX, GG_Q_COLLISION_RATE},
    {cooling, "decays in free cooling", GG_Q_DISSIPATION, GG_Q_DISSIPATION},
    {cooling, "decays in free cooling", GG_Q_TEMPERATURE_1, GG_Q_TEMPERATURE_2},
    {unsheared, "there is no shear", GG_Q_SHEAR_VISCOSITY, GG_Q_SHEAR_VISCOSITY},
    {unsheared, "there is no shear", GG_Q_ENERGY_BALANCE, GG_Q_ENERGY_BALANCE},
    {conserving, "collisions conserve energy", GG_Q_DISSIPATION, GG_Q_COOLING_RATE},
    {homogeneous, "the Monte Carlo ensemble has no box", GG_Q_KNUDSEN, GG_Q_KNUDSEN},
    {neither_cools, "only in cooling and heated flows", GG_Q_COOLING_RATE, GG_Q_COOLING_RATE},
    {heated_rough, "the loss of rough grains is not of one temperature", GG_Q_COOLING_RATE, GG_Q_COOLING_RATE},
    {sheared, "see the kurtosis in sheared flows", GG_Q_A2, GG_Q_C_2},
    {mixture, "see c_1 and c_2 for mixtures", GG_Q_A2, GG_Q_A2},
    {nonlinear, "needs the linear response: flow: usf with thermostat: gaussian, or small_shear: on for a cooling gas",
     GG_Q_VISCOSITY_REDUCED, GG_Q_VISCOSITY_REDUCED_KINETIC},
    {always, "a length of theory, not a mean; see graingas theory", GG_Q_CLUSTERING_LENGTH, GG_Q_CLUSTERING_LENGTH},
    {one_species, "there is one species only", GG_Q_C_1, GG_Q_PARTIAL_TEMPERATURE_RATIO},
};

const char *gg_rheology_missing(const gg_model *model, gg_quantity quantity)
{
  for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
    if (quantity >= rules[i].first && quantity <= rules[i].last && rules[i].holds(model)) return rules[i].reason;
  return NULL;
}
