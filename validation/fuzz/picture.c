/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: pictures of a result whose JSON document is the input (stored.h). The scripts for gnuplot must only draw
 * (script.h). Member `series` of the document: a list per quantity; `frame`: the last frame of a trajectory, with
 * `position`, `species`, `edge`. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/quantity.h"
#include "fuzz.h"
#include "plot/plot.h"
#include "script.h"
#include "stored.h"
#include "theory/theory.h"

/* Replaces the library's function of this name, as gg_plot_gnuplot_run does below. */
gg_status gg_plot_gnuplot_is_there(gg_error *err)
{
  (void)err;
  return GG_OK;
}

gg_status gg_plot_gnuplot_run(const char *script, const char *over, const char *picture, gg_error *err)
{
  (void)over, (void)picture, (void)err;
  fuzz_check_script(script);
  return GG_OK;
}

/* The linker puts this before the library's function. Curves of theories take nearly all the time of a picture: they
 * are there for one call in SOLVED, a prime number, so that every theory has its turn. */
enum { SOLVED = 31 };
gg_status __real_gg_theory_curves(const gg_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                                  gg_error *err);
gg_status __wrap_gg_theory_curves(const gg_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                                  gg_error *err);
gg_status __wrap_gg_theory_curves(const gg_theory *theory, const gg_model *model, unsigned measure, gg_curves *list,
                                  gg_error *err)
{
  static unsigned calls;
  return calls++ % SOLVED ? GG_FAILED : __real_gg_theory_curves(theory, model, measure, list, err);
}

enum { MOST_NUMBERS = 300 };

/* Numbers of a list, to be freed; NULL, with *n = 0, if it is not a list. */
static double *numbers_of(const json_t *list, size_t *n)
{
  *n = json_array_size(list);
  if (*n > MOST_NUMBERS) *n = MOST_NUMBERS;
  double *numbers = *n ? malloc(*n * sizeof *numbers) : NULL;
  for (size_t i = 0; numbers && i < *n; i++) numbers[i] = json_number_value(json_array_get(list, i));
  if (!numbers) *n = 0;
  return numbers;
}

static void add_series(gg_stored_engine *e, const json_t *all)
{
  for (int q = 0; e->name && q < GG_N_QUANTITIES && e->n_series < GG_MAX_STORED_SERIES; q++) {
    const char *name = gg_common_quantity_name((gg_quantity)q);
    const json_t *list = json_object_get(all, name);
    size_t n, n_times;
    if (!list) continue;
    gg_stored_series *s = &e->series[e->n_series];
    snprintf(s->name, sizeof s->name, "%s", name);
    s->value = numbers_of(list, &n);
    s->time = numbers_of(json_object_get(all, "time"), &n_times);
    s->n = n < n_times ? n : n_times;
    e->n_series++;
  }
}

/* Add the last frame. Its grains are those that have both a position and a species. */
static void add_frame(gg_stored_result *s, const json_t *frame)
{
  size_t n_positions, n_edges;
  double *edge = numbers_of(json_object_get(frame, "edge"), &n_edges);
  const json_t *species = json_object_get(frame, "species");
  s->last.position = numbers_of(json_object_get(frame, "position"), &n_positions);
  s->last.n = s->n_grains = n_positions / 3 < json_array_size(species) ? n_positions / 3 : json_array_size(species);
  s->last.species = s->last.n ? malloc(s->last.n) : NULL;
  for (size_t i = 0; s->last.species && i < s->last.n; i++)
    s->last.species[i] = (uint8_t)json_integer_value(json_array_get(species, i));
  for (size_t a = 0; a < 3 && a < n_edges; a++) s->edge[a] = edge[a];
  free(edge);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static const char *const names[] = {"x.svg", "x.png", "x.pdf"};
  static const char *const widths[] = {NULL, "86mm"};
  gg_stored_result s;
  gg_error err;
  if (fuzz_stored(&s, data, size)) {
    for (int k = 0; k < 2; k++) add_series(&s.engine[k], json_object_get(s.document, "series"));
    add_frame(&s, json_object_get(s.document, "frame"));
    const char *name = names[data[0] / 3 % 3];
    gg_plot_paper paper;
    if (gg_plot_paper_choose(&paper, name, NULL, widths[data[0] / 9 % 2], &err) == GG_OK &&
        gg_plot_result_draw(&s, &paper, name, &err) == GG_OK)
      gg_plot_pages_draw(&s, &paper, name, NULL, NULL, NULL, &err);
  }
  gg_files_stored_result_clear(&s);
  return 0;
}
