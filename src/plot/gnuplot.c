/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gnuplot as a child process: the script on its standard input, the picture from its standard output, its errors read
 * back. gnuplot gets no file name: in its language names can be commands. */
#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "io/atomic_file.h"
#include "plot/plot.h"

extern char **environ;

static gg_status is_missing(gg_error *err)
{
  return gg_base_fail(err, GG_FAILED, "gnuplot is not installed (Debian: apt install gnuplot-nox)");
}

gg_status gg_plot_gnuplot_is_there(gg_error *err)
{
  const char *at = getenv("PATH");
  while (at && *at) {
    char path[PATH_MAX];
    size_t length = strcspn(at, ":");
    int written = snprintf(path, sizeof path, "%.*s%sgnuplot", (int)length, at, length ? "/" : "");
    if (written < (int)sizeof path && access(path, X_OK) == 0) return GG_OK;
    at += length + (at[length] == ':');
  }
  return at ? is_missing(err) : GG_OK; /* without PATH the system has a default */
}

/* Start gnuplot without the user's startup files. */
static gg_status spawn(int in, int out, int complaints, pid_t *child, gg_error *err)
{
  char *const arguments[] = {(char[]){"gnuplot"}, (char[]){"-d"}, (char[]){"-"}, NULL};
  const int from[] = {in, out, complaints}; /* STDIN, STDOUT, STDERR */
  posix_spawn_file_actions_t actions;
  int failed = posix_spawn_file_actions_init(&actions);
  if (failed) return gg_base_out_of_memory(err);
  for (int to = STDIN_FILENO; to <= STDERR_FILENO && !failed; to++)
    failed = posix_spawn_file_actions_adddup2(&actions, from[to], to);
  if (!failed) failed = posix_spawnp(child, "gnuplot", &actions, NULL, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOMEM) return gg_base_out_of_memory(err);
  if (failed == ENOENT) return is_missing(err);
  return failed ? gg_base_fail(err, GG_FAILED, "gnuplot cannot be started: %s", strerror(failed)) : GG_OK;
}

#ifndef GG_GNUPLOT_SECONDS    /* tests set less */
#define GG_GNUPLOT_SECONDS 60 /* a page takes some seconds at most */
#endif

/* Signals that would end this process or are caught, without the ignored ones. */
static void choose_signals(sigset_t *ends)
{
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction now;
  sigemptyset(ends);
  for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
    if (sigaction(signals[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) sigaddset(ends, signals[i]);
}

/* Wait until the child ends (*ended), a signal comes (which is returned), or the time is over. If the process ignores
 * SIGCHLD, nobody can wait for children: the call returns at once, and the end of the picture shows whether it is
 * whole.
 */
static int wait_for(pid_t child, const sigset_t *ends, double seconds, bool *ended, int *status)
{
  const double start = gg_base_clock_wall();
  for (long pause = 1; !*ended && gg_base_clock_wall() - start < seconds; pause += pause < 50) {
    const int number = sigtimedwait(ends, NULL, &(struct timespec){0, pause * 1000 * 1000});
    if (number > 0) return number;
    const pid_t got = waitpid(child, status, WNOHANG);
    *ended = got == child || (got < 0 && errno != EINTR);
  }
  return 0;
}

/* Wait for gnuplot. End it if it takes too long or if this process receives a signal; the signal's previous action
 * then follows. */
static gg_status await(pid_t child, int *status, gg_error *err)
{
  sigset_t ends, before;
  bool ended = false;
  choose_signals(&ends);
  pthread_sigmask(SIG_BLOCK, &ends, &before);
  const int number = wait_for(child, &ends, GG_GNUPLOT_SECONDS, &ended, status);
  if (!ended) {
    kill(child, number ? number : SIGTERM);
    sigset_t none;
    sigemptyset(&none);
    wait_for(child, &none, 1, &ended, status);
    if (!ended) kill(child, SIGKILL), waitpid(child, status, 0);
    ended = false;
  }
  if (number) raise(number);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  if (number) return gg_base_fail(err, GG_INTERRUPTED, "interrupted while gnuplot drew a picture");
  return ended ? GG_OK
               : gg_base_fail(err, GG_FAILED, "gnuplot was ended, as it took more than %d s for a picture",
                              GG_GNUPLOT_SECONDS);
}

/* The error of gnuplot is the last line with words. */
static gg_status outcome(pid_t child, FILE *complaints, gg_error *err)
{
  char line[256], last[256] = "no picture came out";
  int status = 0;
  GG_TRY(await(child, &status, err));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return GG_OK;
  rewind(complaints);
  while (fgets(line, sizeof line, complaints)) {
    line[strcspn(line, "\n")] = '\0';
    if (line[strspn(line, " ^")]) memcpy(last, line, sizeof last);
  }
  return gg_base_fail(err, GG_FAILED, "gnuplot failed: %s", last);
}

static gg_status draw(const char *script, int target, gg_error *err)
{
  pid_t child;
  GG_CLOSED FILE *in = tmpfile(), *complaints = tmpfile();
  if (!in || !complaints) return gg_base_fail(err, GG_BAD_FILE, "no temporary file can be made: %s", strerror(errno));
  if (fprintf(in, "%s\nunset output\n", script) <= 0 || fflush(in) != 0)
    return gg_base_fail(err, GG_BAD_FILE, "a temporary file cannot be written: %s", strerror(errno));
  rewind(in);
  GG_TRY(spawn(fileno(in), target, fileno(complaints), &child, err));
  return outcome(child, complaints, err);
}

/* Position of the mark that ends a whole picture; -1: not whole. gnuplot does not notice a full disk. */
static off_t end_of(int fd, const char *mark)
{
  char tail[64];
  off_t size = lseek(fd, 0, SEEK_END), from = size > (off_t)sizeof tail ? size - (off_t)sizeof tail : 0;
  ssize_t got = pread(fd, tail, sizeof tail, from);
  char *at = got > 0 ? memmem(tail, (size_t)got, mark, strlen(mark)) : NULL;
  return at ? from + (at - tail) : -1;
}

/* Insert SVG before the end of gnuplot's page. */
static gg_status put_over(gg_atomic_file *file, const char *over, gg_error *err)
{
  off_t end = end_of(file->fd, "</svg>");
  if (end < 0) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written whole: is the disk full?", file->path);
  if (ftruncate(file->fd, end) != 0 || lseek(file->fd, 0, SEEK_END) != end)
    return gg_io_path_write_error(file->path, strerror(errno), err);
  GG_TRY(gg_io_atomic_write(file, over, strlen(over), err));
  return gg_io_atomic_write(file, "</svg>\n", 7, err);
}

gg_status gg_plot_gnuplot_run(const char *script, const char *over, const char *picture, gg_error *err)
{
  gg_atomic_file file;
  GG_TRY(gg_io_atomic_check_writable(picture, GG_PICTURES_ARE, err));
  GG_TRY(gg_io_atomic_open(&file, picture, false, err));
  gg_status status = draw(script, file.fd, err);
  if (status == GG_OK && over) status = put_over(&file, over, err);
  if (status == GG_OK && end_of(file.fd, "</svg>") < 0 && end_of(file.fd, "IEND") < 0 && end_of(file.fd, "%%EOF") < 0)
    status = gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written whole: is the disk full?", picture);
  return gg_io_atomic_commit(&file, status, err);
}
