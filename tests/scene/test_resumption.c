/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run is resumed with the scene that it began with: every key of the field table that does not say otherwise is
 * refused when it differs, by name and with both values, and whole numbers are told apart to the last digit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "scene/fields.h"
#include "scene/scene_reader.h"

static gg_scene scene_of(void)
{
  gg_scene s = gg_scene_defaults();
  s.phi = 0.1;
  return s;
}

static gg_status resume(const gg_scene *before, const gg_scene *now, gg_error *err)
{
  gg_archive a = {0};
  assert_int_equal(gg_scene_resumption_put(before, &a, err), GG_OK);
  gg_status status = gg_scene_resumption_check(now, &a, err);
  gg_base_archive_clear(&a);
  return status;
}

/* Another value than the one that is there, whatever the key holds. */
static void change(const gg_field *f, gg_scene *s)
{
  char *at = (char *)s + f->offset;
  double x;
  int64_t n;
  int word;
  switch (f->type) {
  case GG_FIELD_INTEGER:
    memcpy(&n, at, sizeof n);
    n++;
    memcpy(at, &n, sizeof n);
    return;
  case GG_FIELD_CHOICE:
    memcpy(&word, at, sizeof word);
    word = gg_scene_field_word(f, gg_scene_field_word(f, 0).value == word).value;
    memcpy(at, &word, sizeof word);
    return;
  case GG_FIELD_SET:
    memcpy(&word, at, sizeof word);
    word ^= gg_scene_field_word(f, 1).value;
    memcpy(at, &word, sizeof word);
    return;
  case GG_FIELD_FILE: *at = *at == 'x' ? 'y' : 'x'; return;
  default: /* numbers: the last of three, of pairs the first; of a species its fraction */
    if (f->type == GG_FIELD_VECTOR) at += 2 * sizeof x;
    memcpy(&x, at, sizeof x);
    x = x == 0.25 ? 0.5 : 0.25;
    memcpy(at, &x, sizeof x);
  }
}

static void every_key(void **state)
{
  (void)state;
  int free_to_change = 0;
  for (const gg_field *f = gg_scene_fields; f->key; f++) {
    gg_error err = {0};
    gg_scene before = scene_of(), now = before;
    assert_int_equal(resume(&before, &now, &err), GG_OK);
    change(f, &now);
    gg_status status = resume(&before, &now, &err);
    free_to_change += f->may_change;
    if (f->may_change ? status == GG_OK : status == GG_BAD_INPUT && strstr(err.message, f->key)) continue;
    fail_msg("%s: status %d, '%s'", f->key, status, err.message);
  }
  assert_int_equal(free_to_change, 10); /* four stop rules, six of the output */
}

static void refused(const gg_scene *before, const gg_scene *now, const char *expected)
{
  gg_error err = {0};
  assert_int_equal(resume(before, now, &err), GG_BAD_INPUT);
  if (!strstr(err.message, expected)) fail_msg("'%s' is not in '%s'", expected, err.message);
}

/* Spellings of one value are one value. */
static void other_spellings(void **state)
{
  static const char *const pairs[][3] = {
      {"shear_rate", "2", "2.0"},
      {"gravity", "[0, -1, 0]", "[-0.0, -1e0, 0.00]"},
      {"collision.mu", "inf", ".inf"},
      {"run.seed", "1000", "1e3"},
      {"protocol", "[{at: 5, shear_rate: 2}]", "[{at: 5.0, shear_rate: 2.0}]"},
      {"protocol", "[{at: 5, collision.e: 0.5}]", "[{at: 5e0, collision.e: +.50}]"},
      {"protocol", "[{at: 5, collision.mu.12: inf}]", "[{at: 5, collision.mu.12: .inf}]"},
      {"protocol", "[{at: 5, thermostat: bath}]", "[{thermostat: \"bath\", at: 5}]"},
  };
  (void)state;
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
    gg_error err = {0};
    gg_scene before = scene_of(), now = before;
    assert_int_equal(gg_scene_override(&before, pairs[i][0], pairs[i][1], &err), GG_OK);
    if (gg_scene_override(&now, pairs[i][0], pairs[i][2], &err) != GG_OK) fail_msg("%s", err.message);
    if (resume(&before, &now, &err) != GG_OK) fail_msg("%s: %s", pairs[i][2], err.message);
    assert_memory_equal(&before, &now, sizeof now);
  }
}

static void both_values(void **state)
{
  (void)state;
  gg_scene before = scene_of(), now = before;
  before.run.seed = ((uint64_t)1 << 53) + 1, now.run.seed = (uint64_t)1 << 53;
  refused(&before, &now, "run.seed differs (there 9007199254740993, here 9007199254740992)");
  before = now, now.phi = 0.1 + 0x1p-56; /* the next number */
  refused(&before, &now, "phi differs (there 0.1, here 0.10000000000000002)");
  now = before, now.aspect[1] = 2;
  refused(&before, &now, "aspect differs (there 1, 1, 1, here 1, 2, 1)");
  now = before, now.collision.mu[0] = 0.5;
  refused(&before, &now, "collision.mu differs (there inf, here 0.5)");
  now = before, now.start.temperature = 2;
  refused(&before, &now, "temperature differs (there auto, here 2)");
  now = before, strcpy(before.start.positions, "/here/a.xyz"), strcpy(now.start.positions, "/here/b.xyz");
  refused(&before, &now, "start.positions differs (there \"/here/a.xyz\", here \"/here/b.xyz\")");
  strcpy(now.start.positions, "/moved/a.xyz");
  assert_int_equal(resume(&before, &now, NULL), GG_OK);
  *before.start.positions = '\0', now = before, now.measure |= GG_MEASURE_CELLS;
  refused(&before, &now, "measure differs (there rheology, here rheology, cells)");
  now = before, now.n_species = 2;
  refused(&before, &now, "species differs (there 1, here 2)");
  before.n_species = 2, now = before, now.species[1].mass = 4;
  refused(&before, &now, "species.2.mass differs (there 1, here 4)");
  now = before, now.collision.e[gg_pair(0, 1)] = 0.8;
  refused(&before, &now,
          "collision.e.12 differs (there 0.9, here 0.8); only run.relative_error, run.until, run.collisions, "
          "run.time_limit, output.checkpoint_every, output.trajectory_every, output.after, "
          "output.fields, output.precision, output.log may change");
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_key), cmocka_unit_test(other_spellings),
                                     cmocka_unit_test(both_values)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
