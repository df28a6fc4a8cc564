/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results, comparisons and simulations as bytes in memory: no file is written, and what comes back is the same. */
#include "api_test.h"

/* Cut off, changed, or something else: refused with the reason, at every length tried and with any bit turned. */
#define assert_damaged_refused(from_bytes, bytes, size)                                                                \
  do {                                                                                                                 \
    unsigned char *copy = malloc(size);                                                                                \
    assert_non_null(copy);                                                                                             \
    for (size_t cut = 0; cut < size; cut += 1 + size / 50) {                                                           \
      memcpy(copy, bytes, size);                                                                                       \
      const size_t length = cut;                                                                                       \
      assert_int_equal(from_bytes, GG_BAD_FILE);                                                                       \
      assert_non_null(strstr(err.message, "the bytes: cannot be read"));                                               \
    }                                                                                                                  \
    for (size_t at = 0; at < size; at += 1 + size / 50) {                                                              \
      memcpy(copy, bytes, size);                                                                                       \
      copy[at] ^= 4;                                                                                                   \
      const size_t length = size;                                                                                      \
      assert_int_equal(from_bytes, GG_BAD_FILE);                                                                       \
    }                                                                                                                  \
    free(copy);                                                                                                        \
  } while (0)

static void bytes_of_a_result_restore_it(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 300}}");
  gg_result *r = NULL, *back = NULL, *none = NULL;
  void *bytes = NULL;
  size_t size = 0;
  char *here, *there;
  assert_ok(gg_run(s, NULL, &r, &err));
  assert_ok(gg_result_to_bytes(r, &bytes, &size, &err));
  assert_ok(gg_result_from_bytes(bytes, size, &back, &err));
  assert_ok(gg_result_to_json(r, &here, &err));
  assert_ok(gg_result_to_json(back, &there, &err));
  assert_string_equal(here, there);
  double one[300], other[300], covariance[2];
  assert_ok(gg_result_grains(r, &(gg_grains){.velocity = one}, &err));
  assert_ok(gg_result_grains(back, &(gg_grains){.velocity = other}, &err));
  assert_memory_equal(one, other, sizeof one);
  assert_ok(gg_result_covariance(r, "P_xy", "N1", &covariance[0], &err));
  assert_ok(gg_result_covariance(back, "P_xy", "N1", &covariance[1], &err));
  assert_true(covariance[0] == covariance[1]);
  assert_damaged_refused(gg_result_from_bytes(copy, length, &none, &err), bytes, size);
  assert_refused(gg_result_from_bytes(NULL, 0, &none, &err), "bytes");
  assert_refused(gg_result_to_bytes(r, NULL, &size, &err), "bytes");
  assert_null(none);
  free(here);
  free(there);
  free(bytes);
  gg_result_free(r);
  gg_result_free(back);
  gg_scene_free(s);
}

static void bytes_of_a_comparison_restore_it(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.05, particles: 100, collision: {beta: 0}, run: {collisions: 300}}");
  gg_comparison *c = NULL, *back = NULL;
  gg_result *one = NULL;
  void *bytes = NULL;
  size_t size = 0;
  char *here, *there;
  gg_status status = gg_compare(s, NULL, &c, &err);
  assert_true(status == GG_OK || status == GG_FAILED);
  assert_ok(gg_comparison_to_bytes(c, &bytes, &size, &err));
  assert_ok(gg_comparison_from_bytes(bytes, size, &back, &err));
  assert_ok(gg_comparison_to_json(c, &here, &err));
  assert_ok(gg_comparison_to_json(back, &there, &err));
  assert_string_equal(here, there);
  assert_refused(gg_result_from_bytes(bytes, size, &one, &err), "comparison");
  assert_damaged_refused(gg_comparison_from_bytes(copy, length, &c, &err), bytes, size);
  free(here);
  free(there);
  free(bytes);
  gg_comparison_free(c);
  gg_comparison_free(back);
  gg_scene_free(s);
}

/* A simulation continues with the same bits from its bytes and from those of its file. */
static void bytes_of_a_simulation_continue_with_the_same_bits(void **state)
{
  (void)state;
  gg_error err;
  gg_scene *s = scene_of("{flow: usf, phi: 0.1, particles: 100}");
  gg_simulation *m = NULL, *back = NULL, *again = NULL, *none = NULL;
  void *bytes = NULL;
  size_t size = 0, file_size = 0;
  assert_ok(gg_simulation_new(s, NULL, &m, &err));
  assert_ok(gg_simulation_collide(m, 500, &err));
  assert_ok(gg_simulation_to_bytes(m, NULL, NULL, &bytes, &size, &err));
  assert_ok(gg_simulation_save(m, "t_saved.h5", NULL, NULL, &err));
  static unsigned char file[1 << 20];
  FILE *in = fopen("t_saved.h5", "rb");
  assert_non_null(in);
  file_size = fread(file, 1, sizeof file, in);
  fclose(in);
  assert_ok(gg_simulation_from_bytes(bytes, size, NULL, NULL, NULL, &back, &err));
  assert_ok(gg_simulation_from_bytes(file, file_size, s, NULL, NULL, &again, &err));
  double v[3][300];
  gg_simulation *const all[] = {m, back, again};
  for (int k = 0; k < 3; k++) {
    assert_ok(gg_simulation_collide(all[k], 500, &err));
    assert_ok(gg_simulation_get_grains(all[k], &(gg_grains){.velocity = v[k]}, &err));
    assert_memory_equal(v[k], v[0], sizeof v[0]);
  }
  gg_scene *denser = scene_of("{flow: usf, phi: 0.2, particles: 100}");
  assert_refused(gg_simulation_from_bytes(bytes, size, denser, NULL, NULL, &none, &err), "phi");
  assert_damaged_refused(gg_simulation_from_bytes(copy, length, NULL, NULL, NULL, &none, &err), bytes, size);
  assert_null(none);
  free(bytes);
  for (int k = 0; k < 3; k++) gg_simulation_free(all[k]);
  gg_scene_free(s);
  gg_scene_free(denser);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(bytes_of_a_result_restore_it),
                                     cmocka_unit_test(bytes_of_a_comparison_restore_it),
                                     cmocka_unit_test(bytes_of_a_simulation_continue_with_the_same_bits)};
  return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
