/* What the command says: texts on standard output, errors on standard error. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/cli.h"

int gg_cli_report(const gg_error *err)
{
  fflush(stdout);
  fprintf(stderr, "graingas: %s\n", err->message);
  return err->status;
}

int gg_cli_report_of(const char *prefix, const gg_error *err)
{
  return gg_cli_fail(err->status, "%s: %s", prefix, err->message);
}

int gg_cli_fail(gg_status status, const char *format, ...)
{
  gg_error err = {.status = status};
  va_list args;
  va_start(args, format);
  vsnprintf(err.message, sizeof err.message, format, args);
  va_end(args);
  return gg_cli_report(&err);
}

gg_status gg_cli_refuse(gg_error *err, gg_status status, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(err->message, sizeof err->message, format, args);
  va_end(args);
  return err->status = status;
}

void gg_cli_print_text(char *text)
{
  if (text) puts(text);
  free(text);
}
