/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shared names: one table for JSON keys, HDF5 names, table rows, pictures, theories and documents. A quantity
 * is treated according to its row, never according to the position of the row. */
#ifndef GG_QUANTITY_H
#define GG_QUANTITY_H

#include "common/model.h"

/* Needs of a quantity, and its treatment: a row's mask is a sum of these. A need is a property that a scene must have
 * for the quantity to have a mean; gg_common_model_missing gives the reason where it lacks one. */
enum {
  GG_NEEDS_SPINS = 1u << 0,
  GG_NEEDS_MEAN_SPIN = 1u << 1,
  GG_NEEDS_SHEAR = 1u << 2,
  GG_NEEDS_NO_SHEAR = 1u << 3,
  GG_NEEDS_TRANSFER = 1u << 4, /* collisional, over the distance of two centres */
  GG_NEEDS_VOLUME = 1u << 5,   /* of the grains */
  GG_NEEDS_BOX = 1u << 6,
  GG_NEEDS_LOSS = 1u << 7,
  GG_NEEDS_COOLING = 1u << 8, /* by collisions, of one temperature */
  GG_NEEDS_MIXTURE = 1u << 9,
  GG_NEEDS_ONE_SPECIES = 1u << 10,
  GG_NEEDS_LINEAR_RESPONSE = 1u << 11,
  GG_NEEDS_SCALE = 1u << 12,       /* a temperature that lasts */
  GG_NEEDS_SCALE_SHOWN = 1u << 13, /* likewise, and the history says how it decays */
  GG_NEEDS_THEORY = 1u << 14,      /* no mean of anything */
  GG_NEEDS_WORK = 1u << 21,        /* something that does work on the grains: shear, walls, a bath or thermostat */
  GG_NEEDS_WALLS = 1u << 22,
  GG_NEEDS_NO_WALLS = 1u << 23,
  GG_NEEDS_UNEQUAL_WALLS = 1u << 25, /* of two temperatures */
  GG_NEEDS_HEAT_FLUX = 1u << 24,     /* of linear response: one species; dsmc or fluctuations of smooth grains */
  GG_NEEDS_FLUCTUATIONS = 1u << 26,  /* whose decay is that of linear response: elastic grains at rest, in md */
  GG_NEEDS_LAG = 1u << 27,           /* a torque keeps the mean spin from that of the flow, in one species */

  GG_KEPT_HEATING = 1u << 15,      /* free of the temperature's scale: has a meaning as a mean in a gas that heats up */
  GG_MONITORED = 1u << 16,         /* relaxes slowly: a run is not steady while it has a trend */
  GG_FOLLOWED = 1u << 17,          /* from start to end of a run: the time series */
  GG_STRESS_DIFFERENCE = 1u << 18, /* over p: compared as it is; vanishes where the gas has no direction */
  GG_DRAWN = 1u << 19,             /* in the picture of a comparison, as it is: around zero */
  GG_DRAWN_AS_RATIO = 1u << 20     /* there, over the value of an engine */
};
#define GG_P_TOTAL (GG_NEEDS_SCALE)
#define GG_P_COLLISIONAL (GG_NEEDS_SCALE | GG_NEEDS_TRANSFER)
#define GG_SPIN_MOMENT (GG_NEEDS_SPINS)
#define GG_CUMULANT (GG_NEEDS_NO_SHEAR)
#define GG_HEAT_OF_SPINS (GG_NEEDS_THEORY | GG_NEEDS_SPINS)
#define GG_REDUCED_VISCOSITY (GG_NEEDS_LINEAR_RESPONSE | GG_KEPT_HEATING)

/* ONE(identifier, name, symbol in LaTeX, short word or "", unit, mask, meaning in one line, "plain formula: words", and
 * the definition in LaTeX): a quantity. Symbols have what quantity_symbol.c converts.
 * EACH(...): a family with a member a species, GG_Q_<identifier> + i for species i, called <name>_1 and on. A scene has
 * those of the species that it has (and always the first two). */
