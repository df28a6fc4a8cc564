/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <assert.h>
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/progress.h"

/* Set by the signal handler, read by threads. */
static atomic_int caught;
static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler must not take a lock");
static atomic_bool lost; /* output has been dropped; later writes do not block */

int gg_cli_interrupted(void *context)
{
  (void)context;
  return atomic_load(&caught) != 0;
}

bool gg_cli_output_lost(void)
{
  return atomic_load(&lost);
}

static void on_signal(int number)
{
  atomic_store(&caught, 1);
  signal(number, SIG_DFL);
}

#ifdef __GLIBC__ /* elsewhere an interrupt blocks until the reader reads; a second one ends the program */
enum {
  TIMEOUT = 1000 /* ms */,
  AT_ONCE = 4096 /* bytes that a writable pipe takes without blocking (POSIX: PIPE_BUF) */
};

static ssize_t write_to_reader(void *fd, const char *text, size_t size)
{
  struct pollfd out = {.fd = (int)(intptr_t)fd, .events = POLLOUT};
  size_t done = 0;
  while (done < size) {
    const int ready = poll(&out, 1, gg_cli_output_lost() ? 0 : TIMEOUT);
    if (ready == 0 && gg_cli_interrupted(NULL)) {
      atomic_store(&lost, true);
      errno = EINTR;
      break;
    }
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t n = write(out.fd, text + done, size - done < AT_ONCE ? size - done : AT_ONCE);
    if (n < 0 && errno != EINTR && errno != EAGAIN) break;
    if (n > 0) done += (size_t)n;
  }
  return (ssize_t)done;
}

/* A stream whose writes time out after an interrupt. Files never block and keep their stream. */
static FILE *with_timeout(FILE *stream, int fd, int buffering)
{
  struct stat about;
  if (fstat(fd, &about) != 0 || S_ISREG(about.st_mode)) return stream;
  FILE *out = fopencookie((void *)(intptr_t)fd, "w", (cookie_io_functions_t){.write = write_to_reader});
  if (out) setvbuf(out, NULL, buffering, BUFSIZ);
  return out ? out : stream;
}
#endif

void gg_cli_catch_interrupts(void)
{
#ifdef __GLIBC__
  fflush(NULL);
  stdout = with_timeout(stdout, STDOUT_FILENO, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF);
  stderr = with_timeout(stderr, STDERR_FILENO, _IONBF);
#endif
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART}, before;
  for (size_t i = 0; i < sizeof signals / sizeof *signals;
       i++) /* signals that the parent ignores (nohup, &) stay ignored */
    if (sigaction(signals[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signals[i], &action, NULL);
}
