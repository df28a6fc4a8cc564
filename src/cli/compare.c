/* graingas compare: both engines and the theories on one scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/report.h"
#include "cli/simulate.h"

typedef struct drawing {
  const gg_options *options;
  const char *first; /* the picture that was asked for; others stand beside it */
  bool replaced;
} drawing;

static void tell(void *context, const char *picture)
{
  const drawing *d = context;
  gg_tell_written(d->options, "picture", picture, d->replaced && strcmp(picture, d->first) == 0);
}

/* A picture that cannot be drawn is no reason to call the comparison failed. */
static void draw(const gg_options *o, const char *output)
{
  gg_error err;
  if (o->picture && strcmp(o->picture, "none") == 0) return;
  char *picture = o->picture ? strdup(o->picture) : gg_with_suffix(output, ".svg");
  if (!picture) return;
  drawing d = {o, picture, gg_file_exists(picture)};
  if (gg_plot(output, picture, NULL, tell, &d, &err) != GG_OK)
    fprintf(stderr, "warning: no picture: %s\n", err.message);
  free(picture);
}

static void print(const gg_options *o, const gg_comparison *c)
{
  char *text = NULL;
  if (!o->json)
    gg_print_comparison(c, o->all);
  else if (gg_comparison_to_json(c, &text, NULL) == GG_OK)
    gg_cli_print_text(text);
}

static int compare(gg_simulating *s)
{
  gg_error err;
  char every[40] = "0";
  gg_comparison *c = NULL;
  gg_scene_get(s->scene, "output.trajectory_every", every, sizeof every, NULL);
  if (strtod(every, NULL) > 0) fprintf(stderr, "warning: compare keeps no trajectory; graingas run does\n");
  gg_status status = gg_compare(s->scene, &s->run, &c, &err);
  if (gg_simulating_shows(s, status, c != NULL)) {
    print(s->options, c);
    if (gg_simulating_tell(s, status)) draw(s->options, s->output);
  }
  gg_comparison_free(c);
  return gg_simulating_end(s, status, &err);
}

int gg_cli_compare_main(const gg_command *command, int argc, char **argv)
{
  return gg_simulate_main(command, argc, argv, compare);
}
