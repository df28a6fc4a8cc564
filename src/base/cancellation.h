/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cancellation of long work: poll here and end early on request. Engines poll several times a second, also at their
 * start, and so do theories that take long. */
#ifndef GG_STOP_H
#define GG_STOP_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

typedef struct gg_stop {
  bool (*asked)(void *context); /* from any thread that works; once true, it stays so until the work has ended */
  void *context;
} gg_stop;

/* A user's callback reports, on the thread that called it, why it failed. Work of this thread that polls then ends
 * early, and fails with the first reason reported. */
void gg_base_callback_fail(const char *reason);
bool gg_base_callback_failed(void);
/* At the end of such work: GG_FAILED with the reason, which is then forgotten; `status` where no callback failed. */
gg_status gg_base_callback_settle(gg_status status, gg_error *err);

/* `stop` may be NULL: never stop. */
static inline bool gg_stop_asked(const gg_stop *stop)
{
  return gg_base_callback_failed() || (stop && stop->asked(stop->context));
}

/* Between two parts of long work. */
static inline gg_status gg_stop_check(const gg_stop *stop, gg_error *err)
{
  return gg_stop_asked(stop) ? gg_base_fail(err, GG_INTERRUPTED, "interrupted") : GG_OK;
}

#endif
