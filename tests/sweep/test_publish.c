/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result of a point gets its name without an allocation, so also without memory; a result that cannot be renamed is
 * removed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../faults/failing_malloc.h"
#include "sweep/folder.h"

enum { POINT = 0xabc };
static const char work[] = "0000000000000abc.work.h5";

static void fill(void)
{
  FILE *f = fopen(work, "w");
  assert_non_null(f);
  fclose(f);
}

static int enter(void **state)
{
  static char folder[] = "/tmp/publish-XXXXXX";
  (void)state;
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  char folder[64];
  (void)state;
  return getcwd(folder, sizeof folder) && chdir("/") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

static void without_memory(void **state)
{
  static const char *const names[] = {"0000000000000abc.h5", "0000000000000abc.short.h5"};
  (void)state;
  for (int fell_short = 0; fell_short < 2; fell_short++) {
    gg_error err;
    fill();
    failing_malloc_arm(1, 1, NULL);
    gg_status status = gg_sweep_point_publish(".", POINT, fell_short, &err);
    failing_malloc_disarm(NULL);
    assert_int_equal(status, GG_OK);
    assert_int_equal(access(work, F_OK), -1);
    assert_int_equal(unlink(names[fell_short]), 0);
  }
}

/* Something else has the name: the only copy stays. */
static void a_folder_of_the_same_name_keeps_the_only_copy(void **state)
{
  (void)state;
  gg_error err;
  fill();
  assert_int_equal(mkdir("0000000000000abc.h5", 0777), 0);
  assert_int_equal(gg_sweep_point_publish(".", POINT, false, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, "./0000000000000abc.h5: cannot be written: "));
  assert_int_equal(unlink(work), 0);
  assert_int_equal(rmdir("0000000000000abc.h5"), 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(without_memory),
                                     cmocka_unit_test(a_folder_of_the_same_name_keeps_the_only_copy)};
  return cmocka_run_group_tests(tests, enter, leave);
}
