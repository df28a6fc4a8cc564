#include "base/gsl_errors.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>

#include "base/memory.h"

/* GSL's handler is one for the process, and so is this. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int inside;
static gsl_error_handler_t *before;

static void note(const char *reason, const char *file, int line, int number)
{
  (void)reason, (void)file, (void)line;
  if (number == GSL_ENOMEM) gg_base_memory_lacked();
}

void gg_base_gsl_enter(void)
{
  pthread_mutex_lock(&lock);
  if (inside++ == 0) before = gsl_set_error_handler(note);
  pthread_mutex_unlock(&lock);
}

void gg_base_gsl_leave(void)
{
  pthread_mutex_lock(&lock);
  if (--inside == 0) gsl_set_error_handler(before);
  pthread_mutex_unlock(&lock);
}
