/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Named quantities from channel means of rheology. Stress by Gayen's thesis eq. 5.15 (per volume), normal stress
 * differences eqs 5.17-5.18. */
#include "common/thermostat.h"
#include "measure/long_waves.h"
#include "measure/rheology.h"

#include <math.h>

/* Channel of a species. */
static double of(const double *a, const gg_model *m, int species, int channel)
{
  return a[CH_SPECIES + (size_t)species * gg_rheology_species_width(m) + (size_t)channel];
}

static double share(const gg_model *m, int i)
{
  return (double)m->n_of[i] / (double)m->n;
}

/* sum_i x_i w_i (channel of i): w = 1 or the mass. */
static double mean_over(const double *a, const gg_model *m, int channel, bool by_mass)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += share(m, i) * (by_mass ? m->mass[i] : 1) * of(a, m, i, channel);
  return sum;
}

static double partial_temperature(const double *a, const gg_model *m, int i)
{
  return m->mass[i] * (of(a, m, i, CH_C2X) + of(a, m, i, CH_C2Y) + of(a, m, i, CH_C2Z)) / 3;
}
static double temperature(const double *a, const gg_model *m)
{
  return (mean_over(a, m, CH_C2X, true) + mean_over(a, m, CH_C2Y, true) + mean_over(a, m, CH_C2Z, true)) / 3;
}
/* Correction of theta. Spins are about the mean of their species at that instant, which takes 1/N_i of their
 * variance away; velocities about that of all grains, 1/N. theta/T is right if both lose the same fraction: this
 * factor restores the difference. */
static double given_back(const gg_model *m, int i)
{
  const double n = (double)m->n, n_i = (double)m->n_of[i];
  return n_i > 1 ? (1 - 1 / n) / (1 - 1 / n_i) : 1;
}
/* theta = sum x_i I_i <Omega.Omega>_i/3 with I Omega^2 = K m s^2 for surface velocities s. */
static double rotational_temperature(const double *a, const gg_model *m)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) {
    double w2 = of(a, m, i, CH_W2X) + of(a, m, i, CH_W2Y) + of(a, m, i, CH_W2Z);
    sum += share(m, i) * m->inertia[i] * m->mass[i] * w2 * given_back(m, i) / 3;
  }
  return sum;
}
static double temperature_ratio(const double *a, const gg_model *m)
{
  return rotational_temperature(a, m) / temperature(a, m);
}
/* sum_i x_i <omega^p>_i from the channel of s^p, s = (d/2) omega. */
static double spin_moment(const double *a, const gg_model *m, int channel, int power)
{
  double sum = 0;
  for (int i = 0; i < m->n_species; i++) sum += share(m, i) * of(a, m, i, channel) * pow(2 / m->diameter[i], power);
  return sum;
}
static double spin_z(const double *a, const gg_model *m)
{
  return spin_moment(a, m, CH_SPIN_Z, 1);
}

#define KINETIC(name, channel)                                                                                         \
  static double name(const double *a, const gg_model *m)                                                               \
  {                                                                                                                    \
    return m->density * m->stress_unit * mean_over(a, m, channel, true);                                               \
  }
KINETIC(kinetic_xx, CH_C2X)
KINETIC(kinetic_yy, CH_C2Y)
KINETIC(kinetic_zz, CH_C2Z)
KINETIC(kinetic_xy, CH_CXY)
#define COLLISIONAL(name, channel)                                                                                     \
  static double name(const double *a, const gg_model *m)                                                               \
  {                                                                                                                    \
    (void)m;                                                                                                           \
    return a[channel];                                                                                                 \
  }
COLLISIONAL(collisional_xx, CH_PC_XX)
COLLISIONAL(collisional_yy, CH_PC_YY)
COLLISIONAL(collisional_zz, CH_PC_ZZ)
COLLISIONAL(collisional_xy, CH_PC_XY)
COLLISIONAL(collisional_yx, CH_PC_YX)
#define TOTAL(name, kinetic, collisional)                                                                              \
  static double name(const double *a, const gg_model *m)                                                               \
  {                                                                                                                    \
    return kinetic(a, m) + collisional(a, m);                                                                          \
  }
TOTAL(total_xx, kinetic_xx, collisional_xx)
TOTAL(total_yy, kinetic_yy, collisional_yy)
TOTAL(total_zz, kinetic_zz, collisional_zz)
TOTAL(total_xy, kinetic_xy, collisional_xy)
TOTAL(total_yx, kinetic_xy, collisional_yx)

