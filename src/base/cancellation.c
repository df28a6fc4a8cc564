/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cancellation.h"

#include <stdio.h>

#include "base/text.h"

static _Thread_local struct {
  bool failed;
  char reason[sizeof(gg_error)];
} callback;

void gg_base_callback_fail(const char *reason)
{
  if (callback.failed) return;
  callback.failed = true;
  snprintf(callback.reason, sizeof callback.reason, "%s", reason && *reason ? reason : "a callback failed");
  gg_base_text_make_printable(callback.reason);
}

bool gg_base_callback_failed(void)
{
  return callback.failed;
}

gg_status gg_base_callback_settle(gg_status status, gg_error *err)
{
  if (!callback.failed) return status;
  callback.failed = false;
  return gg_base_fail(err, GG_FAILED, "%s", callback.reason);
}
