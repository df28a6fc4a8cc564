/* A series of any length within a bounded memory. */
#include "planted.h"
#include "statistics/series.h"

/* A series that overflows its memory keeps its mean, its window and its times; a checkpoint restores it bit for bit. */
static void long_series(void **state)
{
  (void)state;
  gg_series s, t;
  assert_int_equal(gg_series_init(&s, 2, NULL), GG_OK);
  double n = 3.7 * GG_SERIES_ROWS, in_window = 0, sum = 0;
  gg_rng r = gg_rng_seed(16, 0);
  for (int i = 0; i < (int)n; i++) {
    if (i == 5001) gg_series_open_window(&s);
    double row[2] = {gg_rng_normal(&r), i};
    gg_series_add(&s, i, row);
    if (i >= 5001) sum += row[0], in_window++;
  }
  assert_int_equal(s.per_row, 4);
  double mean = 0;
  for (size_t i = s.window; i < s.n; i++) mean += gg_series_row(&s, i)[0];
  mean /= (double)gg_series_window_rows(&s);
  assert_true(fabs(mean - sum / in_window) <
              5e-4); /* up to 3 samples where the window opens and 3 pending are left out */
  assert_true(gg_series_row(&s, s.window)[1] >= 5001); /* no row mixes warm-up into the window */
  gg_archive a = {0};
  assert_int_equal(gg_series_save(&s, &a, NULL), GG_OK);
  assert_int_equal(gg_series_init(&t, 2, NULL), GG_OK);
  assert_int_equal(gg_series_restore(&t, &a, NULL), GG_OK);
  for (int i = 0; i < 10; i++) {
    double row[2] = {i, i};
    gg_series_add(&s, n + i, row), gg_series_add(&t, n + i, row);
  }
  assert_int_equal(s.n, t.n);
  assert_memory_equal(s.rows, t.rows, s.n * 2 * sizeof(double));
  gg_archive_clear(&a), gg_series_clear(&s), gg_series_clear(&t);
}

/* Coarsened rows are means of neighbours; the window still begins behind what came before it. */
static void coarsened(void **state)
{
  (void)state;
  gg_series s;
  assert_int_equal(gg_series_init(&s, 1, NULL), GG_OK);
  for (int i = 0; i < 11; i++) {
    if (i == 3) gg_series_open_window(&s);
    gg_series_add(&s, i + 1, &(double){i});
  }
  gg_series_coarsen(&s, 2);
  assert_true(s.n == 5 && s.per_row == 2 && s.window == 2);
  for (size_t i = 0; i < 5; i++)
    assert_true(gg_series_row(&s, i)[0] == 2 * (double)i + 0.5 && s.end_time[i] == 2 * (double)i + 2);
  gg_series_clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(long_series), cmocka_unit_test(coarsened)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
