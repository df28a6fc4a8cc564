#include "measure/velocity_curves.h"

#include <math.h>
#include <stdio.h>

enum { LOW = 20 }; /* bins |k| <= LOW about 0: the head */

/* "C_x", "C_{x,2}": how gnuplot writes it; and "Cx", "Cx_2" for names. */
typedef struct naming {
  char plain[16], label[24], argument[24];
} naming;

static naming name_of(gg_velocity_component c)
{
  naming n;
  const char *what = c.spin ? "W" : "C", *greek = c.spin ? "Ω" : "C";
  if (c.n_species > 1) {
    snprintf(n.plain, sizeof n.plain, "%s%c_%d", what, "xyz"[c.axis], c.species + 1);
    snprintf(n.label, sizeof n.label, "%s_{%c,%d}", greek, "xyz"[c.axis], c.species + 1);
  } else {
    snprintf(n.plain, sizeof n.plain, "%s%c", what, "xyz"[c.axis]);
    snprintf(n.label, sizeof n.label, "%s_%c", greek, "xyz"[c.axis]);
  }
  snprintf(n.argument, sizeof n.argument, "%s/σ", greek);
  return n;
}

static void put_distribution(gg_curves *list, const naming *n, bool spin, const double *bin, double samples)
{
  char name[48];
  snprintf(name, sizeof name, "velocity_distribution_%s", n->plain);
  gg_curve *c =
      gg_measure_histogram_put(list, name, spin ? "distribution of Ω" : "distribution of C", n->label, bin, 1, samples);
  gg_measure_curve_axes(c, n->argument, "1", "P/P(0)", "1");
}

static void put_deviation(gg_curves *list, const naming *n, bool spin, const double *bin)
{
  char name[48];
  double zero = gg_measure_histogram_height(bin, 1);
  snprintf(name, sizeof name, "velocity_deviation_%s", n->plain);
  gg_curve *c = gg_measure_curve_add(list, 2 * LOW + 1, name,
                                     spin ? "Ω: deviation from a Gaussian" : "C: deviation from a Gaussian", n->label);
  gg_measure_curve_axes(c, n->argument, "1", "P/P(0) - exp(-x^2/2)", "1");
  for (int i = 0; i < (int)c->n; i++) {
    double x = (i - LOW) * GG_HISTOGRAM_WIDTH;
    c->x[i] = x, c->value[i] = bin[GG_HISTOGRAM_HALF - LOW + i] / zero - exp(-x * x / 2);
  }
  gg_measure_curve_beside(c, "Gaussian", gg_measure_curve_level, &(double){0});
}

void gg_measure_velocity_curves_put(gg_curves *list, gg_velocity_component which, const double *bin, double samples)
{
  naming n = name_of(which);
  put_distribution(list, &n, which.spin, bin, samples);
  put_deviation(list, &n, which.spin, bin);
}
