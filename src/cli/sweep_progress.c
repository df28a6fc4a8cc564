/* Where a sweep stands: a live line on a terminal, and a plain one now and then otherwise. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/number_format.h"
#include "cli/sweep.h"

static void describe(const gg_sweep_progress *p, char *text, size_t size)
{
  char left[24];
  size_t used = (size_t)snprintf(text, size, "%zu of %zu points done, %zu running", p->done, p->points, p->running);
  if (p->elsewhere && used < size)
    used += (size_t)snprintf(text + used, size - used, ", %zu in other processes", p->elsewhere);
  if (p->fell_short && used < size) used += (size_t)snprintf(text + used, size - used, ", %zu short", p->fell_short);
  if (p->failed && used < size) used += (size_t)snprintf(text + used, size - used, ", %zu failed", p->failed);
  if (p->relative_error > 0 && isfinite(p->relative_error) && used < size)
    used += (size_t)snprintf(text + used, size - used, ", error up to %.2g %%", 100 * p->relative_error);
  if (!isfinite(p->time_left) || p->done + p->failed == p->points || used >= size) return;
  gg_cli_format_duration(p->time_left, left, sizeof left);
  snprintf(text + used, size - used, ", %s left", left);
}

void gg_cli_sweep_show_progress(void *context, const gg_sweep_progress *p)
{
  char line[240];
  gg_sweep_command *c = context;
  describe(p, line, sizeof line);
  bool over = p->done + p->failed == p->points;
  gg_cli_line_show(&c->line, line, over && !c->over);
  c->over |= over;
}
