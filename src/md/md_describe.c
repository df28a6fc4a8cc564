/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Description of the methods for a model, for `graingas info`. */
#include <stdio.h>

#include "md/md_operations.h"
#include "md/parallel/parallel.h"
#include "md/select_search.h"

static void describe(void (*line)(void *, const char *), void *context, const char *what, const char *how)
{
  char text[200];
  snprintf(text, sizeof text, "%s: %s", what, how);
  line(context, text);
}

/* Describe the neighbour search, and why it was chosen. */
static void describe_search(const gg_model *m, void (*line)(void *, const char *), void *context)
{
  double radius;
  int32_t n[3];
  char text[160];
  const gg_md_search_kind kind = gg_md_search_select(m, &radius, n);
  const char *const why[] = {
      [GG_MD_PLAIN_CELLS] = "for intermediate densities, small boxes, ridges and open tops",
      [GG_MD_NEIGHBOUR_LISTS] = "for dense gases: few updates",
      [GG_MD_OVERLAPPING_CELLS] = "for dilute gases: few crossings, each into one cell",
      [GG_MD_OVERLAPPING_ROWS] = "for dilute gases: few crossings, each into one cell",
      [GG_MD_COMOVING_ROWS] = "for shear: cells move with the flow",
  };
  const char *const what[] = {[GG_MD_PLAIN_CELLS] = "cells",
                              [GG_MD_NEIGHBOUR_LISTS] = "neighbour lists",
                              [GG_MD_OVERLAPPING_CELLS] = "overlapping cells",
                              [GG_MD_OVERLAPPING_ROWS] = "overlapping cells",
                              [GG_MD_COMOVING_ROWS] = "cells that move with the flow"};
  int used = snprintf(text, sizeof text, "%s, %d x %d x %d cells, ", what[kind], n[0], n[1], n[2]);
  if (kind == GG_MD_NEIGHBOUR_LISTS)
    used += snprintf(text + used, sizeof text - (size_t)used, "skins of %.2g d, ", radius);
  snprintf(text + used, sizeof text - (size_t)used, "%s", why[kind]);
  describe(line, context, "search", text);
  double crossings = gg_md_crossings_per_collision(m);
  if (crossings < 100) return;
  snprintf(text, sizeof text, "%.2g a collision: so dilute a gas is slow; engine: dsmc is exact there", crossings);
  describe(line, context, "crossings of cells", text);
}

/* Describe the number of threads that a run can use, or why it is one. */
static void describe_threads(const gg_model *m, void (*line)(void *, const char *), void *context)
{
  char text[160];
  const char *serial = gg_md_serial_because(m);
  if (serial)
    snprintf(text, sizeof text, "one a replica, because of %s", serial);
  else if (m->n < GG_MD_FEWEST_PARALLEL)
    snprintf(text, sizeof text, "one a replica below %d grains", GG_MD_FEWEST_PARALLEL);
  else
    snprintf(text, sizeof text, "up to %d a replica share its events, with the same bits", gg_md_most_slabs(m));
  describe(line, context, "threads", text);
}

/* Describe the box: "a wall below, a wall above, periodic along x, z". */
static void describe_walls(const gg_model *m, void (*line)(void *, const char *), void *context)
{
  char text[160];
  size_t used = 0;
  for (int w = 0; w < m->n_surfaces && used < sizeof text; w++)
    used += (size_t)snprintf(text + used, sizeof text - used, "%s, ", m->surface[w].title);
  if (m->n_surfaces > 0 && m->surface[0].radius > 0 && used < sizeof text)
    used += (size_t)snprintf(text + used, sizeof text - used, "ridges %.4g d wide, ", 2 * m->surface[0].radius);
  for (int w = 0; w < m->n_surfaces && m->surface[w].accommodation > 0 && used < sizeof text; w++)
    used += (size_t)snprintf(text + used, sizeof text - used, "%s at T = %.4g, ", m->surface[w].word,
                             m->surface[w].temperature);
  if (gg_common_surface_is_open_above(m) && used < sizeof text)
    used += (size_t)snprintf(text + used, sizeof text - used, "open above, ");
  const char *before = "periodic along ";
  for (int a = 0; a < 3 && used < sizeof text; a++) {
    if (gg_common_surface_is_closed(m, a)) continue;
    used += (size_t)snprintf(text + used, sizeof text - used, "%s%c", before, "xyz"[a]);
    before = ", ";
  }
  describe(line, context, "box", text);
}

void gg_md_describe(const gg_model *m, void (*line)(void *context, const char *text), void *context)
{
  static const char *const rules[] = {"smooth: no spins, no tangential impulse", "rough, constant beta",
                                      "frictional (Coulomb)"};
  char timing[100];
  describe(line, context, "contact", rules[m->rule]);
  if (m->walled)
    describe_walls(m, line, context);
  else
    describe(line, context, "box", gg_model_is_sheared(m) ? "periodic, Lees-Edwards shear" : "periodic, no shear");
  bool falls = m->gravity[0] != 0 || m->gravity[1] != 0 || m->gravity[2] != 0;
  describe(line, context, "gravity", falls ? "parabolic flight" : "off: straight flight");
  describe(line, context, "species", m->n_species > 1 ? "several: coefficients by pair" : "one: coefficients fixed");
  if (m->law.name) describe(line, context, "restitution", "from the speed of each collision");
  if (m->kicks) describe(line, context, "kicks", "at every contact between grains");
  if (m->turns) describe(line, context, "torque", "exact between collisions");
  snprintf(timing, sizeof timing, "on, t_c = %g %s", m->contact_time, gg_common_model_contact_unit(m));
  describe(line, context, "contact-time rule", m->contact_time > 0 ? timing : "off: no memory of collisions");
  describe_search(m, line, context);
  describe_threads(m, line, context);
}
