/* graingas reproduce: figures of the papers, simulated anew. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/number_format.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/reproduce.h"

typedef struct told {
  bool quiet, json;
  gg_cli_line progress;
  int n_numbers;
} told;

static int is_interrupted(void *context)
{
  (void)context;
  return gg_cli_interrupted();
}

/* "thesis 3.5: 3 of 12 points, 0:40 left" */
static void show(void *context, const char *figure, const gg_sweep_progress *now)
{
  told *t = context;
  char line[160], left[24] = "";
  if (isfinite(now->time_left)) gg_cli_format_duration(now->time_left, left, sizeof left);
  snprintf(line, sizeof line, "%s: %zu of %zu points%s%s%s", figure, now->done, now->points, *left ? ", " : "", left,
           *left ? " left" : "");
  gg_cli_line_show(&t->progress, line, false);
}

static void warn(void *context, const char *figure, const char *message)
{
  told *t = context;
  gg_cli_line_clear(&t->progress);
  fprintf(stderr, "warning: %s: %s\n", figure, message);
}

/* The files go to standard output, for scripts. */
static void tell_file(void *context, const char *file)
{
  told *t = context;
  gg_cli_line_clear(&t->progress);
  if (!t->quiet && !t->json) printf("%s\n", file);
}

static void tell_engine(const char *name, double mean, double error, double z)
{
  if (isfinite(mean)) printf(", %s %.5g +- %.2g (z %+.1f)", name, mean, error, z);
}

static void tell_number(void *context, const gg_figure_number *n)
{
  told *t = context;
  gg_cli_line_clear(&t->progress);
  if (t->quiet || t->json) return;
  printf("%s%s%s%s: paper %.5g", n->what, n->where ? " (" : "", n->where ? n->where : "", n->where ? ")" : "",
         n->paper);
  tell_engine("md", n->md, n->md_error, n->md_z);
  tell_engine("dsmc", n->dsmc, n->dsmc_error, n->dsmc_z);
  printf("\n");
}

static int reproduce(const gg_options *o)
{
  gg_error err;
  told t = {.quiet = o->quiet, .json = o->json};
  gg_reproduce_options options = {.quick = o->quick,
                                  .threads = o->threads,
                                  .folder = o->output,
                                  .command = o->command_line,
                                  .context = &t,
                                  .progress = show,
                                  .stop = is_interrupted,
                                  .warn = warn,
                                  .written = tell_file,
                                  .number = tell_number};
  gg_cli_line_start(&t.progress, o->quiet);
  gg_cli_catch_interrupts();
  gg_status status = gg_reproduce(o->input, &options, &err);
  gg_cli_line_clear(&t.progress);
  return status == GG_OK ? GG_OK : gg_cli_report(&err);
}

int gg_cli_reproduce_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  int code = gg_cli_options_parse(command, argc, argv, &o);
  bool list = code == GG_CLI_GO_ON && strcmp(o.input, "list") == 0;
  if (code == GG_CLI_GO_ON && o.json && !list)
    code =
        gg_cli_fail(GG_BAD_INPUT, "option '--json' goes with reproduce list alone: a figure leaves CSV and HDF5 files");
  if (code == GG_CLI_GO_ON) code = list ? gg_cli_list_figures(&o) : reproduce(&o);
  gg_cli_options_clear(&o);
  return code;
}

void gg_cli_print_reproduction_page(void)
{
  char *page = NULL;
  if (gg_reproduction_page(&page, NULL) == GG_OK) fputs(page, stdout);
  free(page);
}
