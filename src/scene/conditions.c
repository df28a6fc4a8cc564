/* When keys have an effect: what the rows of the field table name under `when`. */
#include <math.h>

#include "common/collision.h"
#include "scene/conditions.h"

static bool is_usf(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return s->flow == GG_USF;
}

static bool is_couette(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return s->flow == GG_COUETTE;
}

static bool is_chute(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return s->flow == GG_CHUTE;
}

static bool is_walled(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return gg_flow_is_walled(s->flow);
}

/* Theories know nothing of engines: with them alone nothing is told of their keys. */
static bool uses_md(const gg_scene *s, unsigned uses)
{
  return uses == GG_USE_THEORY || ((uses & GG_USE_MD) && s->phi > 0);
}

static bool uses_dsmc(const gg_scene *s, unsigned uses)
{
  return uses == GG_USE_THEORY || ((uses & GG_USE_DSMC) && !gg_flow_is_walled(s->flow));
}

static bool counts_particles(const gg_scene *s, unsigned uses)
{
  return uses_md(s, uses) || (s->dsmc.particles == 0 && s->particles > GG_LEAST_ENSEMBLE);
}

static bool uses_one_engine(const gg_scene *s, unsigned uses)
{
  (void)s;
  return !(uses & GG_USE_MD) || !(uses & GG_USE_DSMC);
}

static bool uses_contact_value(const gg_scene *s, unsigned uses)
{
  return s->n_species == 1 && s->phi > 0 && (uses & (GG_USE_DSMC | GG_USE_THEORY));
}

typedef bool pair_test(double e, double beta, double mu);

static bool any_pair(const gg_scene *s, pair_test *test)
{
  for (int i = 0; i < s->n_species; i++)
    for (int j = i; j < s->n_species; j++) {
      int p = gg_pair(i, j);
      if (test(s->collision.e[p], s->collision.beta[p], s->collision.mu[p])) return true;
    }
  return false;
}

static bool loses_energy(double e, double beta, double mu)
{
  gg_rule rule = gg_rule_of(beta, mu);
  return e < 1 || rule == GG_FRICTIONAL || (rule == GG_ROUGH && beta < 1);
}

static bool is_rough(double e, double beta, double mu)
{
  (void)e;
  return gg_rule_of(beta, mu) != GG_SMOOTH;
}

static bool has_beta(double e, double beta, double mu)
{
  (void)e, (void)mu;
  return beta != -1;
}

static bool has_friction(double e, double beta, double mu)
{
  (void)e, (void)beta;
  return mu != 0;
}

bool gg_scene_loses_energy(const gg_scene *s)
{
  return any_pair(s, loses_energy);
}

/* Walls may lose energy, too. */
static bool is_lossy(const gg_scene *s, unsigned uses)
{
  return gg_extension_law(s->extension).e || gg_scene_loses_energy(s) ||
         (is_walled(s, uses) && loses_energy(s->walls.e, s->walls.beta, s->walls.mu));
}

static bool some_rough(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return any_pair(s, is_rough);
}

static bool some_beta(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return any_pair(s, has_beta);
}

static bool some_friction(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return any_pair(s, has_friction);
}

static bool wall_beta(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return s->walls.beta != -1;
}

static bool wall_friction(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return s->walls.mu != 0;
}

const gg_condition gg_if_usf = {is_usf, "but in flow: usf"};
const gg_condition gg_if_couette = {is_couette, "but in flow: couette"};
const gg_condition gg_if_chute = {is_chute, "but in flow: chute"};
const gg_condition gg_if_walled = {is_walled, "but between walls (flow: couette, poiseuille or chute)"};
const gg_condition gg_if_md = {uses_md, "with engine: dsmc"};
const gg_condition gg_if_dsmc = {uses_dsmc, "with engine: md"};
const gg_condition gg_if_counted = {counts_particles,
                                    "with engine: dsmc, whose ensemble has dsmc.particles (auto: at least 5000)"};
const gg_condition gg_if_boxed = {uses_md, "with engine: dsmc, which has no box"};
const gg_condition gg_if_one_engine = {uses_one_engine, "in a comparison; graingas run keeps a trajectory"};
const gg_condition gg_if_contact_value = {uses_contact_value,
                                          "but on theories and engine: dsmc, with one species and phi above 0"};
const gg_condition gg_if_lossy = {is_lossy, "where no collision loses energy"};
const gg_condition gg_if_rough = {some_rough, "on smooth grains, which do not spin"};
const gg_condition gg_if_sticking = {some_beta, "while collision.beta is -1: smooth grains"};
const gg_condition gg_if_tangential = {some_friction, "while collision.mu is 0: smooth grains"};
const gg_condition gg_if_wall_sticking = {wall_beta, "while walls.beta is -1: smooth walls"};
const gg_condition gg_if_wall_tangential = {wall_friction, "while walls.mu is 0: smooth walls"};