static double pressure(const double *a, const gg_model *m)
{
  return (total_xx(a, m) + total_yy(a, m) + total_zz(a, m)) / 3;
}
static double compressibility(const double *a, const gg_model *m)
{
  return pressure(a, m) / (m->density * m->stress_unit * temperature(a, m));
}
static double shear_viscosity(const double *a, const gg_model *m)
{
  return fabs(total_xy(a, m)) / m->shear_rate;
}
static double N1(const double *a, const gg_model *m)
{
  return (total_xx(a, m) - total_yy(a, m)) / pressure(a, m);
}
static double N2(const double *a, const gg_model *m)
{
  return (total_yy(a, m) - total_zz(a, m)) / pressure(a, m);
}

/* Collisions pass the torque on from the spins to the flow, by the antisymmetric part of the stress. */
static double rotational_viscosity(const double *a, const gg_model *m)
{
  return (collisional_xy(a, m) - collisional_yx(a, m)) / (2 * (2 * spin_z(a, m) + m->shear_rate));
}

COLLISIONAL(collision_rate, CH_RATE)
static double mean_free_path(const double *a, const gg_model *m)
{
  return mean_over(a, m, CH_SPEED, false) / a[CH_RATE];
}
static double knudsen(const double *a, const gg_model *m)
{
  return mean_free_path(a, m) / m->length;
}
COLLISIONAL(dissipation, CH_LOSS)
COLLISIONAL(wall_dissipation, CH_WALL_LOSS)
COLLISIONAL(wall_heat_flux, CH_WALL_HEAT)
static double wall_friction(const double *a, const gg_model *m)
{
  (void)m;
  return a[CH_WALL_DRAG] / a[CH_WALL_PUSH];
}
/* Power of torques, per volume and time: K m s' s for the surface velocity s. With a local flow, about which spins are
 * taken, the work has it (rheology.c). */
static double power_of_torques(const double *a, const gg_model *m)
{
  double sum = 0;
  for (int i = 0; i < m->n_species && m->turns && !m->walled && !m->frame; i++)
    sum += share(m, i) * m->inertia[i] * m->mass[i] * m->torque[i] * of(a, m, i, CH_SPIN_Z);
  return sum * m->density * m->stress_unit;
}
/* Power of the noise of a bath or thermostat, and of drag, per volume and time. Spins are dragged towards those that
 * roll with the shear. */
static double power_of_noise(const gg_model *m)
{
  const double white = gg_common_thermostat_kicks(m);
  double sum = 0;
  for (int i = 0; i < m->n_species; i++)
    sum += share(m, i) * 1.5 * m->mass[i] * (white + m->bath.noise[i] + m->inertia[i] * m->bath.spin_noise[i]);
  return sum * m->density * m->stress_unit;
}

gg_dragged gg_measure_rheology_dragged(const double *a, const gg_model *m, int i)
{
  gg_dragged d = {.temperature = partial_temperature(a, m, i)};
  if (m->rule == GG_SMOOTH) return d;
  d.spin_squared = (of(a, m, i, CH_W2X) + of(a, m, i, CH_W2Y) + of(a, m, i, CH_W2Z)) * given_back(m, i);
  d.mean_spin = of(a, m, i, CH_SPIN_Z);
  return d;
}

double gg_measure_rheology_drag(const gg_dragged *d, const gg_model *m)
{
  double sum = 0;
  for (int i = 0; i < m->n_species && m->bath.on; i++) {
    sum += 3 * share(m, i) * m->bath.drag[i] * d[i].temperature;
    if (m->rule == GG_SMOOTH || m->bath.spin_drag[i] == 0) continue;
    const double ahead = d[i].mean_spin - gg_model_rolling(m, i);
    sum +=
        share(m, i) * m->bath.spin_drag[i] * m->inertia[i] * m->mass[i] * (d[i].spin_squared + d[i].mean_spin * ahead);
  }
  return sum * m->density * m->stress_unit;
}

/* The energy of the grains changes from one end of a run to the other: minus that change, the balance holds at every
 * moment, and the remaining scatter is that of P_yx between samples: shear does work on the flux along y of momentum
 * along x, from which P_xy differs by torques. Heat from thermal walls is no loss. */
