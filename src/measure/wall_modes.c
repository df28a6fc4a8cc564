/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/wall_modes.h"

#include <math.h>

/* Modes. With w = cos(k pi y/H), y from 0 to H: density <w>, momentum <u_x w>, temperature <C.C w>/3, species <w> of
 * the first alone; <> over grains. The first mode of the density is the centre of mass itself, <y> - H/2. */
enum {
  SPREAD = GG_WALL_CENTRE + 1,
  MOMENTUM,
  SHEAR = MOMENTUM + 1,
  BOW,
  WARM_SIDE,
  WARM_MIDDLE,
  SPECIES_SIDE,
  SPECIES_MIDDLE
};

static const struct {
  const char *name;
  int waves;    /* k */
  bool along_x; /* changes its sign with x */
} table[GG_MOST_WALL_MODES] = {
    [GG_WALL_CENTRE] = {"the centre of mass across the gap", 1, false},
    [SPREAD] = {"the density of the middle against that at the walls", 2, false},
    [MOMENTUM] = {"the momentum along the walls", 0, true},
    [SHEAR] = {"the shear across the gap", 1, true},
    [BOW] = {"the flow of the middle against that at the walls", 2, true},
    [WARM_SIDE] = {"the temperature of one half against the other", 1, false},
    [WARM_MIDDLE] = {"the temperature of the middle against that at the walls", 2, false},
    [SPECIES_SIDE] = {"species 1 on one side", 1, false},
    [SPECIES_MIDDLE] = {"species 1 in the middle", 2, false},
};

int gg_measure_wall_modes(const gg_model *m)
{
  if (!m->walled) return 0;
  return m->n_species > 1 ? GG_MOST_WALL_MODES : SPECIES_SIDE;
}

const char *gg_measure_wall_mode_name(int mode)
{
  return table[mode].name;
}

bool gg_measure_wall_mode_is_odd(const gg_model *m, int mode)
{
  gg_wall_symmetry symmetry = gg_wall_symmetry_of(m);
  if (symmetry == GG_NO_SYMMETRY) return false;
  bool across = table[mode].waves % 2 != 0;
  return symmetry == GG_TURNED && table[mode].along_x ? !across : across;
}

void gg_measure_wall_modes_take(const gg_model *m, const gg_slabs *slabs, double *row)
{
  double all = 0, first = 0, height = m->box[1];
  int n = gg_measure_wall_modes(m);
  for (int i = 0; i < n; i++) row[i] = 0;
  for (int k = 0; k < slabs->n; k++) {
    const gg_slab *slab = &slabs->slab[k];
    double y = (k + 0.5) / slabs->n, wave[3] = {1, cos(M_PI * y), cos(2 * M_PI * y)}, grains = slab->grains;
    all += grains, first += slab->first;
    row[GG_WALL_CENTRE] += grains * (y - 0.5) * height;
    row[SPREAD] += grains * wave[2];
    for (int w = 0; w < 3; w++) row[MOMENTUM + w] += slab->velocity[0] * wave[w];
    for (int w = 1; w < 3; w++) row[WARM_SIDE + w - 1] += grains * gg_measure_slab_temperature(slab) * wave[w];
    for (int w = 1; w < 3 && n > SPECIES_SIDE; w++) row[SPECIES_SIDE + w - 1] += slab->first * wave[w];
  }
  for (int i = 0; i < n; i++) row[i] /= i < SPECIES_SIDE ? all : first;
}
