/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that the engine runs. */
#include <math.h>

#include "md/md_operations.h"
#include "md/select_search.h"

/* Reject narrow boxes. Along a periodic edge a grain would meet two images of another; between walls two grains could
 * not pass each other, for which neither the start nor the cells are made. */
static gg_status check_box(const gg_model *m, gg_error *err)
{
  static const char *const edges[] = {"box edge along x", "box edge along y", "box edge along z"};
  double widest = gg_common_model_widest(m), least = 2 * widest * (1 + 1e-9);
  for (int a = 0; a < 3; a++) {
    if (m->box[a] >= least) continue;
    const double shrink = least / m->box[a], cube = shrink * shrink * shrink;
    const bool gap = a == 1 && m->walled;
    return gg_base_fail(err, GG_BAD_INPUT,
                        "particles: with particles = %lld and phi = %g the %s is %.4g diameters; below %.4g %s. "
                        "Allowed here: particles >= %.0f, or phi <= %.4g, or aspect with a longer edge along %c",
                        (long long)m->n, m->phi, gap ? "gap between the walls" : edges[a], m->box[a] / m->diameter[0],
                        least / m->diameter[0],
                        gap ? "grains could not pass each other" : "a grain would meet two images of another",
                        ceil((double)m->n * cube), m->phi / cube, "xyz"[a]);
  }
  return GG_OK;
}

/* Most crossings of cells between two collisions. In a very dilute gas each grain crosses the box again and again. */
#define MOST_CROSSINGS 1e7

static gg_status check_crossings(const gg_model *m, gg_error *err)
{
  double crossings = gg_md_crossings_per_collision(m);
  if (crossings <= MOST_CROSSINGS) return GG_OK;
  return gg_base_fail(
      err, GG_BAD_INPUT,
      "phi: at %g grains would cross %.1g cells between two collisions, hours for a collision a grain; allowed "
      "with engine: md: up to %.0g; engine: dsmc is exact at such densities",
      m->phi, crossings, MOST_CROSSINGS);
}

gg_status gg_md_accepts(const gg_model *m, gg_error *err)
{
  if (m->boltzmann)
    return gg_base_fail(err, GG_BAD_INPUT, "phi: event-driven dynamics needs phi > 0; phi = 0 is for engine: dsmc");
  if (m->phi > 0.6)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "phi: %g is too dense for an initial state without overlaps; allowed: up to 0.6", m->phi);
  if (m->n < 2) return gg_base_fail(err, GG_BAD_INPUT, "particles: %lld; at least 2 are needed", (long long)m->n);
  if (m->n > INT32_MAX / 4)
    return gg_base_fail(err, GG_BAD_INPUT, "particles: %lld; at most %d", (long long)m->n, INT32_MAX / 4);
  if (!gg_flow_runs_in(m->flow, GG_MD))
    return gg_base_fail(err, GG_BAD_INPUT, "flow: %s needs engine: dsmc", gg_flow_of(m->flow)->word);
  if (m->thermostat != GG_NO_THERMOSTAT && !gg_flow_takes(m->flow, m->thermostat))
    return gg_base_fail(err, GG_BAD_INPUT, "thermostat: not in flow: %s with engine: md", gg_flow_of(m->flow)->word);
  bool falls = m->gravity[0] != 0 || m->gravity[1] != 0 || m->gravity[2] != 0;
  if (falls && gg_flow_of(m->flow)->falling == GG_NEVER_FALLS)
    return gg_base_fail(err, GG_BAD_INPUT, "gravity: not in flow: %s", gg_flow_of(m->flow)->word);
  if (gg_common_surface_is_open_above(m) && m->gravity[1] >= 0)
    return gg_base_fail(err, GG_BAD_INPUT,
                        "walls.top: open needs gravity towards the lower wall: gravity: [gx, gy < 0, gz]");
  GG_TRY(check_box(m, err));
  return check_crossings(m, err);
}