static double energy_balance(const double *a, const gg_model *m)
{
  double work = m->walled  ? a[CH_WALL_WORK]
                : m->frame ? a[CH_WALL_WORK] - a[CH_PC_YX] * m->shear_rate
                           : -total_yx(a, m) * m->shear_rate;
  gg_dragged dragged[GG_MAX_SPECIES];
  for (int i = 0; i < m->n_species; i++) dragged[i] = gg_measure_rheology_dragged(a, m, i);
  work += power_of_noise(m) - gg_measure_rheology_drag(dragged, m) + power_of_torques(a, m) + a[CH_GIVEN];
  if (gg_model_has_thermal_walls(m)) return (work - a[CH_WALL_LOSS] - a[CH_GROWTH]) / a[CH_LOSS];
  return (work - a[CH_GROWTH]) / (a[CH_LOSS] + a[CH_WALL_LOSS]);
}

static double cooling_rate(const double *a, const gg_model *m)
{
  if (gg_flow_cools(m->flow)) return a[CH_ZETA];
  double T = temperature(a, m); /* heated: -dT/dt by collisions alone, smooth grains */
  return a[CH_LOSS] / (1.5 * m->density * m->stress_unit * T * gg_common_model_nu0(m, T));
}

static double cos2_psi(const double *a, const gg_model *m)
{
  return mean_over(a, m, CH_COS2, false);
}
static double a11(const double *a, const gg_model *m)
{
  return mean_over(a, m, CH_A11, false) - 1;
}
static double orientation_b(const double *a, const gg_model *m)
{
  return mean_over(a, m, CH_B, false) - 1.0 / 3;
}
static double flatness(const double *a, const gg_model *m, int fourth, int second)
{
  double c2 = mean_over(a, m, second, false);
  return mean_over(a, m, fourth, false) / (c2 * c2);
}
static double spin_flatness(const double *a, const gg_model *m, int fourth, int second)
{
  double w2 = spin_moment(a, m, second, 2);
  return spin_moment(a, m, fourth, 4) / (w2 * w2);
}
static double kurtosis_cx(const double *a, const gg_model *m)
{
  return flatness(a, m, CH_C4X, CH_C2X);
}
static double kurtosis_cy(const double *a, const gg_model *m)
{
  return flatness(a, m, CH_C4Y, CH_C2Y);
}
static double kurtosis_cz(const double *a, const gg_model *m)
{
  return flatness(a, m, CH_C4Z, CH_C2Z);
}
static double kurtosis_wx(const double *a, const gg_model *m)
{
  return spin_flatness(a, m, CH_W4X, CH_W2X);
}
static double kurtosis_wy(const double *a, const gg_model *m)
{
  return spin_flatness(a, m, CH_W4Y, CH_W2Y);
}
static double kurtosis_wz(const double *a, const gg_model *m)
{
  return spin_flatness(a, m, CH_W4Z, CH_W2Z);
}
static double skewness_wz(const double *a, const gg_model *m)
{
  return spin_moment(a, m, CH_W3Z, 3) / pow(spin_moment(a, m, CH_W2Z, 2), 1.5);
}

/* Fourth cumulant of one species. If N grains share a fixed energy, even Gaussian ones have <c^4>/T^2 lower than 15
 * by the factor D/(D+2), D = 3(N-1) degrees of freedom: this is corrected, at every instant. If T fluctuates, by
 * kicks or spins, <c^4> is proportional to the mean of T^2. */
static double cumulant(const double *a, const gg_model *m, int i)
{
  double all = temperature(a, m), fluctuation = a[CH_T2] / (all * all);
  double T = partial_temperature(a, m, i) / m->mass[i], D = 3 * ((double)m->n - 1);
  return of(a, m, i, CH_CCCC) / (15 * T * T * fluctuation) * (D + 2) / D - 1;
}
static double a2(const double *a, const gg_model *m)
{
  return cumulant(a, m, 0);
}
static double twice_cumulant(const double *a, const gg_model *m, int i)
{
  return 2 * cumulant(a, m, i);
}
static double partial_ratio(const double *a, const gg_model *m)
{
  return partial_temperature(a, m, 0) / partial_temperature(a, m, 1);
}

static double density_waves(const double *a, const gg_model *m)
{
  return gg_measure_has_long_waves(m) ? a[CH_DENSITY_WAVES] : NAN;
}
static double momentum_waves(const double *a, const gg_model *m)
{
  return gg_measure_has_long_waves(m) ? a[CH_MOMENTUM_WAVES] : NAN;
}

