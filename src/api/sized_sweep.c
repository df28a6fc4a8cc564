/* Functions with the sizes of the caller's structs (graingas.h, "Sizes") of sweeps and figures: what the caller's
 * compiler did not know of is zero where it is read, and left out where it is written. */
#include "api/sized.h"

gg_status gg_sweep_at_sized(const gg_sweep *sweep, size_t i, gg_sweep_point *point, gg_error *err, size_t point_size)
{
  gg_sweep_point all_point;
  GG_SIZE(gg_sweep_point, point_size);
  GG_TRY(gg_sweep_at(sweep, i, point ? &all_point : NULL, err));
  if (point) memcpy(point, &all_point, point_size);
  return GG_OK;
}

gg_status gg_sweep_run_sized(gg_sweep *sweep, const char *folder, const gg_sweep_options *options, gg_error *err,
                             size_t options_size)
{
  gg_sweep_options all_options = {0};
  GG_SIZE(gg_sweep_options, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_sweep_run(sweep, folder, options ? &all_options : NULL, err);
}

gg_status gg_sweep_run_point_sized(gg_sweep *sweep, const char *folder, size_t i, const gg_sweep_options *options,
                                   gg_error *err, size_t options_size)
{
  gg_sweep_options all_options = {0};
  GG_SIZE(gg_sweep_options, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_sweep_run_point(sweep, folder, i, options ? &all_options : NULL, err);
}

gg_status gg_sweep_collect_sized(gg_sweep *sweep, const char *folder, const char *prefix, const gg_collecting *options,
                                 void (*written)(void *context, const char *file), void *context, gg_error *err,
                                 size_t options_size)
{
  gg_collecting all_options = {0};
  GG_SIZE(gg_collecting, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_sweep_collect(sweep, folder, prefix, options ? &all_options : NULL, written, context, err);
}

gg_status gg_reproduce_sized(const char *figure, const gg_reproduce_options *options, gg_error *err,
                             size_t options_size)
{
  gg_reproduce_options all_options = {0};
  GG_SIZE(gg_reproduce_options, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_reproduce(figure, options ? &all_options : NULL, err);
}
