/* Pairs of species have turns of the same length, the second half of the list mirrors the first, and going there and
 * back takes no longer than the step allows. */
#include "dsmc/turns.h"
#include "lab.h"

static void turns_cover_all(void **state)
{
  (void)state;
  for (int pairs = 1; pairs <= GG_PAIRS; pairs++)
    for (int sweeps = 1; sweeps <= GG_MOST_SWEEPS; sweeps++) {
      gg_turn turn[GG_MOST_TURNS];
      int n = gg_list_turns(pairs, GG_TURNS_THERE, sweeps, turn), sum[GG_PAIRS] = {0};
      assert_in_range(n, 1, GG_MOST_TURNS);
      for (int k = 0; k < n; k++) {
        assert_int_equal(turn[k].begin, sum[turn[k].pair]); /* whole sweeps that this pair has done */
        sum[turn[k].pair] += turn[k].length;
        assert_true(k == 0 || turn[k].pair != turn[k - 1].pair);
      }
      for (int q = 0; q < pairs; q++) assert_int_equal(sum[q], sweeps);
    }
}

static void there_and_back_is_symmetric(void **state)
{
  (void)state;
  gg_turn turn[GG_MOST_TURNS];
  for (int sweeps = 2; sweeps <= GG_MOST_SWEEPS; sweeps += 2) {
    int n = gg_list_turns(GG_PAIRS, GG_TURNS_THERE_AND_BACK, sweeps, turn);
    for (int k = 0; k < n; k++) {
      const gg_turn *a = &turn[k], *b = &turn[n - 1 - k];
      assert_true(a->pair == b->pair && a->length == b->length && a->begin + a->length + b->begin == sweeps);
    }
  }
}

static void backwards_is_reversed(void **state)
{
  (void)state;
  gg_turn there[GG_MOST_TURNS], back[GG_MOST_TURNS];
  assert_int_equal(gg_list_turns(GG_PAIRS, GG_TURNS_THERE, 1, there), GG_PAIRS);
  assert_int_equal(gg_list_turns(GG_PAIRS, GG_TURNS_BACK, 1, back), GG_PAIRS);
  for (int q = 0; q < GG_PAIRS; q++) assert_int_equal(there[q].pair, back[GG_PAIRS - 1 - q].pair);
}

/* Of a cooling and of a sheared mixture: whole steps, and what is left at the end of a run. */
static void as_often_as_the_step_asks(void **state)
{
  (void)state;
  for (int sheared = 0; sheared < 2; sheared++) {
    gg_scene s = lab_scene(sheared ? GG_USF : GG_HCS, 0.2, 0.8, -1, 1000);
    s.n_species = 2;
    s.species[0].fraction = 0.5;
    s.species[1] = (gg_species){0.5, 1, 4, 0.4};
    gg_model m = lab_model(&s);
    gg_time_step step = gg_time_step_choose(&m, 1);
    double free_time = 1 / gg_model_collision_rate(&m, 1);
    assert_true(step.turns <= 0.25 * free_time && step.length > 1.9 * step.turns);
    for (double dt = step.length; dt > 0.01 * step.turns; dt *= 0.7) {
      int sweeps = gg_sweeps_of(&step, GG_TURNS_THERE_AND_BACK, dt);
      assert_int_equal(sweeps % 2, 0);
      assert_true(2 * dt / sweeps <= step.turns * (1 + 1e-6));
    }
    assert_int_equal(gg_sweeps_of(&step, GG_TURNS_THERE, step.length), 1);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(turns_cover_all),
      cmocka_unit_test(there_and_back_is_symmetric),
      cmocka_unit_test(backwards_is_reversed),
      cmocka_unit_test(as_often_as_the_step_asks),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
