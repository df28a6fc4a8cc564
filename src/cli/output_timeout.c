#include <errno.h>
#include <poll.h>
#include <stdatomic.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/progress.h"

static atomic_bool lost; /* by either stream; from then on nobody waits */

bool gg_cli_lost_patience(void)
{
  return atomic_load(&lost);
}

#ifdef __GLIBC__
/* A pipe that poll says has room takes so much at once. */
static bool (*told_to_stop)(void);
enum { AT_ONCE = 4096, PATIENCE = 1000 /* ms */ };

static bool wait_for_reader(int fd)
{
  struct pollfd out = {.fd = fd, .events = POLLOUT};
  for (;;) {
    int ready = poll(&out, 1, atomic_load(&lost) ? 0 : PATIENCE);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return true; /* what is wrong, writing tells */
    if (ready == 0 && told_to_stop()) return false;
  }
}

static ssize_t write_patiently(void *cookie, const char *text, size_t size)
{
  const int fd = *(const int *)cookie;
  size_t done = 0;
  while (done < size) {
    if (!wait_for_reader(fd)) {
      atomic_store(&lost, true);
      errno = EINTR;
      break;
    }
    ssize_t n = write(fd, text + done, size - done < AT_ONCE ? size - done : AT_ONCE);
    if (n < 0 && errno != EINTR && errno != EAGAIN) break;
    if (n > 0) done += (size_t)n;
  }
  return (ssize_t)done;
}

/* Files never make anybody wait. NULL: as it was. */
static FILE *patient(int fd)
{
  static int number[] = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
  struct stat about;
  if (fstat(fd, &about) != 0 || S_ISREG(about.st_mode)) return NULL;
  return fopencookie(&number[fd], "w", (cookie_io_functions_t){.write = write_patiently});
}

void gg_cli_be_patient(bool (*stopped)(void))
{
  told_to_stop = stopped;
  fflush(NULL);
  FILE *out = patient(STDOUT_FILENO), *err = patient(STDERR_FILENO);
  if (out && isatty(STDOUT_FILENO)) setvbuf(out, NULL, _IOLBF, BUFSIZ);
  if (err) setvbuf(err, NULL, _IONBF, 0);
  if (out) stdout = out;
  if (err) stderr = err;
}
#else
/* Elsewhere a signal waits for the reader, and the second one ends the program. */
void gg_cli_be_patient(bool (*stopped)(void))
{
  (void)stopped;
}
#endif
