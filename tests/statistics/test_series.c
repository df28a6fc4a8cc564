/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A series of any length needs bounded memory. */
#include <stdlib.h>

#include "planted.h"
#include "statistics/series.h"

/* A series that exceeds its memory keeps its mean, its window and its times; a checkpoint restores it bit for bit. */
static void long_series(void **state)
{
  (void)state;
  gg_series s, t;
  assert_int_equal(gg_statistics_series_init(&s, 2, NULL), GG_OK);
  double n = floor(3.7 * GG_SERIES_ROWS / 4) * 4 + 3, in_window = 0, sum = 0;
  gg_rng r = gg_common_rng_seed(16, 0);
  for (int i = 0; i < (int)n; i++) {
    if (i == 5001) gg_statistics_series_open_window(&s);
    double row[2] = {gg_common_rng_normal(&r), i};
    gg_statistics_series_add(&s, i, row);
    if (i >= 5001) sum += row[0], in_window++;
  }
  assert_true(s.per_row == 4 && s.pending == 3); /* the checkpoint has a part of a row */
  double mean = 0;
  for (size_t i = s.window; i < s.n; i++) mean += gg_series_row(&s, i)[0];
  mean /= (double)gg_series_window_rows(&s);
  assert_true(fabs(mean - sum / in_window) <
              5e-4); /* up to 3 samples where the window opens and 3 pending are left out */
  assert_true(gg_series_row(&s, s.window)[1] >= 5001); /* no row mixes warm-up into the window */
  gg_archive a = {0};
  assert_int_equal(gg_statistics_series_save(&s, &a, NULL), GG_OK);
  assert_int_equal(gg_statistics_series_init(&t, 2, NULL), GG_OK);
  assert_int_equal(gg_statistics_series_restore(&t, &a, NULL), GG_OK);
  for (int i = 0; i < 10; i++) {
    double row[2] = {i, i};
    gg_statistics_series_add(&s, n + i, row), gg_statistics_series_add(&t, n + i, row);
  }
  assert_int_equal(s.n, t.n);
  assert_memory_equal(s.rows, t.rows, s.n * 2 * sizeof(double));
  gg_base_archive_clear(&a), gg_statistics_series_clear(&s), gg_statistics_series_clear(&t);
}

/* Invalid numbers from a file are rejected: they would lead to indices out of range, or to endless loops. */
static void made_to_harm(void **state)
{
  (void)state;
  const uint64_t heads[][5] = {{2, GG_SERIES_ROWS, 1, 0, 0},
                               {2, 3, 0, 0, 0},
                               {2, 3, 3, 0, 0},
                               {2, 3, 4, 4, 0},
                               {2, 3, 1, 0, 5},
                               {3, 3, 1, 0, 0},
                               {2, 3, UINT64_C(1) << 63, 0, 0}};
  for (size_t k = 0; k < sizeof heads / sizeof *heads; k++) {
    gg_series s;
    gg_archive a = {0};
    const size_t n = heads[k][1];
    double *rows = calloc(2 * n, sizeof *rows), partial[2] = {0};
    assert_int_equal(gg_statistics_series_init(&s, 2, NULL), GG_OK);
    assert_int_equal(gg_base_archive_put(&a, "series/head", GG_ITEM_U64, heads[k], 5, NULL), GG_OK);
    assert_int_equal(gg_base_archive_put(&a, "series/rows", GG_ITEM_F64, rows, 2 * n, NULL), GG_OK);
    assert_int_equal(gg_base_archive_put(&a, "series/end_time", GG_ITEM_F64, rows, n, NULL), GG_OK);
    assert_int_equal(gg_base_archive_put(&a, "series/partial", GG_ITEM_F64, partial, 2, NULL), GG_OK);
    assert_int_equal(gg_statistics_series_restore(&s, &a, NULL), GG_BAD_FILE);
    gg_base_archive_clear(&a), gg_statistics_series_clear(&s);
    free(rows);
  }
}

/* Coarsened rows are means of neighbours; the window still begins after the rows before it. */
static void coarsened_rows_are_means_of_neighbours(void **state)
{
  (void)state;
  gg_series s;
  assert_int_equal(gg_statistics_series_init(&s, 1, NULL), GG_OK);
  for (int i = 0; i < 11; i++) {
    if (i == 3) gg_statistics_series_open_window(&s);
    gg_statistics_series_add(&s, i + 1, &(double){i});
  }
  gg_statistics_series_coarsen(&s, 2);
  assert_true(s.n == 5 && s.per_row == 2 && s.window == 2);
  for (size_t i = 0; i < 5; i++)
    assert_true(gg_series_row(&s, i)[0] == 2 * (double)i + 0.5 && s.end_time[i] == 2 * (double)i + 2);
  gg_statistics_series_clear(&s);
}

/* A part of a row from before the window is not in its first row. */
static void window_begins_with_a_row(void **state)
{
  (void)state;
  gg_series s;
  assert_int_equal(gg_statistics_series_init(&s, 1, NULL), GG_OK);
  gg_statistics_series_coarsen(&s, 4);
  for (int i = 0; i < 6; i++) gg_statistics_series_add(&s, i + 1, &(double){100});
  gg_statistics_series_open_window(&s);
  for (int i = 0; i < 7; i++) gg_statistics_series_add(&s, i + 7, &(double){i});
  assert_true(s.n == 2 && s.window == 1 && s.pending == 3);
  assert_true(gg_series_row(&s, 1)[0] == 1.5 && s.end_time[1] == 10);
  gg_statistics_series_clear(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(long_series),
                                     cmocka_unit_test(coarsened_rows_are_means_of_neighbours),
                                     cmocka_unit_test(window_begins_with_a_row), cmocka_unit_test(made_to_harm)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