const gg_derived gg_measure_rheology_derived[] = {
    {GG_Q_TEMPERATURE, .of = temperature},
    {GG_Q_ROTATIONAL_TEMPERATURE, .of = rotational_temperature},
    {GG_Q_TEMPERATURE_RATIO, .of = temperature_ratio},
    {GG_Q_SPIN_Z, .of = spin_z},
    {GG_Q_PRESSURE, .of = pressure},
    {GG_Q_COMPRESSIBILITY, .of = compressibility},
    {GG_Q_SHEAR_VISCOSITY, .of = shear_viscosity},
    {GG_Q_ROTATIONAL_VISCOSITY, .of = rotational_viscosity},
    {GG_Q_N1, .of = N1},
    {GG_Q_N2, .of = N2},
    {GG_Q_P_XX, .of = total_xx},
    {GG_Q_P_YY, .of = total_yy},
    {GG_Q_P_ZZ, .of = total_zz},
    {GG_Q_P_XY, .of = total_xy},
    {GG_Q_P_YX, .of = total_yx},
    {GG_Q_P_XX_KINETIC, .of = kinetic_xx},
    {GG_Q_P_YY_KINETIC, .of = kinetic_yy},
    {GG_Q_P_ZZ_KINETIC, .of = kinetic_zz},
    {GG_Q_P_XY_KINETIC, .of = kinetic_xy},
    {GG_Q_P_YX_KINETIC, .of = kinetic_xy},
    {GG_Q_P_XX_COLLISIONAL, .of = collisional_xx},
    {GG_Q_P_YY_COLLISIONAL, .of = collisional_yy},
    {GG_Q_P_ZZ_COLLISIONAL, .of = collisional_zz},
    {GG_Q_P_XY_COLLISIONAL, .of = collisional_xy},
    {GG_Q_P_YX_COLLISIONAL, .of = collisional_yx},
    {GG_Q_COLLISION_RATE, .of = collision_rate},
    {GG_Q_MEAN_FREE_PATH, .of = mean_free_path},
    {GG_Q_KNUDSEN, .of = knudsen},
    {GG_Q_COS2_PSI, .of = cos2_psi},
    {GG_Q_A11, .of = a11},
    {GG_Q_ORIENTATION_B, .of = orientation_b},
    {GG_Q_KURTOSIS_CX, .of = kurtosis_cx},
    {GG_Q_KURTOSIS_CY, .of = kurtosis_cy},
    {GG_Q_KURTOSIS_CZ, .of = kurtosis_cz},
    {GG_Q_KURTOSIS_WX, .of = kurtosis_wx},
    {GG_Q_KURTOSIS_WY, .of = kurtosis_wy},
    {GG_Q_KURTOSIS_WZ, .of = kurtosis_wz},
    {GG_Q_SKEWNESS_WZ, .of = skewness_wz},
    {GG_Q_DISSIPATION, .of = dissipation},
    {GG_Q_WALL_DISSIPATION, .of = wall_dissipation},
    {GG_Q_WALL_HEAT_FLUX, .of = wall_heat_flux},
    {GG_Q_WALL_FRICTION, .of = wall_friction},
    {GG_Q_ENERGY_BALANCE, .of = energy_balance},
    {GG_Q_COOLING_RATE, .of = cooling_rate},
    {GG_Q_A2, .of = a2},
    {GG_Q_CUMULANT, .each = twice_cumulant},
    {GG_Q_PARTIAL_TEMPERATURE, .each = partial_temperature},
    {GG_Q_PARTIAL_TEMPERATURE_RATIO, .of = partial_ratio},
    {GG_Q_DENSITY_WAVES, .of = density_waves},
    {GG_Q_MOMENTUM_WAVES, .of = momentum_waves},
    GG_DERIVED_END,
};

/* History: the temperature of free cooling itself, whose mean has no meaning. */
static double history_temperature(const double *a, const gg_model *m)
{
  (void)m;
  return exp(a[CH_LN_T]);
}
static double history_rotational(const double *a, const gg_model *m)
{
  return history_temperature(a, m) * temperature_ratio(a, m);
}
static double history_partial(const double *a, const gg_model *m, int i)
{
  return history_temperature(a, m) * partial_temperature(a, m, i) / temperature(a, m);
}

const gg_derived gg_measure_rheology_history[] = {
    {GG_Q_TEMPERATURE, .of = history_temperature},
    {GG_Q_ROTATIONAL_TEMPERATURE, .of = history_rotational},
    {GG_Q_PARTIAL_TEMPERATURE, .each = history_partial},
    GG_DERIVED_END,
};
