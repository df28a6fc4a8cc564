/* graingas compare: both engines and the theories on one scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/outputs.h"
#include "cli/report.h"
#include "cli/simulate.h"

typedef struct drawing {
  const gg_simulating *of;
  bool replaced;
} drawing;

/* Others stand beside the picture that was asked for. */
static void tell(void *context, const char *picture)
{
  const drawing *d = context;
  gg_cli_report_written(d->of->options, "picture", picture, d->replaced && strcmp(picture, d->of->picture) == 0);
}

/* A picture that nobody asked for may be missing, as where gnuplot is; a file that cannot be written is a failure. */
static gg_status draw(const gg_simulating *s, gg_error *err)
{
  if (!s->picture) return GG_OK;
  drawing d = {s, gg_cli_file_exists(s->picture)};
  gg_status status = gg_plot(s->output, s->picture, NULL, tell, &d, err);
  if (status != GG_FAILED || s->options->picture) return status;
  fprintf(stderr, "warning: no picture: %s\n", err->message);
  return GG_OK;
}

static void print(const gg_options *o, const gg_comparison *c)
{
  char *text = NULL;
  if (!o->json)
    gg_cli_print_comparison(c, o->all);
  else if (gg_comparison_to_json(c, &text, NULL) == GG_OK)
    gg_cli_print_text(text);
}

static int compare(gg_simulating *s)
{
  gg_error err, why;
  gg_status drawn = GG_OK;
  gg_comparison *c = NULL;
  gg_status status = gg_compare(s->scene, &s->run, &c, &err);
  if (gg_cli_simulation_has_output(s, status, gg_comparison_result(c, "md"), gg_comparison_result(c, "dsmc"))) {
    print(s->options, c);
    if (gg_cli_simulation_report(s, status)) drawn = draw(s, &why);
  }
  gg_comparison_free(c);
  int code = gg_cli_simulation_finish(s, status, &err);
  if (drawn != GG_OK) gg_cli_report(&why);
  return code != GG_OK ? code : (int)drawn;
}

int gg_cli_compare_main(const gg_command *command, int argc, char **argv)
{
  return gg_cli_simulate_main(command, argc, argv, compare);
}
