/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Existing files at an output path: links are followed, permissions stay, one writer at a time, and nothing
 * that a dead one left blocks or stays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/atomic_file.h"
#include "io/output_path.h"

static char folder[] = "/tmp/graingas-output-XXXXXX";

static int enter(void **state)
{
  (void)state;
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  (void)state;
  return chdir("/") == 0 ? rmdir(folder) : -1; /* every test has removed what it made: nothing else is there */
}

static void put(const char *path, const char *text)
{
  gg_atomic_file f;
  gg_error err;
  assert_int_equal(gg_io_atomic_open(&f, path, false, &err), GG_OK);
  assert_int_equal(gg_io_atomic_write(&f, text, strlen(text), &err), GG_OK);
  assert_int_equal(gg_io_atomic_commit(&f, GG_OK, &err), GG_OK);
}

static void assert_holds(const char *path, const char *text)
{
  char there[64] = "";
  FILE *in = fopen(path, "r");
  assert_non_null(in);
  assert_true(fread(there, 1, sizeof there - 1, in) == strlen(text));
  assert_string_equal(there, text);
  fclose(in);
}

static void links_are_followed(void **state)
{
  (void)state;
  struct stat about;
  assert_int_equal(mkdir("a", 0777) || mkdir("b", 0777), 0);
  assert_int_equal(symlink("../b/link", "a/link") || symlink("file", "b/link") || symlink("loop", "loop"), 0);
  put("a/link", "one"); /* over two links to a file that is not there yet */
  assert_holds("b/file", "one");
  put("a/link", "two");
  assert_holds("b/file", "two");
  assert_true(lstat("a/link", &about) == 0 && S_ISLNK(about.st_mode));
  assert_true(lstat("b/link", &about) == 0 && S_ISLNK(about.st_mode));
  assert_true(gg_io_path_is_same_file("a/link", "b/../b/file") && !gg_io_path_is_same_file("a/link", "b/other"));
  assert_true(gg_io_path_is_same_file("b/new", "a/../b/new") && !gg_io_path_is_same_file("a/new", "b/new"));
  gg_atomic_file f;
  gg_error err;
  assert_int_equal(gg_io_atomic_open(&f, "loop", false, &err), GG_BAD_FILE);
  unlink("b/file"), unlink("b/link"), unlink("a/link"), unlink("loop"), rmdir("a"), rmdir("b");
}

static void mode_is_kept(void **state)
{
  (void)state;
  struct stat about;
  gg_atomic_file f;
  gg_error err;
  put("file", "one");
  assert_int_equal(chmod("file", 0640), 0);
  put("file", "two");
  assert_true(stat("file", &about) == 0 && (about.st_mode & 07777) == 0640);
  assert_int_equal(chmod("file", 0444), 0); /* root could write it, and does not */
  assert_int_equal(gg_io_atomic_open(&f, "file", false, &err), GG_BAD_FILE);
  assert_string_equal(err.message, "file: cannot be written: it is write-protected");
  assert_holds("file", "two");
  unlink("file");
}

static void one_writer_at_a_time(void **state)
{
  (void)state;
  gg_atomic_file one, two;
  gg_error err;
  char own[60];
  assert_int_equal(gg_io_atomic_open(&one, "file", false, &err), GG_OK);
  assert_int_equal(symlink("file", "link"), 0);
  snprintf(own, sizeof own, "another process is writing it (process %ld on ", (long)getpid());
  assert_int_equal(gg_io_atomic_open(&two, "link", false, &err), GG_BAD_FILE);
  assert_non_null(strstr(err.message, own));
  gg_io_atomic_abandon(&one);
  put("link", "now");
  assert_holds("file", "now");
  unlink("file"), unlink("link");
}

/* Replaces the C library's function: if `no_locks` is set, the file system has no locks. */
static bool no_locks;
int flock(int fd, int how)
{
  if (no_locks) errno = ENOSYS;
  return no_locks ? -1 : (int)syscall(SYS_flock, fd, how);
}

/* Without locks two writers do not see each other: each writes a temporary file, and the last commit stays. */
static void without_locks(void **state)
{
  (void)state;
  gg_atomic_file one, two;
  gg_error err;
  no_locks = true;
  assert_int_equal(gg_io_atomic_open(&one, "file", false, &err), GG_OK);
  assert_int_equal(gg_io_atomic_write(&one, "half", 4, &err), GG_OK);
  assert_int_equal(gg_io_atomic_open(&two, "file", false, &err), GG_OK);
  assert_int_equal(gg_io_atomic_write(&two, "other", 5, &err), GG_OK);
  assert_int_equal(gg_io_atomic_write(&one, "whole", 5, &err), GG_OK);
  assert_int_equal(gg_io_atomic_commit(&one, GG_OK, &err), GG_OK);
  assert_holds("file", "halfwhole");
  assert_int_equal(gg_io_atomic_commit(&two, GG_OK, &err), GG_OK);
  assert_holds("file", "other");
  no_locks = false;
  unlink("file");
}

