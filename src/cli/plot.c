/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas plot: pictures of a result file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/print.h"

/* Print the file name on standard output, for scripts. */
static void print_file(void *context, const char *picture)
{
  if (!*(const bool *)context) gg_cli_print_name(stdout, "", picture, "\n");
}

int gg_cli_plot_main(const gg_options *o)
{
  gg_error err;
  if (o->format && strcmp(o->format, "svg") != 0 && strcmp(o->format, "png") != 0 && strcmp(o->format, "pdf") != 0 &&
      strcmp(o->format, "gp") != 0)
    return gg_cli_fail(GG_BAD_INPUT, "option '--format': value '%s' is not allowed; allowed: svg, png, pdf, gp",
                       o->format);
  bool quiet = o->quiet;
  char suffix[8];
  snprintf(suffix, sizeof suffix, ".%s", o->format ? o->format : "svg");
  GG_CLI_FREED char *picture = gg_cli_options_output(o, suffix, &err);
  if (!picture) return gg_cli_report(&err);
  gg_cli_print_notice(o->input);
  const gg_status status = gg_plot(o->input, picture, o->format, o->width, print_file, NULL, &quiet, &err);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}
