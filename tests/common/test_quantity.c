/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of quantities: names are found again and none is used twice, families have a member a species and scenes
 * those of the species that they have, and what a quantity needs is what decides whether it is there. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "common/quantity.h"

static void names_find_their_quantities(void **state)
{
  (void)state;
  char symbol[48];
  for (int q = 0; q < GG_N_QUANTITIES; q++) {
    assert_int_equal(gg_common_quantity_find(gg_common_quantity_name((gg_quantity)q)), q);
    assert_true(strlen(gg_common_quantity_doc((gg_quantity)q)) > 5);
    assert_true(strlen(gg_common_quantity_symbol((gg_quantity)q, symbol, sizeof symbol)) > 0);
  }
  assert_string_equal(gg_common_quantity_name(GG_Q_PARTIAL_TEMPERATURE), "temperature_1");
  assert_string_equal(gg_common_quantity_name(GG_Q_CUMULANT + 1), "c_2");
  assert_string_equal(gg_common_quantity_symbol(GG_Q_PARTIAL_TEMPERATURE + 1, symbol, sizeof symbol), "T_{2}");
  assert_int_equal(gg_common_quantity_family(GG_Q_LAST_CUMULANT), GG_Q_CUMULANT);
  assert_int_equal(gg_common_quantity_family(GG_Q_N1), GG_Q_N1);
}

/* Whatever the number of species: each quantity once, those of a family by the species. */
static void of_a_scene(void **state)
{
  (void)state;
  int before = 0;
  for (int species = 1; species <= GG_MAX_SPECIES; species++) {
    gg_model m = {.n_species = species};
    int n = gg_common_quantity_set_of(&m), partial = 0;
    for (int i = 0; i < n; i++) {
      gg_quantity q = gg_common_quantity_at(&m, i);
      assert_int_equal(gg_common_quantity_find_in(&m, gg_common_quantity_name_in(&m, q)), q);
      if (i) assert_true(gg_common_quantity_at(&m, i - 1) < q);
      partial += gg_common_quantity_family(q) == GG_Q_PARTIAL_TEMPERATURE;
    }
    assert_int_equal(partial, species > 2 ? species : 2);
    if (species > 2) assert_int_equal(n, before + 2);
    before = n;
  }
  gg_model two = {.n_species = 2};
  assert_int_equal(gg_common_quantity_find_in(&two, "temperature_3"), GG_MOST_QUANTITIES);
}

/* A scene without one feature lacks exactly the quantities whose mask needs it, with the reason. */
static void a_missing_need_removes_its_quantities_only(void **state)
{
  (void)state;
  const gg_model whole = {.flow = GG_USF, .rule = GG_ROUGH, .shear_rate = 1, .n_species = 2, .linear_response = true};
  const struct {
    gg_model model;
    unsigned need;
    const char *reason;
  } cases[] = {
      {{.flow = GG_USF, .rule = GG_SMOOTH, .shear_rate = 1, .n_species = 2, .linear_response = true},
       GG_NEEDS_SPINS,
       "smooth grains do not spin"},
      {{.flow = GG_USF, .rule = GG_ROUGH, .shear_rate = 1, .n_species = 1, .linear_response = true},
       GG_NEEDS_MIXTURE,
       "there is one species only"},
      {{.flow = GG_USF, .rule = GG_ROUGH, .shear_rate = 1, .n_species = 2},
       GG_NEEDS_LINEAR_RESPONSE,
       "needs flow: small_shear, start.wave, or md of elastic grains at rest"},
      {{.flow = GG_USF, .rule = GG_ROUGH, .shear_rate = 1, .n_species = 2, .linear_response = true, .elastic = true},
       GG_NEEDS_LOSS,
       "collisions conserve energy"},
      {{.flow = GG_USF,
        .rule = GG_ROUGH,
        .shear_rate = 1,
        .n_species = 2,
        .linear_response = true,
        .homogeneous = true},
       GG_NEEDS_BOX,
       "the Monte Carlo ensemble has no box"},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    int lost = 0;
    for (int i = 0; i < gg_common_quantity_set_of(&whole); i++) {
      gg_quantity q = gg_common_quantity_at(&whole, i);
      const char *here = gg_common_quantity_missing(&cases[k].model, q), *there = gg_common_quantity_missing(&whole, q);
      bool asks = gg_common_quantity_mask(q) & cases[k].need;
      if (there) continue; /* lost already */
      if (!asks) assert_null(here);
      if (asks) assert_string_equal(here, cases[k].reason);
      lost += asks;
    }
    assert_true(lost > 0);
  }
}

/* A quantity that decays has a history and no mean. */
static void a_decaying_quantity_has_no_mean(void **state)
{
  (void)state;
  const gg_model cooling = {.flow = GG_HCS, .rule = GG_ROUGH, .n_species = 1};
  unsigned mask = gg_common_quantity_mask(GG_Q_TEMPERATURE);
  assert_string_equal(gg_common_quantity_missing(&cooling, GG_Q_TEMPERATURE),
                      "decays in free cooling; see the history");
  assert_string_equal(gg_common_quantity_missing(&cooling, GG_Q_PRESSURE), "decays in free cooling");
  assert_null(gg_common_quantity_missing(&cooling, GG_Q_TEMPERATURE_RATIO));
  assert_null(gg_common_model_missing(&cooling, mask & ~(unsigned)GG_NEEDS_SCALE_SHOWN));
  bool followed = false;
  for (int k = 0; k < GG_N_HISTORY; k++) {
    gg_quantity q = gg_common_quantity_of_history(k);
    assert_true(gg_common_quantity_mask(q) & GG_FOLLOWED);
    if (k) assert_true(q > gg_common_quantity_of_history(k - 1));
    followed |= q == GG_Q_TEMPERATURE;
  }
  assert_true(followed);
  assert_int_equal(gg_common_quantity_of_history(GG_N_HISTORY), GG_N_QUANTITIES);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_find_their_quantities), cmocka_unit_test(of_a_scene),
                                     cmocka_unit_test(a_missing_need_removes_its_quantities_only),
                                     cmocka_unit_test(a_decaying_quantity_has_no_mean)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