#define GG_QUANTITIES(ONE, EACH)                                                                                       \
  ONE(TEMPERATURE, "temperature", "T", "temperature", TEMPERATURE,                                                     \
      GG_NEEDS_SCALE_SHOWN | GG_MONITORED | GG_FOLLOWED | GG_DRAWN_AS_RATIO,                                           \
      "<C.C>/3: granular temperature, a third of the mean square peculiar velocity",                                   \
      "T = \\frac{1}{3}\\langle C^2\\rangle")                                                                          \
  ONE(ROTATIONAL_TEMPERATURE, "rotational_temperature", "\\theta", "rotational", TEMPERATURE,                          \
      GG_NEEDS_SPINS | GG_NEEDS_SCALE_SHOWN | GG_FOLLOWED | GG_DRAWN_AS_RATIO,                                         \
      "I<Omega.Omega>/(3m): temperature of the spins about their mean",                                                \
      "\\theta = \\frac{I}{3m}\\langle\\Omega^2\\rangle")                                                              \
  ONE(TEMPERATURE_RATIO, "temperature_ratio", "\\theta/T", "ratio", NONE,                                              \
      GG_NEEDS_SPINS | GG_KEPT_HEATING | GG_MONITORED | GG_FOLLOWED | GG_DRAWN_AS_RATIO,                               \
      "theta/T: rotational over translational temperature; 1 with equipartition", "\\theta/T")                         \
  ONE(SPIN_Z, "spin_z", "\\langle\\omega_z\\rangle", "spin", SPIN,                                                     \
      GG_NEEDS_SPINS | GG_NEEDS_MEAN_SPIN | GG_MONITORED | GG_FOLLOWED | GG_DRAWN,                                     \
      "<omega_z>: mean angular velocity about z, normal to the plane of shear", "\\langle\\omega_z\\rangle")           \
  ONE(PRESSURE, "pressure", "p", "pressure", STRESS, GG_NEEDS_SCALE | GG_FOLLOWED | GG_DRAWN_AS_RATIO,                 \
      "(P_xx + P_yy + P_zz)/3: a third of the trace of the total stress",                                              \
      "p = \\frac{1}{3}(P_{xx} + P_{yy} + P_{zz})")                                                                    \
  ONE(COMPRESSIBILITY, "compressibility_factor", "p/(nT)", "", NONE, GG_NEEDS_VOLUME | GG_DRAWN_AS_RATIO,              \
      "p/(n T): pressure over that of an ideal gas", "Z = \\frac{p}{nT}")                                              \
  ONE(SHEAR_VISCOSITY, "shear_viscosity", "\\eta", "viscosity", VISCOSITY, GG_NEEDS_SHEAR | GG_DRAWN_AS_RATIO,         \
      "|P_xy|/gamma: shear stress over shear rate", "\\eta = \\lvert P_{xy}\\rvert/\\dot\\gamma")                      \
  ONE(N1, "N1", "N_1", "", NONE, GG_STRESS_DIFFERENCE | GG_DRAWN,                                                      \
      "(P_xx - P_yy)/p: first normal stress difference over the pressure", "N_1 = \\frac{P_{xx} - P_{yy}}{p}")         \
  ONE(N2, "N2", "N_2", "", NONE, GG_STRESS_DIFFERENCE | GG_DRAWN,                                                      \
      "(P_yy - P_zz)/p: second normal stress difference over the pressure", "N_2 = \\frac{P_{yy} - P_{zz}}{p}")        \
  ONE(P_XX, "P_xx", "P_{xx}", "", STRESS, GG_P_TOTAL, "total normal stress along x (kinetic and collisional part)",    \
      "P_{xx} = P^k_{xx} + P^c_{xx}")                                                                                  \
  ONE(P_YY, "P_yy", "P_{yy}", "", STRESS, GG_P_TOTAL, "total normal stress along y (kinetic and collisional part)",    \
      "P_{yy} = P^k_{yy} + P^c_{yy}")                                                                                  \
  ONE(P_ZZ, "P_zz", "P_{zz}", "", STRESS, GG_P_TOTAL, "total normal stress along z (kinetic and collisional part)",    \
      "P_{zz} = P^k_{zz} + P^c_{zz}")                                                                                  \
  ONE(P_XY, "P_xy", "P_{xy}", "", STRESS, GG_P_TOTAL | GG_FOLLOWED,                                                    \
      "total stress, flux along x of momentum along y (kinetic and collisional part)", "P_{xy} = P^k_{xy} + P^c_{xy}") \
  ONE(P_YX, "P_yx", "P_{yx}", "", STRESS, GG_P_TOTAL,                                                                  \
      "total stress, flux along y of momentum along x (kinetic and collisional part)", "P_{yx} = P^k_{yx} + P^c_{yx}") \
  ONE(P_XX_KINETIC, "P_xx_kinetic", "P_{xx}^k", "", STRESS, GG_P_TOTAL,                                                \
      "n<m C_x^2>: kinetic part of P_xx, momentum that grains carry", "P^k_{xx} = n\\langle m\\,C_x^2\\rangle")        \
  ONE(P_YY_KINETIC, "P_yy_kinetic", "P_{yy}^k", "", STRESS, GG_P_TOTAL,                                                \
      "n<m C_y^2>: kinetic part of P_yy, momentum that grains carry", "P^k_{yy} = n\\langle m\\,C_y^2\\rangle")        \
  ONE(P_ZZ_KINETIC, "P_zz_kinetic", "P_{zz}^k", "", STRESS, GG_P_TOTAL,                                                \
      "n<m C_z^2>: kinetic part of P_zz, momentum that grains carry", "P^k_{zz} = n\\langle m\\,C_z^2\\rangle")        \
  ONE(P_XY_KINETIC, "P_xy_kinetic", "P_{xy}^k", "", STRESS, GG_P_TOTAL,                                                \
      "n<m C_x C_y>: kinetic part of P_xy, momentum that grains carry", "P^k_{xy} = n\\langle m\\,C_x C_y\\rangle")    \
  ONE(P_YX_KINETIC, "P_yx_kinetic", "P_{yx}^k", "", STRESS, GG_P_TOTAL,                                                \
      "n<m C_y C_x>: kinetic part of P_yx, momentum that grains carry", "P^k_{yx} = n\\langle m\\,C_y C_x\\rangle")    \
  ONE(P_XX_COLLISIONAL, "P_xx_collisional", "P_{xx}^c", "", STRESS, GG_P_COLLISIONAL,                                  \
      "sum of sigma k_x J_x/(V t): collisional part of P_xx, momentum passed on at contact",                           \
      "P^c_{xx} = \\frac{1}{V t}\\sum_{\\mathrm{coll}}\\sigma\\,k_x J_x")                                              \
  ONE(P_YY_COLLISIONAL, "P_yy_collisional", "P_{yy}^c", "", STRESS, GG_P_COLLISIONAL,                                  \
      "sum of sigma k_y J_y/(V t): collisional part of P_yy, momentum passed on at contact",                           \
      "P^c_{yy} = \\frac{1}{V t}\\sum_{\\mathrm{coll}}\\sigma\\,k_y J_y")                                              \
  ONE(P_ZZ_COLLISIONAL, "P_zz_collisional", "P_{zz}^c", "", STRESS, GG_P_COLLISIONAL,                                  \
      "sum of sigma k_z J_z/(V t): collisional part of P_zz, momentum passed on at contact",                           \
      "P^c_{zz} = \\frac{1}{V t}\\sum_{\\mathrm{coll}}\\sigma\\,k_z J_z")                                              \
  ONE(P_XY_COLLISIONAL, "P_xy_collisional", "P_{xy}^c", "", STRESS, GG_P_COLLISIONAL,                                  \
      "sum of sigma k_x J_y/(V t): collisional part of P_xy, momentum passed on at contact",                           \
      "P^c_{xy} = \\frac{1}{V t}\\sum_{\\mathrm{coll}}\\sigma\\,k_x J_y")                                              \
  ONE(P_YX_COLLISIONAL, "P_yx_collisional", "P_{yx}^c", "", STRESS, GG_P_COLLISIONAL,                                  \
      "sum of sigma k_y J_x/(V t): collisional part of P_yx, momentum passed on at contact",                           \
      "P^c_{yx} = \\frac{1}{V t}\\sum_{\\mathrm{coll}}\\sigma\\,k_y J_x")                                              \
  ONE(COLLISION_RATE, "collision_rate", "\\nu", "collisions", RATE,                                                    \
      GG_NEEDS_SCALE | GG_MONITORED | GG_FOLLOWED | GG_DRAWN_AS_RATIO,                                                 \
      "2 collisions/(N t): collisions per grain and unit of time; a collision counts for both partners",               \
      "\\nu = \\frac{2\\,N_{\\mathrm{coll}}}{N t}")                                                                    \
  ONE(MEAN_FREE_PATH, "mean_free_path", "l", "", LENGTH, GG_KEPT_HEATING,                                              \
      "<C>/nu: mean peculiar speed over collision rate", "l = \\langle C\\rangle/\\nu")                                \
  ONE(KNUDSEN, "knudsen", "\\mathrm{Kn}", "", NONE, GG_NEEDS_BOX | GG_KEPT_HEATING,                                    \
      "l/V^(1/3): mean free path over the cube root of the box volume", "\\mathrm{Kn} = l/V^{1/3}")                    \
  ONE(COS2_PSI, "cos2_psi", "\\langle\\cos^2 \\Psi\\rangle", "", NONE, GG_NEEDS_SPINS | GG_KEPT_HEATING | GG_FOLLOWED, \
      "<(C.Omega)^2/(C^2 Omega^2)>: mean square cosine of the angle between velocity and spin; 1/3 without "           \
      "correlation",                                                                                                   \
      "\\left\\langle\\frac{(\\mathbf{C}\\cdot\\mathbf{\\Omega})^2}{C^2\\,\\Omega^2}\\right\\rangle")                  \
  ONE(A11, "a11", "a_{11}", "", NONE, GG_NEEDS_SPINS | GG_KEPT_HEATING,                                                \
      "<C^2 Omega^2>/(<C^2><Omega^2>) - 1: correlation of the magnitudes of velocity and spin; 0 without correlation", \
      "a_{11} = \\frac{\\langle C^2\\,\\Omega^2\\rangle}{\\langle C^2\\rangle\\langle\\Omega^2\\rangle} - 1")          \
  ONE(ORIENTATION_B, "b", "b", "", NONE, GG_NEEDS_SPINS | GG_KEPT_HEATING,                                             \
      "<(C.Omega)^2>/(<C^2><Omega^2>) - 1/3: correlation of the directions of velocity and spin; 0 without "           \
      "correlation",                                                                                                   \
      "b = \\frac{\\langle(\\mathbf{C}\\cdot\\mathbf{\\Omega})^2\\rangle}"                                             \
      "{\\langle C^2\\rangle\\langle\\Omega^2\\rangle} - \\frac{1}{3}")                                                \
  ONE(KURTOSIS_CX, "kurtosis_Cx", "\\kappa(C_x)", "", NONE, 0,                                                         \
      "<C_x^4>/<C_x^2>^2: kurtosis of the velocity along x; 3 for a Gaussian",                                         \
      "\\frac{\\langle C_x^4\\rangle}{\\langle C_x^2\\rangle^2}")                                                      \
  ONE(KURTOSIS_CY, "kurtosis_Cy", "\\kappa(C_y)", "", NONE, 0,                                                         \
      "<C_y^4>/<C_y^2>^2: kurtosis of the velocity along y; 3 for a Gaussian",                                         \
      "\\frac{\\langle C_y^4\\rangle}{\\langle C_y^2\\rangle^2}")                                                      \
  ONE(KURTOSIS_CZ, "kurtosis_Cz", "\\kappa(C_z)", "", NONE, 0,                                                         \
      "<C_z^4>/<C_z^2>^2: kurtosis of the velocity along z; 3 for a Gaussian",                                         \
      "\\frac{\\langle C_z^4\\rangle}{\\langle C_z^2\\rangle^2}")                                                      \
  ONE(KURTOSIS_WX, "kurtosis_Wx", "\\kappa(\\Omega_x)", "", NONE, GG_SPIN_MOMENT,                                      \
      "<Omega_x^4>/<Omega_x^2>^2: kurtosis of the spin along x; 3 for a Gaussian",                                     \
      "\\frac{\\langle \\Omega_x^4\\rangle}{\\langle \\Omega_x^2\\rangle^2}")                                          \
  ONE(KURTOSIS_WY, "kurtosis_Wy", "\\kappa(\\Omega_y)", "", NONE, GG_SPIN_MOMENT,                                      \
      "<Omega_y^4>/<Omega_y^2>^2: kurtosis of the spin along y; 3 for a Gaussian",                                     \
      "\\frac{\\langle \\Omega_y^4\\rangle}{\\langle \\Omega_y^2\\rangle^2}")                                          \
  ONE(KURTOSIS_WZ, "kurtosis_Wz", "\\kappa(\\Omega_z)", "", NONE, GG_SPIN_MOMENT,                                      \
      "<Omega_z^4>/<Omega_z^2>^2: kurtosis of the spin along z; 3 for a Gaussian",                                     \
      "\\frac{\\langle \\Omega_z^4\\rangle}{\\langle \\Omega_z^2\\rangle^2}")                                          \
  ONE(SKEWNESS_WZ, "skewness_Wz", "\\gamma(\\Omega_z)", "", NONE, GG_SPIN_MOMENT,                                      \
      "<Omega_z^3>/<Omega_z^2>^(3/2): skewness of the spin about z; 0 for a Gaussian",                                 \
      "\\frac{\\langle\\Omega_z^3\\rangle}{\\langle\\Omega_z^2\\rangle^{3/2}}")                                        \
  ONE(DISSIPATION, "dissipation", "D", "", POWER, GG_NEEDS_LOSS | GG_NEEDS_SCALE,                                      \
      "sum of -Delta E/(V t): energy lost in collisions, but for what kicks give, per volume and time",                \
      "D = \\frac{1}{V t}\\sum_{\\mathrm{coll}}(-\\Delta E)")                                                          \
  ONE(WALL_DISSIPATION, "wall_dissipation", "D_w", "", POWER, GG_NEEDS_WALLS | GG_NEEDS_SCALE,                         \
      "sum of -Delta E_wall/(V t): energy lost in contacts with walls, per volume and time; below 0 where thermal "    \
      "walls heat the gas",                                                                                            \
      "D_w = \\frac{1}{V t}\\sum_{\\mathrm{wall}}(-\\Delta E)")                                                        \
  ONE(WALL_HEAT_FLUX, "wall_heat_flux", "q_w", "heat", HEAT_FLUX, GG_NEEDS_UNEQUAL_WALLS | GG_DRAWN_AS_RATIO,          \
      "(Q_upper - Q_lower)/(2 A t): heat that the upper wall takes and the lower one gives, mean of both, per area "   \
      "and time",                                                                                                      \
      "q_w = \\frac{1}{2At}(Q_{\\mathrm{upper}} - Q_{\\mathrm{lower}})")                                               \
  ONE(WALL_FRICTION, "wall_friction", "F_x/F_y", "", NONE, GG_NEEDS_WALLS,                                             \
      "F_x/F_y: force of the gas along the walls over that across them; walls.mu where every contact slides",          \
      "F_x/F_y")                                                                                                       \
  ONE(ENERGY_BALANCE, "energy_balance", "(W-dE/dt)/D", "", NONE, GG_NEEDS_WORK | GG_NEEDS_LOSS,                        \
      "(W - dE/dt)/(D + D_w): work of shear, walls and gravity and what noise, kicks and torques give, less what "     \
      "drag takes and the growth of the grains' energy, over dissipation: 1; between thermal walls "                   \
      "(W - D_w - dE/dt)/D",                                                                                           \
      "(W - \\dot E)/(D + D_w)")                                                                                       \
  ONE(COOLING_RATE, "cooling_rate", "\\zeta^*", "cooling", NONE, GG_NEEDS_LOSS | GG_NEEDS_COOLING | GG_DRAWN_AS_RATIO, \
      "zeta/nu_0: rate of energy loss over the reference collision rate nu_0", "\\zeta^* = \\zeta/\\nu_0")             \
  ONE(A2, "a2", "a_2", "", NONE, GG_CUMULANT | GG_NEEDS_ONE_SPECIES | GG_MONITORED | GG_FOLLOWED | GG_DRAWN,           \
      "<C^4>/(15 T^2) - 1: fourth cumulant of the velocity distribution; 0 for a Gaussian",                            \
      "a_2 = \\frac{\\langle C^4\\rangle}{15\\,T^2} - 1")                                                              \
  EACH(CUMULANT, "c", "c", "", NONE, GG_CUMULANT | GG_NEEDS_MIXTURE,                                                   \
       "2 (<C^4>/(15 (T_i/m_i)^2) - 1): fourth cumulant of the species, twice its a2",                                 \
       "c_i = 2\\left(\\frac{\\langle C^4\\rangle_i}{15\\,(T_i/m_i)^2} - 1\\right)")                                   \
  EACH(PARTIAL_TEMPERATURE, "temperature", "T", "", TEMPERATURE,                                                       \
       GG_NEEDS_SCALE | GG_NEEDS_MIXTURE | GG_DRAWN_AS_RATIO, "m_i<C.C>_i/3: partial temperature of the species",      \
       "T_i = \\frac{m_i}{3}\\langle C^2\\rangle_i")                                                                   \
  ONE(PARTIAL_TEMPERATURE_RATIO, "partial_temperature_ratio", "T_1/T_2", "", NONE,                                     \
      GG_NEEDS_MIXTURE | GG_DRAWN_AS_RATIO, "T_1/T_2: partial temperature of species 1 over that of species 2",        \
      "T_1/T_2")                                                                                                       \
  ONE(VISCOSITY_REDUCED, "viscosity_reduced", "\\eta^*", "viscosity", NONE, GG_REDUCED_VISCOSITY | GG_DRAWN_AS_RATIO,  \
      "nu_0 eta/(n T): viscosity of linear response, with the reference collision rate nu_0",                          \
      "\\eta^* = \\frac{\\nu_0\\,\\eta}{nT}")                                                                          \
  ONE(VISCOSITY_REDUCED_KINETIC, "viscosity_reduced_kinetic", "\\eta^{*k}", "", NONE, GG_REDUCED_VISCOSITY,            \
      "nu_0 eta_k/(n T): kinetic part of viscosity_reduced", "\\eta^{*k} = \\frac{\\nu_0\\,\\eta^k}{nT}")              \
  ONE(THERMAL_CONDUCTIVITY_REDUCED, "thermal_conductivity_reduced", "\\kappa^*", "", NONE, GG_NEEDS_HEAT_FLUX,         \
      "kappa/kappa_0: heat flux along -grad T of a cooling gas; kappa_0 = 15 n T/(4 m nu_0), q = -kappa grad T - mu "  \
      "grad n",                                                                                                        \
      "\\kappa^* = \\frac{4 m\\nu_0\\,\\kappa}{15\\,nT}")                                                              \
  ONE(THERMAL_CONDUCTIVITY_REDUCED_KINETIC, "thermal_conductivity_reduced_kinetic", "\\kappa^{*k}", "", NONE,          \
      GG_NEEDS_HEAT_FLUX, "kappa_k/kappa_0: kinetic part of thermal_conductivity_reduced",                             \
      "\\kappa^{*k} = \\frac{4 m\\nu_0\\,\\kappa^k}{15\\,nT}")                                                         \
  ONE(DIFFUSIVE_HEAT_CONDUCTIVITY_REDUCED, "diffusive_heat_conductivity_reduced", "\\mu^*", "", NONE,                  \
      GG_NEEDS_HEAT_FLUX, "n mu/(T kappa_0): heat flux along -grad n of a cooling gas; 0 for elastic grains",          \
      "\\mu^* = \\frac{4 m\\nu_0\\,\\mu}{15\\,T^2}")                                                                   \
  ONE(BULK_VISCOSITY_REDUCED, "bulk_viscosity_reduced", "\\eta_b^*", "", NONE, GG_NEEDS_FLUCTUATIONS,                  \
      "nu_0 eta_b/(n T): bulk viscosity; of smooth grains by collisions alone",                                        \
      "\\eta_b^* = \\frac{\\nu_0\\,\\eta_b}{nT}")                                                                      \
  ONE(COOLING_RATE_TRANSPORT, "cooling_rate_transport", "\\zeta_u", "", NONE, GG_NEEDS_THEORY,                         \
      "response of the cooling rate to expansion at first order in gradients: zeta = zeta_0 + zeta_u div u",           \
      "\\zeta = \\zeta_0 + \\zeta_u\\,\\nabla\\cdot\\mathbf u")                                                        \
  ONE(ROTATIONAL_CONDUCTIVITY_REDUCED, "rotational_conductivity_reduced", "\\kappa_r^*", "", NONE,                     \
      GG_NEEDS_HEAT_FLUX | GG_NEEDS_SPINS,                                                                             \
      "kappa_r/kappa_0: rotational heat flux along -grad T of a cooling gas, whose theta goes as T",                   \
      "\\kappa_r^* = \\frac{4 m\\nu_0\\,\\kappa_r}{15\\,nT}")                                                          \
  ONE(ROTATIONAL_DIFFUSIVE_CONDUCTIVITY_REDUCED, "rotational_diffusive_conductivity_reduced", "\\mu_r^*", "", NONE,    \
      GG_NEEDS_HEAT_FLUX | GG_NEEDS_SPINS, "n mu_r/(T kappa_0): rotational heat flux along -grad n of a cooling gas",  \
      "\\mu_r^* = \\frac{4 m\\nu_0\\,\\mu_r}{15\\,T^2}")                                                               \
  ONE(THERMAL_CONDUCTIVITY, "thermal_conductivity", "\\kappa", "", VISCOSITY, GG_NEEDS_THEORY,                         \
      "translational heat flux along -grad T under shear, n uniform; q = -kappa grad T - kappa_h grad theta",          \
      "\\mathbf q = -\\kappa\\nabla T - \\kappa_h\\nabla\\theta")                                                      \
  ONE(THERMAL_CONDUCTIVITY_CROSS, "thermal_conductivity_cross", "\\kappa_h", "", VISCOSITY, GG_HEAT_OF_SPINS,          \
      "translational heat flux along -grad theta", "\\mathbf q = -\\kappa\\nabla T - \\kappa_h\\nabla\\theta")         \
  ONE(ROTATIONAL_CONDUCTIVITY_CROSS, "rotational_conductivity_cross", "\\kappa_r", "", VISCOSITY, GG_HEAT_OF_SPINS,    \
      "rotational heat flux along -grad T; q_r = -kappa_r grad T - kappa_rh grad theta",                               \
      "\\mathbf q_r = -\\kappa_r\\nabla T - \\kappa_{rh}\\nabla\\theta")                                               \
  ONE(ROTATIONAL_CONDUCTIVITY, "rotational_conductivity", "\\kappa_{rh}", "", VISCOSITY, GG_HEAT_OF_SPINS,             \
      "rotational heat flux along -grad theta", "\\mathbf q_r = -\\kappa_r\\nabla T - \\kappa_{rh}\\nabla\\theta")     \
  ONE(BULK_VISCOSITY, "bulk_viscosity", "\\xi", "", VISCOSITY, GG_NEEDS_THEORY | GG_NEEDS_TRANSFER,                    \
      "pressure lost per rate of expansion, of collisions alone", "p - \\xi\\,\\nabla\\cdot\\mathbf u")                \
  ONE(ROTATIONAL_VISCOSITY, "rotational_viscosity", "\\mu_r", "", VISCOSITY,                                           \
      GG_NEEDS_SPINS | GG_NEEDS_TRANSFER | GG_NEEDS_SCALE | GG_NEEDS_LAG,                                              \
      "(P_xy - P_yx)/(2(2 omega_z + gamma)): antisymmetric stress over what the mean spin has beyond the flow's "      \
      "rotation",                                                                                                      \
      "\\Psi = P_{yx} - P_{xy} = -2\\mu_r(2\\omega_z - (\\nabla\\times\\mathbf u)_z)")                                   \
  ONE(DIFFUSION_REDUCED, "diffusion_reduced", "D^*", "", NONE, GG_NEEDS_THEORY | GG_NEEDS_MIXTURE,                     \
      "mass flux of species 1 along -grad x_1; j_1 = -(nT/nu_0)(D* grad x_1 + D_p* grad ln p + D'* grad ln T)",        \
      "D^* = \\frac{m_1 m_2\\nu_0}{\\rho T}D")                                                                         \
  ONE(PRESSURE_DIFFUSION_REDUCED, "pressure_diffusion_reduced", "D_p^*", "", NONE, GG_NEEDS_THEORY | GG_NEEDS_MIXTURE, \
      "mass flux of species 1 along -grad ln p", "D_p^* = \\frac{\\rho\\nu_0}{nT}D_p")                                 \
  ONE(THERMAL_DIFFUSION_REDUCED, "thermal_diffusion_reduced", "D'^*", "", NONE, GG_NEEDS_THEORY | GG_NEEDS_MIXTURE,    \
      "mass flux of species 1 along -grad ln T", "D'^* = \\frac{\\rho\\nu_0}{nT}D'")                                   \
  ONE(DENSITY_WAVES, "density_waves", "S_L", "", NONE, GG_NEEDS_BOX | GG_NEEDS_NO_WALLS | GG_KEPT_HEATING,             \
      "<|sum d^3 exp(ikr)|^2>/(S_e sum d^6): density waves as long as the box and half of it, k = 2 pi/L and 4 pi/L, " \
      "over "                                                                                                          \
      "those of elastic spheres; near 1 in a homogeneous gas, more where grains cluster",                              \
      "\\frac{\\langle\\lvert\\sum d^3\\,e^{i k r}\\rvert^2\\rangle}{S_e\\sum d^6}")                                   \
  ONE(MOMENTUM_WAVES, "momentum_waves", "M_L", "", NONE, GG_NEEDS_BOX | GG_NEEDS_NO_WALLS | GG_KEPT_HEATING,           \
      "<|sum m C_t exp(ikr)|^2>/sum (m C_t)^2: shear waves as long as the box and half of it, k = 2 pi/L and 4 pi/L, " \
      "C_t "                                                                                                           \
      "across k; near 1 in a homogeneous gas, more where it swirls",                                                   \
      "\\frac{\\langle\\lvert\\sum m C_t\\,e^{i k r}\\rvert^2\\rangle}{\\sum (m C_t)^2}")                              \
  ONE(CLUSTERING_LENGTH, "clustering_length", "L_c", "", LENGTH, GG_NEEDS_THEORY,                                      \
      "2 pi sqrt(2 eta/(n m zeta)): box length above which a cooling gas forms vortices and clusters",                 \
      "L_c = 2\\pi\\sqrt{\\frac{2\\eta}{n m \\zeta}}")                                                                 \
  ONE(HEAT_MODE_LENGTH, "heat_mode_length", "L_h", "", LENGTH, GG_NEEDS_THEORY,                                        \
      "box length above which a cooling gas forms clusters by its heat mode alone, at any shear viscosity",            \
      "L_h = 2\\pi\\sqrt{\\frac{2(\\kappa C_p - \\mu n/T)}{3n\\zeta(1+r)(C_\\chi - C_p/2)}}")                          \
  ONE(RELAXATION_RATE, "relaxation_rate", "\\lambda", "", RATE, GG_NEEDS_THEORY,                                       \
      "decay rate of the slowest disturbance of a homogeneous steady state",                                           \
      "\\lambda = -\\max\\operatorname{Re}\\,\\mathrm{spec}")

