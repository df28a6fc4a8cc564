/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symbols of quantities in gnuplot's enhanced text, which is made of their LaTeX. Families of quantities have three
 * rows: the first two members and the last. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "common/quantity.h"

static const char *const pictured[][2] = {{"temperature", "T"},
                                          {"rotational_temperature", "θ"},
                                          {"temperature_ratio", "θ/T"},
                                          {"spin_z", "<ω_z>"},
                                          {"pressure", "p"},
                                          {"compressibility_factor", "p/(nT)"},
                                          {"shear_viscosity", "η"},
                                          {"N1", "N_1"},
                                          {"N2", "N_2"},
                                          {"P_xx", "P_{xx}"},
                                          {"P_yy", "P_{yy}"},
                                          {"P_zz", "P_{zz}"},
                                          {"P_xy", "P_{xy}"},
                                          {"P_yx", "P_{yx}"},
                                          {"P_xx_kinetic", "P@_{xx}^k"},
                                          {"P_yy_kinetic", "P@_{yy}^k"},
                                          {"P_zz_kinetic", "P@_{zz}^k"},
                                          {"P_xy_kinetic", "P@_{xy}^k"},
                                          {"P_yx_kinetic", "P@_{yx}^k"},
                                          {"P_xx_collisional", "P@_{xx}^c"},
                                          {"P_yy_collisional", "P@_{yy}^c"},
                                          {"P_zz_collisional", "P@_{zz}^c"},
                                          {"P_xy_collisional", "P@_{xy}^c"},
                                          {"P_yx_collisional", "P@_{yx}^c"},
                                          {"collision_rate", "ν"},
                                          {"mean_free_path", "l"},
                                          {"knudsen", "Kn"},
                                          {"cos2_psi", "<cos^2 Ψ>"},
                                          {"kurtosis_Cx", "κ(C_x)"},
                                          {"kurtosis_Cy", "κ(C_y)"},
                                          {"kurtosis_Cz", "κ(C_z)"},
                                          {"kurtosis_Wx", "κ(Ω_x)"},
                                          {"kurtosis_Wy", "κ(Ω_y)"},
                                          {"kurtosis_Wz", "κ(Ω_z)"},
                                          {"skewness_Wz", "γ(Ω_z)"},
                                          {"dissipation", "D"},
                                          {"wall_dissipation", "D_w"},
                                          {"wall_heat_flux", "q_w"},
                                          {"wall_friction", "F_x/F_y"},
                                          {"energy_balance", "(W-dE/dt)/D"},
                                          {"cooling_rate", "ζ*"},
                                          {"a2", "a_2"},
                                          {"c_1", "c_{1}"},
                                          {"c_2", "c_{2}"},
                                          {"c_16", "c_{16}"},
                                          {"temperature_1", "T_{1}"},
                                          {"temperature_2", "T_{2}"},
                                          {"temperature_16", "T_{16}"},
                                          {"partial_temperature_ratio", "T_1/T_2"},
                                          {"viscosity_reduced", "η*"},
                                          {"viscosity_reduced_kinetic", "η*^k"},
                                          {"thermal_conductivity_reduced", "κ*"},
                                          {"thermal_conductivity_reduced_kinetic", "κ*^k"},
                                          {"diffusive_heat_conductivity_reduced", "μ*"},
                                          {"bulk_viscosity_reduced", "η_b*"},
                                          {"cooling_rate_transport", "ζ_u"},
                                          {"rotational_conductivity_reduced", "κ_r*"},
                                          {"rotational_diffusive_conductivity_reduced", "μ_r*"},
                                          {"thermal_conductivity", "κ"},
                                          {"thermal_conductivity_cross", "κ_h"},
                                          {"rotational_conductivity_cross", "κ_r"},
                                          {"rotational_conductivity", "κ_{rh}"},
                                          {"bulk_viscosity", "ξ"},
                                          {"rotational_viscosity", "μ_r"},
                                          {"diffusion_reduced", "D*"},
                                          {"pressure_diffusion_reduced", "D_p*"},
                                          {"thermal_diffusion_reduced", "D'*"},
                                          {"density_waves", "S_L"},
                                          {"momentum_waves", "M_L"},
                                          {"clustering_length", "L_c"},
                                          {"heat_mode_length", "L_h"},
                                          {"relaxation_rate", "λ"}};
enum { PICTURED = sizeof pictured / sizeof *pictured };

static void enhanced_text(void **state)
{
  (void)state;
  char text[48];
  for (size_t i = 0; i < PICTURED; i++) {
    const gg_quantity q = gg_common_quantity_find(pictured[i][0]);
    assert_true(q < GG_N_QUANTITIES);
    assert_string_equal(gg_common_quantity_enhanced(q, text, sizeof text), pictured[i][1]);
  }
}

/* Symbols are LaTeX in ASCII; pictures show none of it. */
static void symbols_are_ascii_latex(void **state)
{
  (void)state;
  char text[48];
  for (int q = 0; q < GG_N_QUANTITIES; q++) {
    gg_common_quantity_symbol((gg_quantity)q, text, sizeof text);
    assert_true(strlen(text) > 0 && strlen(text) < sizeof text - 1);
    for (const char *c = text; *c; c++) assert_true(!(*c & 0x80) && !strchr("@<>", *c));
    assert_null(strchr(gg_common_quantity_enhanced((gg_quantity)q, text, sizeof text), '\\'));
  }
  assert_string_equal(gg_common_quantity_symbol(GG_Q_ROTATIONAL_CONDUCTIVITY, text, sizeof text), "\\kappa_{rh}");
  assert_string_equal(gg_common_quantity_symbol(GG_Q_P_XX_KINETIC, text, sizeof text), "P_{xx}^k");
  assert_string_equal(gg_common_quantity_symbol(GG_Q_SPIN_Z, text, sizeof text), "\\langle\\omega_z\\rangle");
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(enhanced_text), cmocka_unit_test(symbols_are_ascii_latex)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
