/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gnuplot that hangs is ended after its time, and leaves no picture. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "plot/plot.h"

static char folder[] = "/tmp/graingas-gnuplot-XXXXXX";

/* A program named gnuplot that never ends and writes its process number. */
static int enter(void **state)
{
  (void)state;
  if (!mkdtemp(folder) || chdir(folder) != 0) return -1;
  FILE *program = fopen("gnuplot", "w");
  if (!program) return -1;
  fprintf(program, "#!/bin/sh\necho $$ >process\nexec /bin/sleep 1000\n");
  return fclose(program) == 0 && chmod("gnuplot", 0755) == 0 ? setenv("PATH", folder, 1) : -1;
}

static int leave(void **state)
{
  (void)state;
  remove("gnuplot");
  remove("process");
  return chdir("/") == 0 ? rmdir(folder) : -1; /* fails if another file is left */
}

static void a_gnuplot_that_hangs_is_ended(void **state)
{
  (void)state;
  gg_error err;
  int process = 0;
  assert_int_equal(gg_plot_gnuplot_run("plot x", NULL, "x.svg", &err), GG_FAILED);
  assert_non_null(strstr(err.message, "gnuplot was ended, as it took more than 1 s"));
  FILE *in = fopen("process", "r");
  assert_non_null(in);
  assert_int_equal(fscanf(in, "%d", &process), 1);
  fclose(in);
  assert_true(process > 1 && kill(process, 0) != 0 && errno == ESRCH);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_gnuplot_that_hangs_is_ended)};
  return cmocka_run_group_tests(tests, enter, leave);
}
