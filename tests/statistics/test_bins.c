/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of bins are joined without loss, and restored from a checkpoint unchanged. */
#include <string.h>

#include "planted.h"
#include "statistics/bins.h"

enum { WIDTH = 3 };

static void add(gg_bins *b, gg_rng *r)
{
  double *bin = gg_statistics_bins_sample(b);
  for (int k = 0; k < WIDTH; k++) bin[k] += gg_common_rng_normal(r);
  gg_statistics_bins_commit(b);
}

/* Every sample counts once, however often blocks are joined; the number of blocks stays between 16 and 32. */
static void joined_blocks(void **state)
{
  (void)state;
  gg_bins b;
  assert_int_equal(gg_statistics_bins_init(&b, 1, NULL), GG_OK);
  for (int k = 0; k < 5000; k++) {
    *gg_statistics_bins_sample(&b) += 1;
    gg_statistics_bins_commit(&b);
    double sum = 0;
    for (size_t i = 0; i <= b.blocks; i++) sum += *gg_bins_block(&b, i);
    assert_true(sum == k + 1);
    for (size_t i = 0; i < b.blocks; i++) assert_true(*gg_bins_block(&b, i) == (double)b.per_block);
    if (k >= 16) assert_true(b.blocks >= 16 && b.blocks < 32);
  }
  gg_statistics_bins_restart(&b);
  assert_true(b.blocks == 0 && b.pending == 0 && *gg_bins_block(&b, 0) == 0);
  gg_statistics_bins_clear(&b);
}

/* Coarsened blocks are those of a longer window; only the incomplete last block is lost. */
static void coarsened_blocks_are_those_of_a_longer_window(void **state)
{
  (void)state;
  gg_bins b;
  assert_int_equal(gg_statistics_bins_init(&b, 1, NULL), GG_OK);
  for (int k = 0; k < 23; k++) *gg_statistics_bins_sample(&b) += k, gg_statistics_bins_commit(&b);
  gg_statistics_bins_coarsen(&b, 1);
  assert_int_equal(b.blocks, 23);
  gg_statistics_bins_coarsen(&b, 4);
  assert_true(b.blocks == 5 && b.per_block == 4 && b.pending == 0);
  for (int i = 0; i < 5; i++) assert_true(*gg_bins_block(&b, (size_t)i) == 16 * i + 6);
  assert_true(*gg_bins_block(&b, 5) == 0);
  gg_statistics_bins_clear(&b);
}

/* Bins that are saved and restored in the middle of a block continue without a difference. */
static void restored_bins_continue_without_a_difference(void **state)
{
  (void)state;
  gg_bins a, b;
  gg_archive archive = {0};
  gg_rng r = gg_common_rng_seed(7, 0), again;
  assert_int_equal(gg_statistics_bins_init(&a, WIDTH, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_init(&b, WIDTH, NULL), GG_OK);
  for (int i = 0; i < 77; i++) add(&a, &r);
  assert_int_equal(gg_statistics_bins_save(&a, "x", &archive, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_restore(&b, "x", &archive, NULL), GG_OK);
  again = r;
  for (int i = 0; i < 100; i++) add(&a, &r), add(&b, &again);
  assert_true(a.blocks == b.blocks && a.pending == b.pending);
  assert_memory_equal(a.sum, b.sum, (a.blocks + 1) * WIDTH * sizeof(double));
  gg_base_archive_clear(&archive);
  gg_statistics_bins_clear(&a);
  gg_statistics_bins_clear(&b);
}

/* Bins of another width, or of another name, are rejected. */
static void other_bins(void **state)
{
  (void)state;
  gg_bins a, b;
  gg_archive archive = {0};
  gg_error err;
  assert_int_equal(gg_statistics_bins_init(&a, WIDTH, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_init(&b, WIDTH + 1, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_save(&a, "x", &archive, NULL), GG_OK);
  assert_int_equal(gg_statistics_bins_restore(&b, "x", &archive, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "other bins"));
  assert_int_equal(gg_statistics_bins_restore(&a, "y", &archive, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "bins/y.head"));
  gg_base_archive_clear(&archive);
  gg_statistics_bins_clear(&a);
  gg_statistics_bins_clear(&b);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(joined_blocks), cmocka_unit_test(coarsened_blocks_are_those_of_a_longer_window),
      cmocka_unit_test(restored_bins_continue_without_a_difference), cmocka_unit_test(other_bins)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