/* A killed process leaves its lock and an unfinished file; the next run ignores both. */
static void what_the_dead_left(void **state)
{
  (void)state;
  gg_atomic_file f;
  gg_error err;
  pid_t child = fork();
  if (child == 0) {
    if (gg_io_atomic_open(&f, "file", false, &err) != GG_OK || gg_io_atomic_write(&f, "half", 4, &err) != GG_OK)
      _exit(1);
    _exit(0); /* nothing is closed or removed */
  }
  int status;
  assert_true(waitpid(child, &status, 0) == child && status == 0);
  assert_true(access("file.graingas-tmp", F_OK) == 0 && access("file.graingas-lock", F_OK) == 0);
  assert_int_equal(gg_io_atomic_open(&f, "file", false, &err), GG_OK);
  gg_io_atomic_abandon(&f);
  assert_true(access("file.graingas-tmp", F_OK) != 0 && access("file.graingas-lock", F_OK) != 0);
}

/* Devices and pipes receive the bytes and remain. */
static void devices_and_pipes_receive_the_bytes_and_remain(void **state)
{
  (void)state;
  struct stat about;
  gg_atomic_file f;
  gg_error err;
  char got[8] = "";
  if (mknod("null", S_IFCHR | 0666, makedev(1, 3)) == 0) { /* by root alone; never the system's own */
    put("null", "away");
    assert_true(stat("null", &about) == 0 && S_ISCHR(about.st_mode));
    assert_false(gg_io_path_is_same_file("null", "null"));
    unlink("null");
  }
  assert_int_equal(mkfifo("pipe", 0666), 0);
  assert_int_equal(gg_io_atomic_open(&f, "pipe", false, &err), GG_BAD_FILE);
  assert_string_equal(err.message, "pipe: cannot be written: nobody reads from this pipe");
  int in = open("pipe", O_RDONLY | O_NONBLOCK);
  put("pipe", "through");
  assert_int_equal(read(in, got, sizeof got), 7);
  assert_memory_equal(got, "through", 7);
  assert_int_equal(gg_io_atomic_open(&f, "pipe", false, &err), GG_OK);
  close(in); /* the reader goes: no signal */
  assert_int_equal(gg_io_atomic_write(&f, "lost", 4, &err), GG_BAD_FILE);
  assert_string_equal(err.message, "pipe: cannot be written: Broken pipe");
  gg_io_atomic_abandon(&f);
  assert_int_equal(gg_io_atomic_check_writable("pipe", "pictures are files", &err), GG_BAD_FILE);
  assert_string_equal(err.message, "pipe: is a device or a pipe; pictures are files");
  assert_int_equal(gg_io_atomic_open(&f, "", false, &err), GG_BAD_INPUT);
  unlink("pipe");
}

static atomic_bool found_all;

/* Another writer: a new file takes the place of the last, all the time. */
static void *replace(void *unused)
{
  while (!found_all) {
    int fd = open("new", O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0 || close(fd) != 0 || rename("new", "file") != 0) return &found_all;
  }
  return unused;
}

/* A file is inspected twice and may be replaced in between, which is no reason to reject it. */
static void replaced_while_looked_at(void **state)
{
  (void)state;
  pthread_t other;
  void *failed;
  gg_output_path place;
  gg_error err;
  int refused = 0;
  put("file", "one");
  assert_int_equal(pthread_create(&other, NULL, replace, NULL), 0);
  for (int i = 0; i < 20000; i++) {
    if (gg_io_output_path_find(&place, "file", &err) != GG_OK) refused++;
    gg_io_output_path_clear(&place);
  }
  found_all = true;
  assert_int_equal(pthread_join(other, &failed), 0);
  assert_null(failed);
  if (refused > 0) fail_msg("%d times of 20000: %s", refused, err.message);
  unlink("file"), unlink("new");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(links_are_followed),       cmocka_unit_test(mode_is_kept),
      cmocka_unit_test(one_writer_at_a_time),     cmocka_unit_test(without_locks),
      cmocka_unit_test(what_the_dead_left),       cmocka_unit_test(devices_and_pipes_receive_the_bytes_and_remain),
      cmocka_unit_test(replaced_while_looked_at),
  };
  return cmocka_run_group_tests(tests, enter, leave);
}
