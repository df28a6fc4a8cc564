/* The shared names: one table for JSON keys, HDF5 names, table rows, theories and documents. */
#ifndef GG_QUANTITY_H
#define GG_QUANTITY_H

#include "common/model.h"

/* X(identifier, name, unit, one-line meaning) */
#define GG_QUANTITIES(X)                                                                                               \
  X(TEMPERATURE, "temperature", UNIT_TEMPERATURE, "T = <C.C>/3")                                                       \
  X(ROTATIONAL_TEMPERATURE, "rotational_temperature", UNIT_TEMPERATURE, "theta = I<Omega.Omega>/(3m)")                 \
  X(TEMPERATURE_RATIO, "temperature_ratio", UNIT_NONE, "theta/T")                                                      \
  X(SPIN_Z, "spin_z", UNIT_SPIN, "mean spin about z")                                                                  \
  X(PRESSURE, "pressure", UNIT_STRESS, "third of the trace of the total stress")                                       \
  X(COMPRESSIBILITY, "compressibility_factor", UNIT_NONE, "Z = p/(n T)")                                               \
  X(SHEAR_VISCOSITY, "shear_viscosity", UNIT_VISCOSITY, "|P_xy|/shear rate")                                           \
  X(N1, "N1", UNIT_NONE, "(P_xx - P_yy)/p")                                                                            \
  X(N2, "N2", UNIT_NONE, "(P_yy - P_zz)/p")                                                                            \
  X(P_XX, "P_xx", UNIT_STRESS, "stress")                                                                               \
  X(P_YY, "P_yy", UNIT_STRESS, "stress")                                                                               \
  X(P_ZZ, "P_zz", UNIT_STRESS, "stress")                                                                               \
  X(P_XY, "P_xy", UNIT_STRESS, "stress")                                                                               \
  X(P_YX, "P_yx", UNIT_STRESS, "stress")                                                                               \
  X(P_XX_KINETIC, "P_xx_kinetic", UNIT_STRESS, "kinetic part of P_xx")                                                 \
  X(P_YY_KINETIC, "P_yy_kinetic", UNIT_STRESS, "kinetic part of P_yy")                                                 \
  X(P_ZZ_KINETIC, "P_zz_kinetic", UNIT_STRESS, "kinetic part of P_zz")                                                 \
  X(P_XY_KINETIC, "P_xy_kinetic", UNIT_STRESS, "kinetic part of P_xy")                                                 \
  X(P_YX_KINETIC, "P_yx_kinetic", UNIT_STRESS, "kinetic part of P_yx")                                                 \
  X(P_XX_COLLISIONAL, "P_xx_collisional", UNIT_STRESS, "collisional part of P_xx")                                     \
  X(P_YY_COLLISIONAL, "P_yy_collisional", UNIT_STRESS, "collisional part of P_yy")                                     \
  X(P_ZZ_COLLISIONAL, "P_zz_collisional", UNIT_STRESS, "collisional part of P_zz")                                     \
  X(P_XY_COLLISIONAL, "P_xy_collisional", UNIT_STRESS, "collisional part of P_xy")                                     \
  X(P_YX_COLLISIONAL, "P_yx_collisional", UNIT_STRESS, "collisional part of P_yx")                                     \
  X(COLLISION_RATE, "collision_rate", UNIT_RATE, "collisions per grain and unit time")                                 \
  X(MEAN_FREE_PATH, "mean_free_path", UNIT_LENGTH, "mean peculiar speed over collision rate")                          \
  X(KNUDSEN, "knudsen", UNIT_NONE, "mean free path over box length")                                                   \
  X(COS2_PSI, "cos2_psi", UNIT_NONE, "<(C.Omega)^2/(C^2 Omega^2)>; 1/3 without correlation")                           \
  X(KURTOSIS_CX, "kurtosis_Cx", UNIT_NONE, "<C_x^4>/<C_x^2>^2; 3 for a Gaussian")                                      \
  X(KURTOSIS_CY, "kurtosis_Cy", UNIT_NONE, "<C_y^4>/<C_y^2>^2")                                                        \
  X(KURTOSIS_CZ, "kurtosis_Cz", UNIT_NONE, "<C_z^4>/<C_z^2>^2")                                                        \
  X(KURTOSIS_WX, "kurtosis_Wx", UNIT_NONE, "<Omega_x^4>/<Omega_x^2>^2")                                                \
  X(KURTOSIS_WY, "kurtosis_Wy", UNIT_NONE, "<Omega_y^4>/<Omega_y^2>^2")                                                \
  X(KURTOSIS_WZ, "kurtosis_Wz", UNIT_NONE, "<Omega_z^4>/<Omega_z^2>^2")                                                \
  X(SKEWNESS_WZ, "skewness_Wz", UNIT_NONE, "<Omega_z^3>/<Omega_z^2>^(3/2)")                                            \
  X(DISSIPATION, "dissipation", UNIT_POWER, "energy lost in collisions per volume and time")                           \
  X(ENERGY_BALANCE, "energy_balance", UNIT_NONE, "shear work -P_xy*rate over dissipation; 1 in a steady state")        \
  X(COOLING_RATE, "cooling_rate", UNIT_NONE, "zeta* = zeta/nu_0")                                                      \
  X(A2, "a2", UNIT_NONE, "<c^4>/(15 T^2) - 1, fourth cumulant")                                                        \
  X(C_1, "c_1", UNIT_NONE, "fourth cumulant of species 1 (twice a2)")                                                  \
  X(C_2, "c_2", UNIT_NONE, "fourth cumulant of species 2 (twice a2)")                                                  \
  X(TEMPERATURE_1, "temperature_1", UNIT_TEMPERATURE, "partial temperature m_1<C.C>_1/3")                              \
  X(TEMPERATURE_2, "temperature_2", UNIT_TEMPERATURE, "partial temperature m_2<C.C>_2/3")                              \
  X(PARTIAL_TEMPERATURE_RATIO, "partial_temperature_ratio", UNIT_NONE, "T_1/T_2")                                      \
  X(VISCOSITY_REDUCED, "viscosity_reduced", UNIT_NONE, "eta* = nu eta/(n T)")                                          \
  X(VISCOSITY_REDUCED_KINETIC, "viscosity_reduced_kinetic", UNIT_NONE, "kinetic part of eta*")                         \
  X(CLUSTERING_LENGTH, "clustering_length", UNIT_LENGTH,                                                               \
    "box length above which a cooling gas forms vortices and clusters")

