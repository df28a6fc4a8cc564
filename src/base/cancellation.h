/* A word to those who do long work: look here now and then, and end early on request. Engines look several
 * times a second, at their start too. */
#ifndef GG_STOP_H
#define GG_STOP_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

typedef struct gg_stop {
  bool (*asked)(void *context); /* from any thread that works */
  void *context;
} gg_stop;

/* A callback of the user's program says, in the thread that called it, why it failed: whoever looks whether to stop
 * ends early, and the work that it stands in fails with its reason. The first reason counts. */
void gg_base_callback_fail(const char *reason);
bool gg_base_callback_failed(void);
/* At the end of such work: GG_FAILED with the reason, which is then forgotten; `status` where no callback failed. */
gg_status gg_base_callback_settle(gg_status status, gg_error *err);

/* `stop` may be NULL: never stop. */
static inline bool gg_stop_asked(const gg_stop *stop)
{
  return gg_base_callback_failed() || (stop && stop->asked(stop->context));
}

#endif
