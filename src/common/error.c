#include "common/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

gg_status gg_fail(gg_error *err, gg_status status, const char *format, ...)
{
  if (err) {
    va_list args;
    va_start(args, format);
    vsnprintf(err->message, sizeof err->message, format, args);
    va_end(args);
    err->status = status;
  }
  return status;
}

gg_status gg_error_prefix(gg_error *err, gg_status status, const char *format, ...)
{
  if (err) {
    char old[sizeof err->message];
    memcpy(old, err->message, sizeof old);
    va_list args;
    va_start(args, format);
    int used = vsnprintf(err->message, sizeof err->message, format, args);
    va_end(args);
    if (used >= 0 && (size_t)used < sizeof err->message)
      snprintf(err->message + used, sizeof err->message - (size_t)used, ": %s", old);
    err->status = status;
  }
  return status;
}
