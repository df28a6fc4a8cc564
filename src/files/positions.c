/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "files/positions.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/engine_grains.h"
#include "files/h5/result_reader.h"
#include "scene/scene.h"

static const char *const elements[] = {"H", "He", "Li", "Be", "B",  "C",  "N", "O",
                                       "F", "Ne", "Na", "Mg", "Al", "Si", "P", "S"};
_Static_assert(sizeof elements / sizeof *elements >= GG_MAX_SPECIES, "an element for each species");

const char *gg_files_xyz_element(int species)
{
  return elements[species < GG_MAX_SPECIES ? species : 0];
}

bool gg_files_positions_are_read(const gg_scene *s)
{
  return *s->start.positions && strcmp(s->start.positions, GG_LATTICE) != 0;
}

/* Species are numbers from 1, or elements as in exported files; GG_MAX_SPECIES: another word. */
static int species_of(const char *word)
{
  const long number = strtol(word, NULL, 10);
  int k = 0;
  if (number > 0) return number <= GG_MAX_SPECIES ? (int)number - 1 : GG_MAX_SPECIES;
  while (k < GG_MAX_SPECIES && strcmp(word, elements[k]) != 0) k++;
  return k;
}

/* First column of a property in "Properties=species:S:1:pos:R:3:..."; `otherwise` if there is no such text; -1: others
 * are listed there. */
static int column_of(const char *head, const char *property, int otherwise)
{
  char name[32], type;
  int width, length, column = 0;
  const char *at = strstr(head, "Properties=");
  if (!at) return otherwise;
  at += strlen("Properties=");
  while (sscanf(at, "%31[^: ]:%c:%3d%n", name, &type, &width, &length) == 3 && width > 0) {
    if (strcmp(name, property) == 0) return column;
    if (at[length] != ':') break;
    at += length + 1, column += width;
  }
  return -1;
}

static bool read_row(char *line, int species, int position, gg_positions *to, size_t i)
{
  char *rest = NULL, *end = NULL, *word = strtok_r(line, " \t\r\n", &rest);
  const int columns = species < position + 3 ? position + 3 : species + 1;
  int column = 0;
  for (; word && column < columns; word = strtok_r(NULL, " \t\r\n", &rest), column++) {
    if (column == species) to->species[i] = species_of(word);
    if (column < position || column >= position + 3) continue;
    to->r[3 * i + (size_t)(column - position)] = strtod(word, &end);
    if (*end) return false;
  }
  return column == columns;
}

/* The first frame. A file that graingas exported has the unit of length of its model, as *own says. */
static gg_status read_xyz(const char *path, size_t n, bool mixture, gg_positions *to, double edges[9], bool *own,
                          gg_error *err)
{
  char line[4096] = "";
  size_t there = 0, i = 0;
  GG_CLOSED FILE *in = fopen(path, "r");
  if (!in) return gg_base_fail(err, GG_BAD_FILE, "cannot be read: %s", strerror(errno));
  bool good = fgets(line, sizeof line, in) && sscanf(line, "%zu", &there) == 1 && fgets(line, sizeof line, in);
  const int species = column_of(line, "species", 0), position = column_of(line, "pos", 1);
  good = good && position >= 0;
  *own = strstr(line, "length_unit=\"d\"") || strstr(line, "length_unit=d");
  char *at = strstr(line, "Lattice=\"");
  if (at) at += strlen("Lattice=\"");
  for (int k = 0; at && k < 9; k++) edges[k] = strtod(at, &at);
  for (; good && i < n && i < there; i++)
    good = fgets(line, sizeof line, in) && read_row(line, species, position, to, i);
  if (!good) return GG_REFUSE(err, "line %zu is not one of extended XYZ", i ? i + 2 : 1);
  if (mixture && species < 0) return GG_REFUSE(err, "Properties has no species, and the scene several");
  to->n = there;
  return GG_OK;
}

/* The last frame of a trajectory; a result's unit of length is that of its model. */
static gg_status read_h5md(const char *path, size_t n, gg_positions *to, double edges[9], gg_error *err)
{
  GG_CLEARED(gg_files_stored_trajectory_close) gg_stored_trajectory t = {0};
  GG_CLEARED(gg_measure_frame_free) gg_frame frame = {0};
  GG_TRY(gg_files_stored_trajectory_open(&t, path, err));
  if (!t.n_frames) return gg_base_fail(err, GG_BAD_FILE, GG_NO_POSITIONS);
  GG_TRY(gg_files_stored_trajectory_frame(&t, t.n_frames - 1, &frame, edges, err));
  to->n = t.n;
  for (size_t i = 0; i < n && i < t.n; i++) {
    memcpy(to->r + 3 * i, frame.position + 3 * i, 3 * sizeof *to->r);
    to->species[i] = t.species[i];
  }
  return GG_OK;
}

gg_status gg_files_positions_read(const gg_scene *scene, const gg_model *model, gg_positions *to, gg_error *err)
{
  const char *path = scene->start.positions, *ending = strrchr(path, '.');
  bool own = ending && strcmp(ending, ".h5") == 0;
  const size_t n = (size_t)model->n;
  double edges[9] = {0};
  *to = (gg_positions){0};
  if (!gg_files_positions_are_read(scene)) return GG_OK;
  to->r = gg_base_array_new(3 * n, sizeof *to->r, err);
  to->species = gg_base_array_new(n, sizeof *to->species, err);
  if (!to->r || !to->species) return GG_FAILED;
  to->grains = (gg_grain_arrays){.r = to->r, .species = model->n_species > 1 ? to->species : NULL};
  gg_status status;
  if (own) {
    status = read_h5md(path, n, to, edges, err);
    if (status != GG_OK) return gg_base_error_prefix(err, status, "start.positions"); /* the path is there */
  } else {
    status = read_xyz(path, n, model->n_species > 1, to, edges, &own, err);
  }
  if (status == GG_OK)
    status = gg_common_positions_fit(model, to->n, edges, own ? 1 : 1 / model->unit.length, to->r, to->species, err);
  return status == GG_OK ? GG_OK : gg_base_error_prefix(err, status, "start.positions: %s", path);
}

void gg_files_positions_free(gg_positions *p)
{
  free(p->r);
  free(p->species);
  *p = (gg_positions){0};
}
