/* Which quantities a scene has, and why it lacks the others: what a need means, and the reason where it is not met. The
 * first reason that applies is told. */
#include "common/quantity.h"

static bool smooth(const gg_model *m)
{
  return m->rule == GG_SMOOTH;
}
static bool cooling(const gg_model *m)
{
  return gg_flow_cools(m->flow);
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
static bool walled(const gg_model *m)
{
  return m->walled;
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
  return !gg_flow_cools(m->flow) && !gg_flow_is_heated(m->flow);
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
  return gg_flow_is_heated(m->flow) && m->rule != GG_SMOOTH;
}

static const struct {
  unsigned need;
  bool (*unmet)(const gg_model *m);
  const char *reason;
} rules[] = {
    {GG_NEEDS_SPINS, smooth, "smooth grains do not spin"},
    {GG_NEEDS_MEAN_SPIN, walled, "between walls it goes with the height; see profile_spin_z"},
    {GG_NEEDS_MEAN_SPIN, unsheared, "without shear there is no mean spin"},
    {GG_NEEDS_MEAN_SPIN, boltzmann,
     "in the Boltzmann limit the mean spin, a share of thermal ones, is infinite in units of the shear rate"},
    {GG_NEEDS_TRANSFER, boltzmann, "no collisional transfer in the Boltzmann limit"},
    {GG_NEEDS_VOLUME, boltzmann, "an ideal gas in the Boltzmann limit: Z = 1 by definition"},
    {GG_NEEDS_SCALE_SHOWN, cooling, "decays in free cooling; see the history"},
    {GG_NEEDS_SCALE, cooling, "decays in free cooling"},
    {GG_NEEDS_SHEAR, unsheared, "there is no shear"},
    {GG_NEEDS_LOSS, conserving, "collisions conserve energy"},
    {GG_NEEDS_BOX, homogeneous, "the Monte Carlo ensemble has no box"},
    {GG_NEEDS_COOLING, neither_cools, "only in cooling and heated flows"},
    {GG_NEEDS_COOLING, heated_rough, "the loss of rough grains is not of one temperature"},
    {GG_NEEDS_NO_SHEAR, sheared, "see the kurtosis in sheared flows"},
    {GG_NEEDS_ONE_SPECIES, mixture, "see c_1 and c_2 for mixtures"},
    {GG_NEEDS_LINEAR_RESPONSE, nonlinear, "needs the linear response: flow: small_shear"},
    {GG_NEEDS_THEORY, always, "told by theories alone, not a mean; see graingas theory"},
    {GG_NEEDS_MIXTURE, one_species, "there is one species only"},
};

const char *gg_common_model_missing(const gg_model *model, unsigned needs)
{
  for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
    if ((needs & rules[i].need) && rules[i].unmet(model)) return rules[i].reason;
  return NULL;
}

const char *gg_common_quantity_missing(const gg_model *model, gg_quantity q)
{
  return gg_common_model_missing(model, gg_common_quantity_mask(q));
}
