# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the size that a validation should see, each in one of the places that state the physics on their own: the
engines and the theories. A text of a file is replaced by another; canaries.c has what changes a model."""

NAMES = {
    901: "md: e - 0.02", 902: "md: diameter + 1 %", 903: "md: eta_2 as scanned", 904: "md: half the collisional stress",
    911: "dsmc: e - 0.02", 912: "dsmc: diameter + 1 %", 913: "dsmc: eta_2 as scanned",
    914: "dsmc: half the collisional stress", 915: "dsmc: chi + 2 %",
    921: "theory: e - 0.02", 922: "theory: diameter + 1 %", 923: "theory: eta_2 as scanned",
    924: "theory: half the collisional stress", 925: "theory: chi + 2 %",
    930: "contact value + 2 %",
}

HALF = "(GG_MUTANT(%d) ? 0.5 : 1)"

TEXTS = [
    # the engines' own copies of the model
    ("src/md/md_allocate.c", "  GG_TRY(gg_simd_instructions_check(err));\n  gg_md *e = gg_base_array_new",
     "  gg_model changed = *model;\n  gg_canary_model(&changed, 900);\n  model = &changed;\n"
     "  GG_TRY(gg_simd_instructions_check(err));\n  gg_md *e = gg_base_array_new"),
    ("src/dsmc/dsmc_allocate.c", "  GG_TRY(gg_simd_instructions_check(err));\n  gg_dsmc *made",
     "  gg_model changed = *model;\n  gg_canary_model(&changed, 910);\n  model = &changed;\n"
     "  GG_TRY(gg_simd_instructions_check(err));\n  gg_dsmc *made"),
    # eta_2 of md, which rounds it anew
    ("src/md/contacts.c", "upper_turns((1 + (long double)beta) / mt,",
     "upper_turns((1 + (long double)beta) / mt * (rounded->jt > 0 && GG_MUTANT(903) ? "
     "2 * pow(rounded->ik1 / rounded->im1, 2) : 1),"),
    # e, where a law gives it
    ("src/md/resolve.h", "gg_md_contact_normal_coefficient(contact, restitution,",
     "gg_md_contact_normal_coefficient(contact, restitution - (GG_MUTANT(901) ? 0.02 : 0),"),
    ("src/dsmc/kernel/collide_plain.c", "c.jn = (1 + e) /", "c.jn = (1 + e - (GG_MUTANT(911) ? 0.02 : 0)) /"),
    ("src/dsmc/kernel/stages.h", "(2 - gg_vd3_loss_at(",
     "((gg_real)(GG_MUTANT(911) ? 1.98 : 2) - gg_vd3_loss_at("),
    # the collisional stress
    ("src/md/resolve.h", "gg_add_stress(t->stress[pair], sigma, k, J);",
     "gg_add_stress(t->stress[pair], sigma * %s, k, J);" % (HALF % 904)),
    ("src/dsmc/kernel/collide_plain.c", "gg_add_stress(pass->stress, pass->sigma, k, J);",
     "gg_add_stress(pass->stress, pass->sigma * %s, k, J);" % (HALF % 914)),
    ("src/dsmc/kernel/collision_sums.h", "stress = pass->sigma * mass;",
     "stress = pass->sigma * mass * (features.sums == GG_DSMC_STRESS ? %s : 1);" % (HALF % 914)),
    # the theories
    ("src/theory/theories.c", "\n                                 : theory->evaluate(model, answer, err);",
     "\n                                 : ({ static _Thread_local int depth; gg_model changed = *model; "
     "if (!depth++) gg_canary_model(&changed, 920); "
     "gg_status done = theory->evaluate(&changed, answer, err); depth--; done; });"),
    ("src/theory/theories.c", "  gg_status status = theory->curves(model, measure, list, err);",
     "  gg_model changed = *model;\n  gg_canary_model(&changed, 920);\n"
     "  gg_status status = theory->curves(&changed, measure, list, err);"),
    ("src/theory/answer.c", "  gg_stress total = transfer ? stress_sum",
     "  if (transfer && GG_MUTANT(924)) collisional = (gg_stress){collisional.xx / 2, collisional.yy / 2, "
     "collisional.zz / 2, collisional.xy / 2, collisional.yx / 2};\n  gg_stress total = transfer ? stress_sum"),
    ("src/theory/answer.c", "  double p = m->boltzmann ? kinetic : kinetic + collisional;",
     "  double p = m->boltzmann ? kinetic : kinetic + collisional * %s;" % (HALF % 924)),
    ("src/theory/garzo_dufty1999.c", "eta_k * (1 + 0.8 * (1 + e) * y) + 0.6 * bulk",
     "eta_k + %s * (eta_k * 0.8 * (1 + e) * y + 0.6 * bulk)" % (HALF % 924)),
    ("src/theory/hermite/viscosity.c", "v->total = v->kinetic - transfer(&r)",
     "v->total = v->kinetic - %s * transfer(&r)" % (HALF % 924)),
    ("src/theory/garzo_montanero2003.c", "          4 * M_PI / 15 * ni * nj * sigma3(m, o)",
     "          %s * 4 * M_PI / 15 * ni * nj * sigma3(m, o)" % (HALF % 924)),
    # the contact value that all share
    ("src/common/contact_value.c", "  default: return (1 - phi / 2) /", "  default: return (GG_MUTANT(930) ? 1.02 : 1) "
     "* (1 - phi / 2) /"),
    ("src/common/contact_value.c", "  return 1 / f + 1.5", "  return ((GG_MUTANT(930) ? 1.02 : 1)) * (1 / f + 1.5"),
    ("src/common/contact_value.c", "0.5 * y * y / (f * f * f);", "0.5 * y * y / (f * f * f));"),
]
