/* graingas reproduce list: a line a figure. */
#include <stdio.h>
#include <string.h>

#include "cli/number_format.h"
#include "cli/reproduce.h"

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

int gg_cli_list_figures(const gg_options *o)
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
