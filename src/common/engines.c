/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/engine.h"

#define ENTRY(KIND, name, title) [GG_##KIND] = &gg_##name##_ops,
static const gg_engine_ops *const engines[GG_N_ENGINES] = {GG_ENGINES(ENTRY)};

const gg_engine_ops *gg_common_engine_of(int kind)
{
  return engines[kind];
}
