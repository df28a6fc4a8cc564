/* When keys have an effect: what the rows of the field table name under `when`. */
#include <math.h>
#include <stdio.h>

#include "common/collision.h"
#include "scene/conditions.h"

bool gg_scene_condition_holds(const gg_condition *c, const gg_scene *s, unsigned uses)
{
  return c->flow ? c->flow(s->flow) : c->holds(s, uses);
}

void gg_scene_condition_otherwise(const gg_condition *c, char *text, size_t size)
{
  char flows[160] = "";
  if (c->flow) gg_common_flow_list(c->flow, flows, sizeof flows);
  snprintf(text, size, "%s%s%s", c->otherwise, flows, c->after ? c->after : "");
}

static bool may_be_open(gg_flow flow)
{
  return gg_flow_of(flow)->may_be_open;
}

/* Theories know nothing of engines: with them alone nothing is told of their keys. */
static bool uses_md(const gg_scene *s, unsigned uses)
{
  return uses == GG_USE_THEORY || ((uses & GG_USE_MD) && s->phi > 0 && gg_flow_runs_in(s->flow, GG_MD));
}

static bool uses_dsmc(const gg_scene *s, unsigned uses)
{
  return uses == GG_USE_THEORY || ((uses & GG_USE_DSMC) && gg_flow_runs_in(s->flow, GG_DSMC));
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

/* White noise makes up for what Enskog's collision rate would lose: in md, too, its strength goes with the key. */
static bool has_noise(const gg_scene *s)
{
  gg_thermostat given = s->thermostat;
  return (gg_flow_takes(s->flow, given) ? given : gg_flow_of(s->flow)->thermostat) == GG_WHITE_NOISE;
}

static bool uses_contact_value(const gg_scene *s, unsigned uses)
{
  return s->n_species == 1 && s->phi > 0 && ((uses & (GG_USE_DSMC | GG_USE_THEORY)) || has_noise(s));
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
  gg_rule rule = gg_common_rule_select(beta, mu);
  return e < 1 || rule == GG_FRICTIONAL || (rule == GG_ROUGH && beta < 1);
}

static bool is_rough(double e, double beta, double mu)
{
  (void)e;
  return gg_common_rule_select(beta, mu) != GG_SMOOTH;
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
  (void)uses;
  return gg_common_extension_law(s->extension).e || gg_scene_loses_energy(s) ||
         (gg_flow_is_walled(s->flow) && loses_energy(s->walls.e, s->walls.beta, s->walls.mu));
}

static bool has_law(const gg_scene *s, unsigned uses)
{
  (void)uses;
  return s->collision.law != GG_LAW_CONSTANT;
}

/* Is there a mean to know so well? Not of a gas that heats up for ever, nor of one that cools with a law of restitution
 * and is never the same again; and where nothing is lost there is no rate of loss. */
static bool has_error(const gg_scene *s, unsigned uses)
{
  const bool own = gg_common_extension_law(s->extension).e != NULL, lossy = own || gg_scene_loses_energy(s);
  if (uses == GG_USE_THEORY || lossy) return !(gg_flow_cools(s->flow) && (own || has_law(s, uses)));
  if (gg_flow_is_sheared(s->flow)) return gg_flow_of(s->flow)->linear_response;
  const bool shares = s->n_species > 1 || any_pair(s, is_rough); /* temperatures, whose ratio is known */
  return shares || !(gg_flow_cools(s->flow) || gg_flow_is_heated(s->flow));
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

const gg_condition gg_scene_if_sheared = {.flow = gg_flow_is_sheared, .otherwise = "but in flow: "};
const gg_condition gg_scene_if_moving_walls = {.flow = gg_flow_has_moving_walls, .otherwise = "but in flow: "};
const gg_condition gg_scene_if_openable = {.flow = may_be_open, .otherwise = "but in flow: "};
const gg_condition gg_scene_if_walled = {
    .flow = gg_flow_is_walled, .otherwise = "but between walls (flow: ", .after = ")"};
const gg_condition gg_scene_if_md = {.holds = uses_md, .otherwise = "with engine: dsmc"};
const gg_condition gg_scene_if_dsmc = {.holds = uses_dsmc, .otherwise = "with engine: md"};
const gg_condition gg_scene_if_counted = {
    .holds = counts_particles,
    .otherwise = "with engine: dsmc, whose ensemble has dsmc.particles (auto: at least 5000)"};
const gg_condition gg_scene_if_boxed = {.holds = uses_md, .otherwise = "with engine: dsmc, which has no box"};
const gg_condition gg_scene_if_one_engine = {.holds = uses_one_engine,
                                             .otherwise = "in a comparison; graingas run keeps a trajectory"};
const gg_condition gg_scene_if_contact_value = {
    .holds = uses_contact_value,
    .otherwise = "but on theories, engine: dsmc and the strength of white noise, with one species and phi above 0"};
const gg_condition gg_scene_if_lossy = {.holds = is_lossy, .otherwise = "where no collision loses energy"};
const gg_condition gg_scene_if_error = {
    .holds = has_error,
    .otherwise = "but on the ensemble's size, in a gas without such means: elastic and sheared, elastic and alone, or "
                 "cooling by a law"};
const gg_condition gg_scene_if_rough = {.holds = some_rough, .otherwise = "on smooth grains, which do not spin"};
const gg_condition gg_scene_if_law = {.holds = has_law, .otherwise = "while collision.law is constant"};
const gg_condition gg_scene_if_sticking = {.holds = some_beta,
                                           .otherwise = "while collision.beta is -1: smooth grains"};
const gg_condition gg_scene_if_tangential = {.holds = some_friction,
                                             .otherwise = "while collision.mu is 0: smooth grains"};
const gg_condition gg_scene_if_wall_sticking = {.holds = wall_beta,
                                                .otherwise = "while walls.beta is -1: smooth walls"};
const gg_condition gg_scene_if_wall_tangential = {.holds = wall_friction,
                                                  .otherwise = "while walls.mu is 0: smooth walls"};
