/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CSV: cells are quoted where RFC 4180 says so, numbers read back to the last bit, what is none is an empty cell, and a
 * text longer than the buffer arrives whole. Extended XYZ: a frame known beforehand, grains in the leaning cell. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/file_writer.h"
#include "files/export.h"

typedef struct paper {
  gg_atomic_file file;
  gg_file_writer out;
  char text[1 << 18];
} paper;

/* Written to a file without a name. */
static int begin(void **state)
{
  char name[] = "/tmp/graingas-export-XXXXXX";
  paper *p = calloc(1, sizeof *p);
  p->file = GG_ATOMIC_NONE;
  p->file.fd = mkstemp(name);
  unlink(name);
  gg_io_file_writer_begin(&p->out, &p->file, NULL);
  *state = p;
  return p->file.fd < 0;
}

static int end(void **state)
{
  paper *p = *state;
  close(p->file.fd);
  free(p);
  return 0;
}

static const char *written(paper *p)
{
  assert_int_equal(gg_io_file_writer_end(&p->out), GG_OK);
  ssize_t n = pread(p->file.fd, p->text, sizeof p->text - 1, 0);
  assert_true(n >= 0);
  p->text[n] = '\0';
  return p->text;
}

static void csv_quotes_what_needs_quotes(void **state)
{
  paper *p = *state;
  gg_csv csv = {.out = &p->out};
  gg_io_csv_text(&csv, "plain text");
  gg_io_csv_text(&csv, "a, b");
  gg_io_csv_text(&csv, "so \"called\"");
  gg_io_csv_text(&csv, NULL);
  gg_io_csv_text(&csv, "two\nlines");
  gg_io_csv_end_row(&csv);
  gg_io_csv_head(&csv, "T", "d^2 gamma^2");
  gg_io_csv_head(&csv, "e", "1");
  gg_io_csv_head(&csv, "n", "");
  gg_io_csv_end_row(&csv);
  assert_string_equal(written(p),
                      "plain text,\"a, b\",\"so \"\"called\"\"\",,\"two\nlines\"\r\nT [d^2 gamma^2],e,n\r\n");
}

static void csv_writes_json_values(void **state)
{
  paper *p = *state;
  gg_csv csv = {.out = &p->out};
  json_t *list = json_pack("[f, i, b, b, s, n]", 0.1, 12000000, 1, 0, "why", 0);
  for (size_t i = 0; i <= json_array_size(list); i++)
    gg_io_csv_json(&csv, json_array_get(list, i)); /* one is not there */
  gg_io_csv_end_row(&csv);
  json_decref(list);
  assert_string_equal(written(p), "0.1,12000000,true,false,why,,\r\n");
}

static void csv_numbers_are_read_back_to_the_last_bit(void **state)
{
  const double hard[] = {0.1, 1.0 / 3, 0.1 + 0.2, 1e-310, -1.7976931348623157e308, 1.2345678901234567e17,
                         0,   -0.0,    5e-324};
  char text[GG_NUMBER_TEXT];
  (void)state;
  for (size_t i = 0; i < sizeof hard / sizeof *hard; i++) {
    gg_io_number_format(hard[i], text);
    double back = strtod(text, NULL);
    assert_memory_equal(&back, &hard[i], sizeof back);
  }
  gg_io_number_format(0.1, text);
  assert_string_equal(text, "0.1");
}

static void longer_than_the_buffer(void **state)
{
  paper *p = *state;
  char line[1000];
  memset(line, 'x', sizeof line);
  line[sizeof line - 1] = '\0';
  for (int i = 0; i < 100; i++) gg_io_file_writer_put(&p->out, line);
  assert_int_equal(strspn(written(p), "x"), 100 * (sizeof line - 1));
}

static void failure_sticks(void **state)
{
  paper *p = *state;
  gg_error err = {.status = GG_OK};
  int fd = p->file.fd;
  char path[] = "full";
  p->file.path = path, p->file.fd = open("/dev/full", O_WRONLY);
  if (p->file.fd < 0) skip();
  p->out.err = &err;
  gg_io_file_writer_put(&p->out, "something");
  assert_int_equal(gg_io_file_writer_end(&p->out), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "full: cannot be written"));
  close(p->file.fd);
  p->file.fd = fd; /* there would be room again, but the text has a gap */
  gg_io_file_writer_put(&p->out, "more");
  assert_int_equal(gg_io_file_writer_end(&p->out), GG_BAD_FILE);
  p->out.status = GG_OK;
  assert_string_equal(written(p), "");
}

/* A cell of 10 by 4 by 8 that leans by 3: at half its height it begins at 1.5. */
static void a_frame(void **state)
{
  paper *p = *state;
  double position[] = {1, 2, 3, 9, 0, 1}, velocity[] = {1, 2, 3, -1, -2, -3}, spin[] = {0, 0, 0.5, 0, 0, -0.5};
  double diameter[] = {1, 1.5}, mass[] = {1, 2};
  uint8_t species[] = {0, 1};
  char length[] = "d", speed[] = "d gamma", rate[] = "gamma", time[] = "1/gamma";
  const double edges[9] = {10, 0, 0, 3, 4, 0, 0, 0, 8};
  gg_stored_trajectory t = {.n = 2,
                            .n_frames = 1,
                            .periodic = {true, false, true},
                            .shear_rate = 1,
                            .species = species,
                            .diameter = diameter,
                            .mass = mass,
                            .length_unit = length,
                            .velocity_unit = speed,
                            .spin_unit = rate,
                            .time_unit = time};
  gg_frame f = {.n = 2, .time = 0.75, .step = 12, .position = position, .velocity = velocity, .spin = spin};
  gg_files_xyz_frame(&p->out, &t, &f, edges);
  assert_string_equal(written(p), "2\nLattice=\"10 0 0 3 4 0 0 0 8\" "
                                  "Properties=species:S:1:pos:R:3:velo:R:3:omega:R:3:radius:R:1:mass:R:1:momenta:R:3:"
                                  "masses:R:1:id:I:1 pbc=\"T F T\" "
                                  "Time=0.75 collisions=12 shear_rate=1 length_unit=\"d\" velocity_unit=\"d gamma\" "
                                  "omega_unit=\"gamma\" time_unit=\"1/gamma\"\n"
                                  "H 11 2 3 1 2 3 0 0 0.5 0.5 1 1 2 3 1 0\n"
                                  "He 9 0 1 -1 -2 -3 0 0 -0.5 0.75 2 -2 -4 -6 2 1\n");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(csv_quotes_what_needs_quotes, begin, end),
      cmocka_unit_test_setup_teardown(csv_writes_json_values, begin, end),
      cmocka_unit_test(csv_numbers_are_read_back_to_the_last_bit),
      cmocka_unit_test_setup_teardown(longer_than_the_buffer, begin, end),
      cmocka_unit_test_setup_teardown(failure_sticks, begin, end),
      cmocka_unit_test_setup_teardown(a_frame, begin, end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
