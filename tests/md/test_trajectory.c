/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Proves: the state after 2 x 10^5 (nightly 10^6) collisions has the stored bits, with any compiler, level of
 * optimisation and set of instructions.
 *
 * After a change that is meant to change trajectories, `md_trajectory print` prints the table below anew. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "md_test.h"

enum { EARLY = 200000, COLLISIONS = 1000000 };

static const struct {
  md_case scene;
  uint64_t early, state; /* after so many collisions */
} stored[] = {
    {{GG_EQUILIBRIUM, 200, 0.1, 1, -1, INFINITY, {0}}, 0xe2a4a7a711b80599, 0x76d3b1e21bd8ade4},
    {{GG_EQUILIBRIUM, 200, 0.5, 1, 1, INFINITY, {0}}, 0x2121cdac7bfe85b8, 0x74f1e00e87e04a46},
    {{GG_USF, 200, 0.3, 0.9, 0, INFINITY, {0}}, 0x95ece954ec5db268, 0x8a4dd17bca5bf190},
    {{GG_USF, 300, 0.45, 0.9, 0, INFINITY, {0}}, 0x53bcd11a6d58916a, 0xe463dbe25f2f7502},
    {{GG_USF, 200, 0.02, 0.8, 0.5, 0.3, {0}}, 0x1594ccfbf4dc7cb3, 0xe5f954a8f688deb8},
    {{GG_USF, 700, 0.01, 0.9, 0, INFINITY, {2, 1, 1}}, 0x0cb6b700b33bcde8, 0xf9453ed5e80b1da7},
    {{GG_USF, 1000, 0.15, 0.8, 0, INFINITY, {1, 1.2, 1}}, 0x95c90db5be0acac7, 0x564659e422b510c0},
    {{GG_COUETTE, 200, 0.2, 0.9, 0, INFINITY, {0}}, 0xbab487f5ef522baf, 0xd302cf185ee70374},
};
enum { CASES = sizeof stored / sizeof *stored };

/* Follows case k; daily only to the first of the two states. */
static void states_of(int k, bool daily, uint64_t *early, uint64_t *state)
{
  gg_model m = md_model(stored[k].scene);
  gg_md *e = md_create(&m, 1);
  md_collide(e, EARLY);
  *early = md_hash(e);
  *state = stored[k].state;
  if (!daily) {
    md_collide(e, COLLISIONS - EARLY);
    *state = md_hash(e);
  }
  md_destroy(e);
}

static void states_have_the_stored_bits(void **state)
{
  (void)state;
  int wrong = 0;
  for (int k = 0; k < CASES; k++) {
    uint64_t early, found;
    states_of(k, getenv("NIGHTLY") == NULL, &early, &found);
    if (early == stored[k].early && found == stored[k].state) continue;
    wrong++;
    print_message("# case %d: states 0x%016llx 0x%016llx\n", k, (unsigned long long)early, (unsigned long long)found);
  }
  assert_int_equal(wrong, 0);
}

/* A run whose clock is at 10^8 at the start has the same trajectory, and its state has the right time. */
static void the_clock_changes_no_bits(void **state)
{
  (void)state;
  gg_model m = md_model((md_case){GG_USF, 200, 0.2, 0.9, 0, INFINITY, {0}});
  gg_md *e = md_create(&m, 1), *late = md_create(&m, 1);
  gg_engine_state now;
  late->k.epoch_start = 1e8;
  double gone = md_collide(e, 200000);
  md_collide(late, 200000);
  gg_md_ops.state(&late->base, &now);
  assert_true(gone > 50 && fabs(now.time - 1e8 - gone) < 1e-6);
  assert_int_equal(md_hash(e), md_hash(late));
  md_destroy(e);
  md_destroy(late);
}

static int print_table(void)
{
  static const char *const flows[] = {"GG_EQUILIBRIUM", "GG_USF",        "GG_HCS",  "GG_HSS",
                                      "GG_COUETTE",     "GG_POISEUILLE", "GG_CHUTE"};
  for (int k = 0; k < CASES; k++) {
    const md_case *c = &stored[k].scene;
    char mu[24] = "INFINITY", aspect[60] = "0";
    if (c->mu < INFINITY) snprintf(mu, sizeof mu, "%g", c->mu);
    if (c->aspect[0] > 0) snprintf(aspect, sizeof aspect, "%g, %g, %g", c->aspect[0], c->aspect[1], c->aspect[2]);
    uint64_t early, state;
    states_of(k, false, &early, &state);
    printf("    {{%s, %d, %g, %g, %g, %s, {%s}}, 0x%016llx, 0x%016llx},\n", flows[c->flow], (int)c->n, c->phi, c->e,
           c->beta, mu, aspect, (unsigned long long)early, (unsigned long long)state);
  }
  return 0;
}

int main(int argc, char **argv)
{
  if (argc > 1 && strcmp(argv[1], "print") == 0) return print_table();
  const struct CMUnitTest tests[] = {cmocka_unit_test(states_have_the_stored_bits),
                                     cmocka_unit_test(the_clock_changes_no_bits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
