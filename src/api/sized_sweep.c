/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Of sweeps. */
#include "api/sized.h"

GG_WRITES(gg_sweep_at, gg_sweep_point, point,
          (const gg_sweep *sweep, size_t i, gg_sweep_point *point, gg_error *err, size_t size), (sweep, i, point, err))
GG_READS(gg_sweep_run, gg_sweep_options, options,
         (gg_sweep * sweep, const char *folder, const gg_sweep_options *options, gg_error *err, size_t size),
         (sweep, folder, options, err))
GG_READS(gg_sweep_run_point, gg_sweep_options, options,
         (gg_sweep * sweep, const char *folder, size_t i, const gg_sweep_options *options, gg_error *err, size_t size),
         (sweep, folder, i, options, err))
GG_READS(gg_sweep_collect, gg_collecting, options,
         (gg_sweep * sweep, const char *folder, const char *prefix, const gg_collecting *options,
          void (*written)(void *context, const char *file), void *context, gg_error *err, size_t size),
         (sweep, folder, prefix, options, written, context, err))
GG_READS(gg_sweep_validate, gg_validating, options,
         (gg_sweep * sweep, const char *folder, const gg_validating *options,
          void (*written)(void *context, const char *file), void *context, char **verdict, gg_error *err, size_t size),
         (sweep, folder, options, written, context, verdict, err))
