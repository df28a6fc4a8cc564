/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every member of a row of a sweep's table has its own column in the CSV and the HDF5 file; all values differ. The list
 * below names every member, and the test fails if a row gets another one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "files/h5/hdf5_reader.h"
#include "files/h5/hdf5_writer.h"
#include "graingas.h"
#include "sweep/sweep_table.h"

typedef enum kind { NUMBER, WHOLE, TRUTH, TEXT, NAME } kind;

static const struct member {
  const char *column; /* NULL: none of its own */
  size_t offset, size, alignment;
  kind kind;
} members[] = {
#define MEMBER(member, name, what)                                                                                     \
  {                                                                                                                    \
    .column = name, .offset = offsetof(gg_point_row, member), .size = sizeof((gg_point_row *)0)->member,               \
    .alignment = _Alignof(__typeof__(((gg_point_row *)0)->member)), .kind = what                                       \
  }
    MEMBER(point, "point", WHOLE),
    MEMBER(file, "file", NAME),
    MEMBER(method, "method", TEXT),
    MEMBER(quantity, "quantity", TEXT),
    MEMBER(unit, "unit", TEXT),
    MEMBER(version, "version", TEXT),
    MEMBER(build, "build", TEXT),
    MEMBER(mean, "mean", NUMBER),
    MEMBER(error, "error", NUMBER),
    MEMBER(theory, NULL, TRUTH), /* the method says it */
    MEMBER(steady, "steady", TRUTH),
    MEMBER(fell_short, "short", TRUTH),
    MEMBER(seconds, "seconds", NUMBER),
    MEMBER(seed, "seed", WHOLE),
    MEMBER(reference, "reference", TEXT),
    MEMBER(reference_mean, "reference_mean", NUMBER),
    MEMBER(difference, "difference", NUMBER),
    MEMBER(difference_error, "difference_error", NUMBER),
    MEMBER(deviation, "deviation", NUMBER),
    MEMBER(deviation_error, "deviation_error", NUMBER),
    MEMBER(z, "z", NUMBER),
    MEMBER(beyond, "beyond_expected", TRUTH),
    MEMBER(cause, "cause", TEXT),
    MEMBER(structure, "structure", TEXT),
    MEMBER(contact_time, "contact_time", NUMBER),
};
enum { MEMBERS = sizeof members / sizeof *members, ROWS = 4 };

static gg_point_row rows[ROWS];
static char texts[ROWS][MEMBERS][24];
static gg_sweep *sweep;

/* Text in the column of a member. */
static void plant(size_t i, size_t m, size_t truth)
{
  char *at = (char *)&rows[i] + members[m].offset, *text = texts[i][m];
  const double number = (double)(100 * i + m) + 0.25;
  switch (members[m].kind) {
  case NUMBER: *(double *)at = number; break;
  case WHOLE: *(uint64_t *)at = 1000 * (uint64_t)(i + 1) + m; break;
  case TRUTH: *(bool *)at = truth == i; break; /* in each row another one alone */
  case TEXT: *(const char **)at = text; break;
  case NAME: break;
  }
  if (members[m].offset == 0) *(size_t *)at = i; /* a point of the sweep; columns count from 1 */
  snprintf(text, sizeof texts[i][m], "text_%zu_%zu", i, m);
  if (members[m].kind == NAME) snprintf(at, members[m].size, "%.*s", (int)members[m].size - 1, text);
  if (members[m].kind == NUMBER) snprintf(text, sizeof texts[i][m], "%.17g", number);
  if (members[m].kind == TRUTH) snprintf(text, sizeof texts[i][m], "%s", truth == i ? "true" : "false");
  if (members[m].kind == WHOLE)
    snprintf(text, sizeof texts[i][m], "%zu", members[m].offset ? 1000 * (i + 1) + m : i + 1);
}

