/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/engine.h"

/* The engines there are; a new one is a line here. */
const gg_engine_ops *gg_run_engine_ops_of(gg_engine_kind kind)
{
  return kind == GG_DSMC ? &gg_dsmc_ops : &gg_md_ops;
}
