/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5 crashes or ends the program where some of its allocations fail. So each function of the writer reserves memory
 * before it calls HDF5: without memory it makes one allocation, which fails, and the file has an error instead. The
 * reservation notices the limit of a shell (ulimit -v), too. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../faults/failing_malloc.h"
#include "base/memory.h"
#include "files/h5/hdf5_writer.h"

static gg_h5_rows rows;
static const double numbers[4] = {1, 2, 3, 4};
static const hsize_t two_by_two[2] = {2, 2};
static const char *const texts[2] = {"one", "another"};

static void write_text(gg_h5 *h)
{
  gg_h5_text(h, "/a/text", "some");
}
static void write_texts(gg_h5 *h)
{
  gg_h5_texts(h, "/a/texts", texts, 2);
}
static void write_number(gg_h5 *h)
{
  gg_h5_number(h, "/a/number", 1, "d");
}
static void write_count(gg_h5 *h)
{
  gg_h5_count(h, "/a/count", 1);
}
static void write_array(gg_h5 *h)
{
  gg_h5_array(h, "/a/array", H5T_NATIVE_DOUBLE, 2, two_by_two, numbers);
}
static void write_numbers(gg_h5 *h)
{
  gg_h5_numbers(h, "/a/numbers", numbers, 4, "d");
}
static void write_group(gg_h5 *h)
{
  gg_h5_group(h, "/a/group");
}
static void write_link(gg_h5 *h)
{
  gg_h5_link(h, "/there", "/a/link");
}
static void write_text_attribute(gg_h5 *h)
{
  gg_h5_text_attribute(h, "/there", "text", "some");
}
static void write_texts_attribute(gg_h5 *h)
{
  gg_h5_texts_attribute(h, "/there", "texts", texts, 2);
}
static void write_attribute(gg_h5 *h)
{
  gg_h5_attribute(h, "/there", "ints", H5T_NATIVE_INT, (const int[]){1, 2}, 2);
}
static void create_rows(gg_h5 *h)
{
  gg_h5_rows more;
  gg_h5_rows_create(h, &more, "/a/rows", H5T_NATIVE_DOUBLE, 2, two_by_two);
  gg_h5_rows_close(h, &more);
}
static void append_row(gg_h5 *h)
{
  gg_h5_rows_append(h, &rows, numbers);
}
static void read_row(gg_h5 *h)
{
  double row[4];
  gg_h5_rows_read(h, &rows, 0, row);
}
static void drop_row(gg_h5 *h)
{
  gg_h5_rows_drop(h, &rows, 1);
}
static void make_image(gg_h5 *h)
{
  size_t size;
  free(gg_h5_image(h, &size));
}

static void (*const calls[])(gg_h5 *) = {
    write_text, write_texts, write_number,         write_count,           write_array, write_numbers,   write_group,
    write_link, create_rows, write_text_attribute, write_texts_attribute, append_row,  write_attribute, read_row,
    drop_row,   make_image};

/* A file with something in it, so that HDF5 is in use; HDF5 keeps no blocks for later. */
static void begin(gg_h5 *h)
{
  gg_h5_create(h, NULL);
  gg_h5_number(h, "/there", 1, NULL);
  gg_h5_rows_create(h, &rows, "/rows", H5T_NATIVE_DOUBLE, 2, two_by_two);
  gg_h5_rows_append(h, &rows, numbers);
  assert_false(h->failed);
  assert_true(H5garbage_collect() >= 0);
}

static void end(gg_h5 *h, bool lacked)
{
  gg_error err = {0};
  gg_h5_rows_close(h, &rows);
  gg_h5_close(h);
  assert_int_equal(gg_h5_status(h, "it", "written", &err), lacked ? GG_BAD_FILE : GG_OK);
  if (lacked) assert_string_equal(err.message, "it: cannot be written: out of memory");
}

static void without_memory_hdf5_is_not_called(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof calls / sizeof *calls; k++) {
    gg_h5 h;
    uint64_t faults;
    begin(&h);
    failing_malloc_arm(1, true, NULL);
    calls[k](&h);
    failing_malloc_disarm(&faults);
    assert_int_equal(faults, 1);
    end(&h, true);
  }
  gg_h5 h;
  failing_malloc_arm(1, true, NULL);
  gg_h5_create(&h, NULL);
  gg_h5_close(&h);
  failing_malloc_disarm(NULL);
  assert_true(h.failed);
}

static void with_memory_all_is_written(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof calls / sizeof *calls; k++) {
    gg_h5 h;
    begin(&h);
    calls[k](&h);
    end(&h, false);
  }
}

/* In a process of its own: a limit half of what is reserved above what is in use. */
static void the_limit_of_a_shell_counts(void **state)
{
  (void)state;
  assert_true(gg_base_memory_is_room());
  const pid_t child = fork();
  if (child == 0) {
    size_t pages = 0;
    FILE *in = fopen("/proc/self/statm", "r");
    if (!in || fscanf(in, "%zu", &pages) != 1) _exit(2);
    fclose(in);
    const rlim_t most = pages * (size_t)getpagesize() + (2 << 20);
    if (setrlimit(RLIMIT_AS, &(struct rlimit){most, most}) != 0) _exit(3);
    _exit(gg_base_memory_is_room());
  }
  int status;
  waitpid(child, &status, 0);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(with_memory_all_is_written),
                                     cmocka_unit_test(without_memory_hdf5_is_not_called),
                                     cmocka_unit_test(the_limit_of_a_shell_counts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