static int enter(void **state)
{
  static char folder[] = "/tmp/table-XXXXXX";
  gg_error err = {0};
  (void)state;
  for (size_t i = 0; i < ROWS; i++)
    for (size_t m = 0, truths = 0; m < MEMBERS; m++) plant(i, m, members[m].kind == TRUTH ? truths++ : 0);
  if (gg_sweep_parse("flow: usf\nphi: 0.1\nparticles: 100\nvary: [{collision.e: [0.5, 0.6, 0.7, 0.8]}]\n", "s.yaml",
                     &sweep, &err) != GG_OK ||
      gg_sweep_check(sweep, &err) != GG_OK)
    fail_msg("%s", err.message);
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  char folder[64];
  (void)state;
  gg_sweep_free(sweep);
  return getcwd(folder, sizeof folder) && chdir("/") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

static void members_are_complete(void **state)
{
  (void)state;
  size_t end = 0;
  for (size_t m = 0; m < MEMBERS; end = members[m].offset + members[m].size, m++)
    if (members[m].offset < end || members[m].offset - end >= members[m].alignment)
      fail_msg("there is a member before %s that the list lacks", members[m].column);
  assert_true(sizeof(gg_point_row) - end < sizeof(double));
}

static int column_of(char *head, const char *name)
{
  int at = 0;
  for (char *next, *word = head; word; word = next, at++) {
    next = strchr(word, ',');
    if (next) next++;
    const size_t length = next ? (size_t)(next - word) - 1 : strlen(word);
    if (strlen(name) == length && strncmp(word, name, length) == 0) return at;
  }
  fail_msg("no column %s", name);
  return -1;
}

static const char *cell_of(const char *line, int column, char cell[64])
{
  for (; column > 0; column--) line = strchr(line, ',') + 1;
  snprintf(cell, 64, "%.*s", (int)strcspn(line, ","), line);
  return cell;
}

static void csv_has_every_member_of_the_rows(void **state)
{
  (void)state;
  const gg_point_table table = {.n = ROWS, .row = rows};
  gg_error err = {0};
  char head[1000], line[1000], cell[64], *end;
  if (gg_sweep_point_table_write_csv(&table, sweep, "t.csv", &err) != GG_OK) fail_msg("%s", err.message);
  FILE *in = fopen("t.csv", "r");
  assert_non_null(fgets(head, sizeof head, in));
  head[strcspn(head, "\r\n")] = '\0';
  for (size_t i = 0; i < ROWS; i++) {
    assert_non_null(fgets(line, sizeof line, in));
    line[strcspn(line, "\r\n")] = '\0';
    for (size_t m = 0; m < MEMBERS; m++) {
      if (!members[m].column) continue;
      cell_of(line, column_of(head, members[m].column), cell);
      if (members[m].kind == NUMBER)
        assert_true(strtod(cell, &end) == strtod(texts[i][m], NULL) && !*end);
      else
        assert_string_equal(cell, texts[i][m]);
    }
    assert_true(strtod(cell_of(line, column_of(head, "collision.e"), cell), NULL) == 0.5 + 0.1 * (double)i);
  }
  assert_null(fgets(line, sizeof line, in));
  fclose(in);
  unlink("t.csv");
}

/* Texts of a fixed length, filled up with zeros. */
static void compare_texts(const char *file, const char *path, size_t m)
{
  const hid_t in = H5Fopen(file, H5F_ACC_RDONLY, H5P_DEFAULT), data = H5Dopen2(in, path, H5P_DEFAULT),
              type = H5Dget_type(data);
  const size_t size = H5Tget_size(type);
  char *found = calloc(ROWS, size);
  assert_true(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, found) >= 0);
  for (size_t i = 0; i < ROWS; i++)
    if (strncmp(found + i * size, texts[i][m], size) != 0) fail_msg("%s of row %zu is %s", path, i, found + i * size);
  free(found);
  H5Tclose(type);
  H5Dclose(data);
  H5Fclose(in);
}

static void hdf5_has_every_member_of_the_rows(void **state)
{
  (void)state;
  const gg_point_table table = {.n = ROWS, .row = rows};
  gg_error err = {0};
  gg_h5_in h;
  if (gg_sweep_point_table_write_h5(&table, sweep, "t.h5", "x", &err) != GG_OK) fail_msg("%s", err.message);
  gg_h5_open(&h, "t.h5", false);
  for (size_t m = 0; m < MEMBERS; m++) {
    char path[64];
    size_t n = 0;
    if (!members[m].column) continue;
    snprintf(path, sizeof path, "/graingas/table/%s", members[m].column);
    if (members[m].kind >= TEXT) {
      compare_texts("t.h5", path, m);
      continue;
    }
    double *found = gg_h5_read_array(&h, path, GG_ITEM_F64, &n);
    assert_int_equal(n, ROWS);
    for (size_t i = 0; i < n; i++) {
      const double wanted = members[m].kind == TRUTH ? *texts[i][m] == 't' : strtod(texts[i][m], NULL);
      if (found[i] != wanted) fail_msg("%s of row %zu is %g, not %g", path, i, found[i], wanted);
    }
    free(found);
  }
  gg_h5_in_close(&h);
  unlink("t.h5");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(members_are_complete),
      cmocka_unit_test(csv_has_every_member_of_the_rows),
      cmocka_unit_test(hdf5_has_every_member_of_the_rows),
  };
  H5dont_atexit();
  return cmocka_run_group_tests(tests, enter, leave);
}