#define GG_QUANTITY_ONE(id, ...) GG_Q_##id,
#define GG_QUANTITY_EACH(id, ...) GG_Q_##id, GG_Q_LAST_##id = GG_Q_##id + GG_MAX_SPECIES - 1,
typedef enum gg_quantity {
  GG_QUANTITIES(GG_QUANTITY_ONE, GG_QUANTITY_EACH) GG_N_QUANTITIES,
  GG_MOST_QUANTITIES = GG_N_QUANTITIES + GG_MOST_OWN_QUANTITIES
} gg_quantity;
#undef GG_QUANTITY_ONE
#undef GG_QUANTITY_EACH

/* The quantities of a scene, in the order in which they are shown: the shared ones, of families the members that it
 * has; then user-defined ones (extension.h), numbered from GG_N_QUANTITIES on. */
int gg_common_quantity_set_of(const gg_model *model); /* how many in all */
gg_quantity gg_common_quantity_at(const gg_model *model, int index);
const char *gg_common_quantity_name_in(const gg_model *model, gg_quantity q);
const char *gg_common_quantity_doc_in(const gg_model *model, gg_quantity q);
/* Quantity of that name, or GG_MOST_QUANTITIES. */
gg_quantity gg_common_quantity_find_in(const gg_model *model, const char *name);

