/* The figures of Montanero's review, simulated anew by Enskog Monte Carlo and set beside kinetic theory, with error
 * bars: review_figures [--error E] [--seed N] [FIGURE...] prints a table a figure; without a number, all of them (tens
 * of minutes at the default relative error of 0.003). Exit code 0, or as the command's (docs/conventions.md) where
 * a run fails. */
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figures.h"
#include "io/text.h"

typedef struct options {
  double error;
  uint64_t seed;
} options;

static const gg_quantity subjects[][2] = {
    [GG_CUMULANTS] = {GG_Q_CUMULANT, GG_Q_CUMULANT + 1},
    [GG_PARTIAL_TEMPERATURES] = {GG_Q_PARTIAL_TEMPERATURE_RATIO, GG_N_QUANTITIES},
    [GG_VISCOSITY] = {GG_Q_VISCOSITY_REDUCED, GG_Q_VISCOSITY_REDUCED_KINETIC},
};

static gg_quantity quantity(const gg_figure *f, const gg_point *p, int k)
{
  if (f->subject == GG_CUMULANTS && p->mass_ratio == 0) return k == 0 ? GG_Q_A2 : GG_N_QUANTITIES;
  return subjects[f->subject][k];
}

static void print_head(const gg_figure *f)
{
  printf("\nFigure %s: %s\n%6s %6s %6s %5s %5s  ", f->number, f->title, "m1/m2", "d1/d2", "n1/n2", "e", "phi");
  printf("%-26s %14s %9s %18s %14s\n", "quantity", "simulation", "theory", "deviation", "over e = 1");
}

/* The elastic mixture, simulated and by theory: what figures 7-9 divide by. */
typedef struct reference {
  double simulation, theory;
} reference;

static void print_row(const gg_point *p, gg_quantity q, const gg_estimate *s, double theory, const reference *elastic)
{
  char mean[40], deviation[40] = "";
  gg_format_estimate(s->mean, s->error, mean, sizeof mean);
  /* Of cumulants, which may vanish, the difference; else relative. */
  bool absolute = gg_quantity_family(q) == GG_Q_CUMULANT || q == GG_Q_A2;
  double scale = absolute ? 1 : theory;
  snprintf(deviation, sizeof deviation, absolute ? "%+.4f +- %.4f" : "%+.2f %% +- %.2f",
           (absolute ? 1 : 100) * (s->mean - theory) / scale, (absolute ? 1 : 100) * s->error / fabs(scale));
  if (p->mass_ratio > 0)
    printf("%6g %6g %6g ", p->mass_ratio, p->size_ratio, p->mole_ratio);
  else
    printf("%20s ", "one species");
  printf("%5g %5g  %-26s %14s %9.4f %18s", p->e, p->phi, gg_quantity_name(q), mean, theory, deviation);
  if (elastic->simulation > 0 && p->e < 1 && q == GG_Q_VISCOSITY_REDUCED)
    printf(" %+12.2f %%", 100 * (s->mean / elastic->simulation * elastic->theory / theory - 1));
  printf("%s\n", p->cooling ? "  cooling" : "");
}

static gg_status run_point(const options *o, const gg_figure *f, const gg_point *p, reference *elastic, gg_error *err)
{
  gg_scene s = gg_figure_scene(f->subject, p);
  gg_result *r = NULL;
  gg_theory_answer answer;
  s.run.seed = o->seed;
  s.run.relative_error = o->error;
  if (f->subject == GG_PARTIAL_TEMPERATURES) s.run.relative_error = o->error / 3; /* the theory is that good */
  if (f->subject == GG_CUMULANTS) s.run.relative_error = GG_AUTO, s.run.collisions = 4000;
  gg_status status = gg_run_scene(&s, NULL, 1, NULL, &r, err);
  if (!r) return status;
  for (size_t i = 0; i < r->warnings.n; i++) fprintf(stderr, "warning: %s\n", r->warnings.text[i]);
  const char *name = p->mass_ratio > 0 ? "garzo_montanero2003" : "garzo_dufty1999";
  status = gg_theory_evaluate(gg_theory_find(name), &r->model, &answer, err);
  for (int k = 0; k < 2 && status == GG_OK; k++) {
    gg_quantity q = quantity(f, p, k);
    if (q == GG_N_QUANTITIES || (k && p->phi == 0 && f->subject == GG_VISCOSITY)) continue;
    if (p->e == 1 && k == 0) *elastic = (reference){r->value[q].mean, answer.value[q]};
    print_row(p, q, &r->value[q], answer.value[q], elastic);
  }
  fflush(stdout);
  gg_result_free(r);
  return status;
}

static gg_status run_figure(const options *o, const gg_figure *f, gg_error *err)
{
  reference elastic = {0};
  print_head(f);
  for (int i = 0; i < f->n; i++) GG_TRY(run_point(o, f, &f->points[i], &elastic, err));
  return GG_OK;
}

static bool wanted(const gg_figure *f, int argc, char **argv)
{
  for (int i = optind; i < argc; i++)
    if (strcmp(argv[i], f->number) == 0) return true;
  return optind == argc;
}

static int usage(int code)
{
  fprintf(code ? stderr : stdout, "Usage: review_figures [--error RELATIVE_ERROR] [--seed N] [FIGURE...]\nFigures:");
  for (const gg_figure *f = gg_figures; f->number; f++) fprintf(code ? stderr : stdout, " %s", f->number);
  fprintf(code ? stderr : stdout, "\n");
  return code;
}

static bool known(const char *number)
{
  for (const gg_figure *f = gg_figures; f->number; f++)
    if (strcmp(f->number, number) == 0) return true;
  fprintf(stderr, "review_figures: there is no figure %s here\n", number);
  return false;
}

int main(int argc, char **argv)
{
  static const struct option longs[] = {{"error", required_argument, NULL, 'e'},
                                        {"seed", required_argument, NULL, 's'},
                                        {"help", no_argument, NULL, 'h'},
                                        {0}};
  options o = {.error = 0.003, .seed = 1};
  for (int c; (c = getopt_long(argc, argv, "", longs, NULL)) != -1;) {
    if (c == 'h') return usage(GG_OK);
    if (c == 'e') o.error = strtod(optarg, NULL);
    if (c == 's') o.seed = strtoull(optarg, NULL, 10);
    if (c == '?' || !(o.error > 0 && o.error < 1)) return usage(GG_BAD_INPUT);
  }
  for (int i = optind; i < argc; i++)
    if (!known(argv[i])) return usage(GG_BAD_INPUT);
  for (const gg_figure *f = gg_figures; f->number; f++) {
    gg_error err = {0};
    gg_status status = wanted(f, argc, argv) ? run_figure(&o, f, &err) : GG_OK;
    if (status == GG_OK) continue;
    fprintf(stderr, "review_figures: figure %s: %s\n", f->number, err.message);
    return (int)status;
  }
  return 0;
}
