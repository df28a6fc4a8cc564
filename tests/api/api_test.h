/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small scenes for tests of the public interface, which include nothing else of the library. */
#ifndef API_TEST_H
#define API_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <graingas.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Fails with the library's own words. */
#define assert_ok(call)                                                                                                \
  do {                                                                                                                 \
    gg_status ok_status = (call);                                                                                      \
    if (ok_status != GG_OK) fail_msg("%s: %s", #call, err.message);                                                    \
  } while (0)

#define assert_refused(call, words)                                                                                    \
  do {                                                                                                                 \
    memset(&err, 0, sizeof err);                                                                                       \
    assert_int_equal(call, GG_BAD_INPUT);                                                                              \
    if (!strstr(err.message, words)) fail_msg("'%s' lacks '%s'", err.message, words);                                  \
  } while (0)

static inline gg_scene *scene_of(const char *yaml)
{
  gg_error err;
  gg_scene *scene = NULL;
  assert_ok(gg_scene_parse(yaml, "test", &scene, &err));
  return scene;
}

static char door_folder[] = "/tmp/graingas-door-XXXXXX";

static inline int enter_folder(void **state)
{
  (void)state;
  return mkdtemp(door_folder) && chdir(door_folder) == 0 ? 0 : -1;
}

/* Remove the files of these tests, which all begin with "t_". */
static inline int leave_folder(void **state)
{
  (void)state;
  if (system("rm -rf t_*") != 0 || chdir("/") != 0) return -1;
  return rmdir(door_folder);
}

#endif