/* Shared quantities alone. */
const char *gg_common_quantity_name(gg_quantity q);
const char *gg_common_quantity_doc(gg_quantity q);
const char *gg_common_quantity_formula(gg_quantity q); /* as LaTeX has it */
/* In which scenes it has a mean: "rough grains; not in free cooling"; returns text. */
const char *gg_common_quantity_when(gg_quantity q, char *text, size_t size);
/* "\\kappa_{rh}", "T_{2}" of a family: LaTeX; returns text. */
const char *gg_common_quantity_symbol(gg_quantity q, char *text, size_t size);
/* The same as gnuplot's enhanced text, for pictures and curves: "κ_{rh}". */
const char *gg_common_quantity_enhanced(gg_quantity q, char *text, size_t size);
const char *gg_common_quantity_word(gg_quantity q); /* for pictures: "temperature"; or "" */
/* Quantity of that name, or GG_N_QUANTITIES. */
gg_quantity gg_common_quantity_find(const char *name);
/* The next one after q (first: start with -1) whose mask holds any of these; GG_N_QUANTITIES after the last. Every
 * member of a family counts. */
gg_quantity gg_common_quantity_next(int q, unsigned mask);

/* The mask of the row; 0 of user-defined ones. */
unsigned gg_common_quantity_mask(gg_quantity q);
/* The first of the family that q belongs to: itself if it is none of a family. User-defined ones are one family. */
gg_quantity gg_common_quantity_family(gg_quantity q);
/* Unit of the quantity in this model's flow, as printed beside every number: "d^2 gamma^2", "1", "rho_p v_0^2" ... */
const char *gg_common_quantity_unit(gg_quantity q, const gg_model *model);

/* Why this model lacks something that the GG_NEEDS_ bits of the mask stand for; NULL if it has it all. */
const char *gg_common_model_missing(const gg_model *model, unsigned needs);
/* The same of a quantity's mask: the reason why its mean cannot be had. */
const char *gg_common_quantity_missing(const gg_model *model, gg_quantity q);

#define GG_COUNT_FOLLOWED(id, name, symbol, word, unit, mask, doc, formula) +(((mask)&GG_FOLLOWED) ? 1 : 0)
enum { GG_N_HISTORY = 0 GG_QUANTITIES(GG_COUNT_FOLLOWED, GG_COUNT_FOLLOWED) };
#undef GG_COUNT_FOLLOWED
/* The quantities followed from start to end of a run: those of GG_FOLLOWED, k from 0 to GG_N_HISTORY - 1. */
gg_quantity gg_common_quantity_of_history(int k);

#endif
