#include "files/export/xyz.h"

#include <math.h>
#include <stdio.h>

#include "common/species.h"

static const char *const elements[] = {"H", "He", "Li", "Be", "B",  "C",  "N", "O",
                                       "F", "Ne", "Na", "Mg", "Al", "Si", "P", "S"};
_Static_assert(sizeof elements / sizeof *elements >= GG_MAX_SPECIES, "an element for each species");

static void put_numbers(gg_text_out *out, const double *x, int n, const char *before)
{
  for (int a = 0; a < n; a++) {
    gg_base_file_writer_put(out, a ? " " : before);
    gg_base_file_writer_put_number(out, x[a]);
  }
}

static void put_word(gg_text_out *out, const char *key, const char *value)
{
  gg_base_file_writer_put(out, " ");
  gg_base_file_writer_put(out, key);
  gg_base_file_writer_put(out, "=\"");
  gg_base_file_writer_put(out, value);
  gg_base_file_writer_put(out, "\"");
}

static void put_number(gg_text_out *out, const char *key, double value)
{
  gg_base_file_writer_put(out, " ");
  gg_base_file_writer_put(out, key);
  gg_base_file_writer_put(out, "=");
  gg_base_file_writer_put_number(out, value);
}

static void put_head(gg_text_out *out, const gg_stored_trajectory *t, const gg_frame *f, const double *edges)
{
  char text[64];
  snprintf(text, sizeof text, "%zu\n", f->n);
  gg_base_file_writer_put(out, text);
  put_numbers(out, edges, 9, "Lattice=\"");
  gg_base_file_writer_put(out, "\" Properties=species:S:1:pos:R:3:velo:R:3");
  if (f->spin) gg_base_file_writer_put(out, ":omega:R:3");
  gg_base_file_writer_put(out, ":radius:R:1:mass:R:1:id:I:1");
  snprintf(text, sizeof text, "%s %s %s", t->periodic[0] ? "T" : "F", t->periodic[1] ? "T" : "F",
           t->periodic[2] ? "T" : "F");
  put_word(out, "pbc", text);
  put_number(out, "Time", f->time);
  snprintf(text, sizeof text, " collisions=%llu", (unsigned long long)f->step);
  gg_base_file_writer_put(out, text);
  put_number(out, "shear_rate", t->shear_rate);
  put_word(out, "length_unit", t->length_unit);
  put_word(out, "velocity_unit", t->velocity_unit);
  if (t->spin_unit) put_word(out, "omega_unit", t->spin_unit);
  put_word(out, "time_unit", t->time_unit);
  gg_base_file_writer_put(out, "\n");
}

/* Another image along x, if the cell leans away from this one. */
static double into_cell(double x, double y, const double *edges)
{
  double lean = edges[3], length = edges[0];
  return lean == 0 ? x : x - length * floor((x - lean * (y / edges[4])) / length);
}

void gg_files_xyz_frame(gg_text_out *out, const gg_stored_trajectory *t, const gg_frame *f, const double edges[9])
{
  put_head(out, t, f, edges);
  for (size_t i = 0; i < f->n && out->status == GG_OK; i++) {
    char id[24];
    const double *r = f->position + 3 * i, place[3] = {into_cell(r[0], r[1], edges), r[1], r[2]};
    const double radius_mass[2] = {0.5 * t->diameter[i], t->mass[i]};
    gg_base_file_writer_put(out, elements[t->species[i] < GG_MAX_SPECIES ? t->species[i] : 0]);
    put_numbers(out, place, 3, " ");
    put_numbers(out, f->velocity + 3 * i, 3, " ");
    if (f->spin) put_numbers(out, f->spin + 3 * i, 3, " ");
    put_numbers(out, radius_mass, 2, " ");
    snprintf(id, sizeof id, " %zu\n", i);
    gg_base_file_writer_put(out, id);
  }
}
