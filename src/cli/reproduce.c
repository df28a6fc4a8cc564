/* graingas reproduce: figures of the papers, simulated anew. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/print.h"
#include "cli/progress.h"

typedef struct counts {
  int figures;
  double quick, full;
} counts;

static void print_needs(const gg_figure_needs *n)
{
  char time[24];
  gg_cli_format_duration(n->cpu_seconds, time, sizeof time);
  printf("  %9s", time);
}

static void print_line(void *context, const gg_figure_info *f)
{
  counts *c = context;
  char needs[48];
  c->figures++;
  if (f->cannot) {
    printf("%-12s  cannot be reproduced: %s\n", f->name, f->cannot);
    return;
  }
  snprintf(needs, sizeof needs, "%s%s%s", f->full.md ? "md" : "", f->full.md && f->full.dsmc ? ", " : "",
           f->full.dsmc ? "dsmc" : "");
  printf("%-12s  %-8s  %6zu  %6ld", f->name, needs, f->full.points, (long)f->full.particles);
  print_needs(&f->quick);
  print_needs(&f->full);
  printf("  %-14s  %s\n", f->verdict, f->shows);
  c->quick += f->quick.cpu_seconds - f->quick.shared, c->full += f->full.cpu_seconds - f->full.shared;
}

static void print_text(const char *name, const char *text)
{
  printf(", \"%s\": ", name);
  if (!text) {
    printf("null");
    return;
  }
  putchar('"');
  for (const char *c = text; *c; c++) {
    if (*c == '"' || *c == '\\') putchar('\\');
    if ((unsigned char)*c >= ' ') putchar(*c);
    if (*c == '\n') fputs("\\n", stdout);
  }
  putchar('"');
}

static void print_json_needs(const char *name, const gg_figure_needs *n)
{
  printf(", \"%s\": {\"points\": %zu, \"cpu_seconds\": %.6g, \"shared\": %.6g, \"particles\": %ld, \"md\": %s, "
         "\"dsmc\": %s}",
         name, n->points, n->cpu_seconds, n->shared, (long)n->particles, n->md ? "true" : "false",
         n->dsmc ? "true" : "false");
}

static void print_json(void *context, const gg_figure_info *f)
{
  counts *c = context;
  printf("%s\n {\"figure\": \"%s\"", c->figures++ ? "," : "", f->name);
  print_text("file", f->file);
  print_text("shows", f->shows);
  print_text("cannot", f->cannot);
  print_text("verdict", f->verdict);
  print_text("because", f->cannot ? NULL : f->because);
  if (!f->cannot) {
    print_json_needs("quick", &f->quick);
    print_json_needs("full", &f->full);
  }
  putchar('}');
}

static int list_figures(const gg_options *o)
{
  gg_error err;
  counts c = {0};
  char quick[24], full[24];
  if (o->json)
    printf("[");
  else
    printf("%-12s  %-8s  %6s  %6s  %9s  %9s  %-14s  %s\n", "figure", "engines", "points", "grains", "--quick", "full",
           "verdict", "shows");
  gg_status status = gg_list_figures(o->json ? print_json : print_line, &c, &err);
  if (o->json) printf("\n]\n");
  if (status != GG_OK) return gg_cli_report(&err);
  gg_cli_format_duration(c.quick, quick, sizeof quick);
  gg_cli_format_duration(c.full, full, sizeof full);
  if (!o->json)
    printf("\n%d figures; times are those of one processor here; all of them, points that several show once: %s with "
           "--quick, %s in full\n",
           c.figures, quick, full);
  return GG_OK;
}

typedef struct report {
  bool quiet, json;
  gg_cli_line progress;
  int n_numbers;
} report;

static int is_interrupted(void *context)
{
  (void)context;
  return gg_cli_interrupted();
}

/* "thesis 3.5: 3 of 12 points, 0:40 left" */
static void show(void *context, const char *figure, const gg_sweep_progress *now)
{
  report *t = context;
  char line[160], left[24] = "";
  if (isfinite(now->time_left)) gg_cli_format_duration(now->time_left, left, sizeof left);
  snprintf(line, sizeof line, "%s: %zu of %zu points%s%s%s", figure, now->done, now->points, *left ? ", " : "", left,
           *left ? " left" : "");
  gg_cli_line_show(&t->progress, line, false);
}

static void warn(void *context, const char *figure, const char *message)
{
  report *t = context;
  gg_cli_line_clear(&t->progress);
  fprintf(stderr, "warning: %s: %s\n", figure, message);
}

/* The files go to standard output, for scripts. */
static void print_file(void *context, const char *file)
{
  report *t = context;
  gg_cli_line_clear(&t->progress);
  if (!t->quiet && !t->json) gg_cli_print_name(stdout, "", file, "\n");
}

static void print_engine(const char *name, double mean, double error, double z)
{
  if (isfinite(mean)) printf(", %s %.5g +- %.2g (z %+.1f)", name, mean, error, z);
}

static void print_number(void *context, const gg_figure_number *n)
{
  report *t = context;
  gg_cli_line_clear(&t->progress);
  if (t->quiet || t->json) return;
  printf("%s%s%s%s: paper %.5g", n->what, n->where ? " (" : "", n->where ? n->where : "", n->where ? ")" : "",
         n->paper);
  print_engine("md", n->md, n->md_error, n->md_z);
  print_engine("dsmc", n->dsmc, n->dsmc_error, n->dsmc_z);
  printf("\n");
}

static int reproduce(const gg_options *o)
{
  gg_error err;
  report t = {.quiet = o->quiet, .json = o->json};
  gg_reproduce_options options = {.quick = o->quick,
                                  .threads = o->threads,
                                  .folder = o->output,
                                  .accept_version = o->accept_version,
                                  .command = o->command_line,
                                  .context = &t,
                                  .progress = show,
                                  .stop = is_interrupted,
                                  .warn = warn,
                                  .written = print_file,
                                  .number = print_number};
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
  if (code == GG_CLI_GO_ON) code = list ? list_figures(&o) : reproduce(&o);
  gg_cli_options_clear(&o);
  return code;
}

void gg_cli_print_reproduction_page(void)
{
  char *page = NULL;
  if (gg_reproduction_page(&page, NULL) == GG_OK) fputs(page, stdout);
  free(page);
}
