/* Engines against Enskog's equation itself: a line for each below the table of a comparison. */
#include <math.h>
#include <stdio.h>

#include "cli/report.h"
#include "cli/wrap.h"

enum { ONE = 160, MOST = 800 };
static const double far = 3; /* standard errors */

/* "temperature by +1.9(3) %", "N1 by -0.012(3)" */
static void put_departure(const char *quantity, const gg_departure *d, char text[ONE])
{
  char number[64];
  bool ratio = !isnan(d->deviation);
  if (ratio)
    gg_format_estimate(100 * d->deviation, 100 * d->deviation_error, number, sizeof number);
  else
    gg_format_estimate(d->difference, d->error, number, sizeof number);
  snprintf(text, ONE, "%s by %s%s%s", quantity, number[0] == '-' ? "" : "+", number, ratio ? " %" : "");
}

/* The main quantities in which an engine is far off, in one line; how near the first of all is. */
typedef struct verdict {
  int compared, off;
  char list[MOST], first[ONE];
} verdict;

static void weigh(const gg_comparison *c, const char *engine, verdict *v)
{
  gg_entry q;
  gg_departure d;
  size_t used = 0;
  *v = (verdict){0};
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, gg_comparison_scene(c), &q, NULL) == GG_OK; i++) {
    char text[ONE];
    if (gg_comparison_departure(c, engine, q.name, &d, NULL) != GG_OK || isnan(d.z) || !d.headline) continue;
    put_departure(q.name, &d, text);
    if (!v->compared++) snprintf(v->first, sizeof v->first, "%s", text);
    if (fabs(d.z) > far) {
      if (used < MOST) used += (size_t)snprintf(v->list + used, MOST - used, "%s%s", v->off ? ", " : "", text);
      v->off++;
    }
  }
}

static void print(const char *engine, const verdict *v)
{
  if (v->off)
    gg_cli_print_paragraph(stdout, 2, "%s differs from Enskog's equation (enskog_hermite) in %s", engine, v->list);
  else
    gg_cli_print_paragraph(stdout, 2,
                           "%s agrees with Enskog's equation (enskog_hermite) within %g standard errors in %d main "
                           "quantities, %s",
                           engine, far, v->compared, v->first);
}

void gg_cli_print_verdicts(const gg_comparison *c)
{
  static const char *const engines[] = {"md", "dsmc"};
  bool any = false;
  for (int k = 0; k < 2; k++) {
    verdict v;
    weigh(c, engines[k], &v);
    if (!v.compared) continue;
    if (!any) printf("\n");
    any = true;
    print(engines[k], &v);
  }
}