#define GG_QUANTITY_ENUM(id, name, unit, doc) GG_Q_##id,
typedef enum gg_quantity {
  GG_QUANTITIES(GG_QUANTITY_ENUM) GG_N_QUANTITIES,
  GG_MOST_QUANTITIES = GG_N_QUANTITIES + GG_MOST_OWN_QUANTITIES
} gg_quantity;
#undef GG_QUANTITY_ENUM

/* Scenes may have quantities of their own (extension.h), numbered from GG_N_QUANTITIES on. */
int gg_quantities_of(const gg_model *model); /* how many in all */
const char *gg_quantity_name_in(const gg_model *model, gg_quantity q);
const char *gg_quantity_doc_in(const gg_model *model, gg_quantity q);
/* Quantity of that name, or GG_MOST_QUANTITIES. */
gg_quantity gg_quantity_find_in(const gg_model *model, const char *name);

/* Shared quantities alone. */
const char *gg_quantity_name(gg_quantity q);
const char *gg_quantity_doc(gg_quantity q);
/* Quantity of that name, or GG_N_QUANTITIES. */
gg_quantity gg_quantity_find(const char *name);
/* Unit of the quantity in this model's flow, as printed beside every number: "d^2 gamma^2", "1", "rho_p v_0^2" ... */
const char *gg_quantity_unit(gg_quantity q, const gg_model *model);

#endif
