#include "figures.h"

/* mu, omega, delta, e, phi */
static const gg_point figure1[] = {
    {2, 1, 1, 0.5, 0, false}, {2, 1, 1, 0.6, 0, false}, {2, 1, 1, 0.7, 0, false}, {2, 1, 1, 0.8, 0, false},
    {2, 1, 1, 0.9, 0, false}, {0, 1, 1, 0.5, 0, false}, {0, 1, 1, 0.7, 0, false}, {0, 1, 1, 0.9, 0, false},
};

static const gg_point figure3[] = {
    {0.1, 1, 2, 0.5, 0, false}, {0.1, 1, 2, 0.7, 0, false}, {0.1, 1, 2, 0.9, 0, false},
    {2, 1, 2, 0.5, 0, false},   {2, 1, 2, 0.7, 0, false},   {2, 1, 2, 0.9, 0, false},
    {10, 1, 2, 0.5, 0, false},  {10, 1, 2, 0.7, 0, false},  {10, 1, 2, 0.9, 0, false},
};

static const gg_point figure4[] = {
    {4, 1, 0.25, 0.5, 0, false}, {4, 1, 0.25, 0.7, 0, false}, {4, 1, 0.25, 0.9, 0, false},
    {4, 1, 1, 0.5, 0, false},    {4, 1, 1, 0.7, 0, false},    {4, 1, 1, 0.9, 0, false},
    {4, 1, 4, 0.5, 0, false},    {4, 1, 4, 0.7, 0, false},    {4, 1, 4, 0.9, 0, false},
};

static const gg_point figure5[] = {
    {2, 2, 0.5, 0.6, 0, false},   {2, 2, 0.5, 0.6, 0.1, false}, {2, 2, 0.5, 0.6, 0.2, false},
    {2, 2, 0.5, 0.6, 0.3, false}, {2, 2, 0.5, 0.8, 0, false},   {2, 2, 0.5, 0.8, 0.1, false},
    {2, 2, 0.5, 0.8, 0.2, false}, {2, 2, 0.5, 0.8, 0.3, false},
};

static const gg_point figure6[] = {
    {0, 1, 1, 1.0, 0, false}, {0, 1, 1, 0.9, 0, false}, {0, 1, 1, 0.8, 0, false},
    {0, 1, 1, 0.7, 0, false}, {0, 1, 1, 0.6, 0, false}, {0, 1, 1, 0.9, 0, true},
    {0, 1, 1, 0.8, 0, true},  {0, 1, 1, 0.7, 0, true},  {0, 1, 1, 0.6, 0, true},
};

/* The elastic mixture, to which figures 7-9 refer, and the three of each figure. */
#define FOUR(mu, omega, delta)                                                                                         \
  {mu, omega, delta, 1.0, 0, false}, {mu, omega, delta, 0.9, 0, false}, {mu, omega, delta, 0.8, 0, false},             \
  {                                                                                                                    \
    mu, omega, delta, 0.7, 0, false                                                                                    \
  }
static const gg_point figure7[] = {FOUR(0.25, 1, 1), FOUR(0.5, 1, 1), FOUR(2, 1, 1), FOUR(4, 1, 1), FOUR(8, 1, 1)};
static const gg_point figure8[] = {FOUR(4, 0.5, 1), FOUR(4, 1, 1), FOUR(4, 2, 1), FOUR(4, 3, 1)};
static const gg_point figure9[] = {FOUR(4, 1, 0.2), FOUR(4, 1, 0.5), FOUR(4, 1, 2), FOUR(4, 1, 5)};

#define THREE(mu, phi)                                                                                                 \
  {mu, 1, 1, 0.9, phi, false}, {mu, 1, 1, 0.8, phi, false},                                                            \
  {                                                                                                                    \
    mu, 1, 1, 0.7, phi, false                                                                                          \
  }
static const gg_point figure10[] = {THREE(4, 0), THREE(4, 0.1), THREE(4, 0.2), THREE(4, 0.3), THREE(4, 0.4)};
static const gg_point figure12[] = {THREE(0.25, 0.2), THREE(0.5, 0.2), THREE(1, 0.2),
                                    THREE(2, 0.2),    THREE(4, 0.2),   THREE(8, 0.2)};

#define POINTS(array) array, sizeof(array) / sizeof *(array)
const gg_figure gg_figures[] = {
    {"1", "fourth cumulants c_1, c_2", GG_CUMULANTS, POINTS(figure1)},
    {"3", "T1/T2 by mass ratio", GG_PARTIAL_TEMPERATURES, POINTS(figure3)},
    {"4", "T1/T2 by mole ratio", GG_PARTIAL_TEMPERATURES, POINTS(figure4)},
    {"5", "T1/T2 by density", GG_PARTIAL_TEMPERATURES, POINTS(figure5)},
    {"6", "viscosity of one species, heated and cooling", GG_VISCOSITY, POINTS(figure6)},
    {"7", "viscosity by mass ratio", GG_VISCOSITY, POINTS(figure7)},
    {"8", "viscosity by size ratio", GG_VISCOSITY, POINTS(figure8)},
    {"9", "viscosity by mole ratio", GG_VISCOSITY, POINTS(figure9)},
    {"10", "kinetic and total (figure 11) viscosity by density", GG_VISCOSITY, POINTS(figure10)},
    {"12", "viscosity by mass ratio at phi = 0.2", GG_VISCOSITY, POINTS(figure12)},
    {0},
};

gg_scene gg_figure_scene(gg_subject subject, const gg_point *p)
{
  gg_scene s = gg_scene_defaults();
  s.engine = GG_DSMC;
  s.phi = p->phi;
  s.dsmc.particles = 50000;
  for (int q = 0; q < GG_PAIRS; q++) s.collision.e[q] = p->e;
  if (p->mass_ratio > 0) {
    s.n_species = 2;
    s.species[0] = (gg_species){p->mole_ratio / (1 + p->mole_ratio), 1, 1, 0.4};
    s.species[1] = (gg_species){1 / (1 + p->mole_ratio), 1 / p->size_ratio, 1 / p->mass_ratio, 0.4};
  }
  if (subject != GG_VISCOSITY) {
    s.flow = GG_HSS, s.thermostat = GG_GAUSSIAN;
    return s;
  }
  s.flow = GG_SMALL_SHEAR;
  s.thermostat = p->cooling ? GG_NO_THERMOSTAT : GG_GAUSSIAN;
  s.measure |= GG_MEASURE_VISCOSITY;
  return s;
}
