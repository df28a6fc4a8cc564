/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gg_sweep_validate: grids of comparisons against Enskog's equation. */
#include "sweep/validation.h"

#include <stdlib.h>

#include "api/api.h"
#include "base/memory.h"
#include "io/output_path.h"
#include "plot/plot.h"

const char *gg_standard_grid(int quick)
{
  return quick ? gg_sweep_quick_grid : gg_sweep_standard_grid;
}

gg_status gg_sweep_validate(gg_sweep *sweep, const char *folder, const gg_validate_options *options,
                            void (*written)(void *context, const char *file), void *context, char **verdict,
                            gg_error *err)
{
  GG_NEED(sweep, folder, verdict);
  gg_validate_options o;
  GG_COPY_OPTIONS(o, options);
  GG_CLEARED(gg_sweep_point_table_clear) gg_point_table table = {0};
  const gg_stop stop = GG_STOP_OF(o.stop, context);
  *verdict = NULL;
  GG_TRY(gg_sweep_check(sweep, err));
  if (sweep->settings.does != GG_DOES_COMPARE)
    return GG_REFUSE(err, "%s: does: %s; validation needs does: compare", sweep->name, gg_sweep_does(sweep));
  if (gg_io_path_is_same_file(o.page, sweep->name))
    return GG_REFUSE(err, "%s: would be overwritten by its own page; choose another page", sweep->name);
  if (o.picture) GG_TRY(gg_plot_paper_check(o.picture, o.width, err));
  gg_status status = gg_sweep_point_table_read(&table, sweep, folder, &stop, err);
  if (status == GG_OK) {
    gg_sweep_point_table_warn(&table, "", o.warn, context);
    status = gg_sweep_validate_table(&table, sweep, &o, written, context, &stop, verdict, err);
  }
  status = gg_base_callback_settle(status, err);
  if (status != GG_OK && status != GG_FAILED) free(*verdict), *verdict = NULL;
  return status;
}
