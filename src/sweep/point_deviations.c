/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deviations of the rows of a comparison from their reference, by the functions that `compare` uses. */
#include "sweep/point_deviations.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "files/h5/result_restore.h"
#include "run/causes.h"
#include "run/z_scores.h"

/* The causes of md's deviation in this quantity, in one line. */
static const char *join_causes(const gg_comparison *c, gg_quantity q, gg_string_list *texts)
{
  gg_causes causes;
  char line[sizeof causes.text] = "";
  gg_run_causes_of(c, q, &causes);
  for (int i = 0; i < causes.n; i++) gg_base_text_append(line, sizeof line, "%s%s", i ? "; " : "", causes.text[i]);
  gg_base_string_list_add(texts, "%s", line);
  return gg_base_string_list_at(texts, texts->n - 1);
}

static const gg_theory_answer *answer_of(const gg_comparison *c, const char *name)
{
  for (int i = 0; i < c->n_theories; i++)
    if (strcmp(c->theory[i].theory->name, name) == 0) return &c->theory[i].answer;
  return NULL;
}

static void set_deviation(gg_point_row *row, gg_quantity q, const gg_reference *reference)
{
  const gg_estimate mean = {.mean = row->mean, .error = row->theory ? NAN : row->error};
  const gg_departure d = gg_run_reference_deviation(q, &mean, &reference->value);
  row->reference = reference->method;
  row->reference_mean = reference->value.mean;
  row->difference = d.difference, row->difference_error = d.error;
  row->deviation = d.deviation, row->deviation_error = d.deviation_error;
  row->z = d.z;
}

/* The cause of a deviation: of md as in `compare`, of a theory its range. */
static void set_cause(gg_point_row *row, const gg_comparison *c, gg_quantity q, gg_string_list *texts)
{
  const gg_theory_answer *answer = row->theory ? answer_of(c, row->method) : NULL;
  if (row->theory) {
    gg_base_string_list_add(texts, "%s", answer ? gg_run_theory_cause(answer) : "a theory of the sweep's own");
    row->cause = gg_base_string_list_at(texts, texts->n - 1);
  } else if (strcmp(row->method, "md") == 0) {
    row->cause = join_causes(c, q, texts);
  }
}

/* A collapse: collisions that the contact-time rule treats are no longer rare. */
#define COLLAPSED 0.01

static const char *structure_of(const gg_comparison *c)
{
  char text[320];
  const gg_result *md = c->by_engine[GG_MD];
  if (!md) return NULL;
  const gg_engine_state *s = &md->engine_state;
  if ((double)s->treated > COLLAPSED * (double)s->collisions) return "collapsed";
  if (!gg_run_structure(md, text, sizeof text)) return NULL;
  return strstr(text, "clustered") ? "clustered" : "swirling";
}

static void compare_row(gg_point_table *t, gg_point_row *row, const gg_comparison *c)
{
  gg_reference reference;
  const gg_quantity_row *named = gg_run_rows_find(&c->rows, row->quantity);
  if (!named || !gg_run_reference_find(c, named, &reference) || strcmp(reference.method, row->method) == 0) return;
  const gg_estimate mean = {.mean = row->mean, .error = row->theory ? NAN : row->error};
  set_deviation(row, named->quantity, &reference);
  row->beyond =
      (row->theory || row->error > 0) && gg_run_is_beyond(&c->model, named->quantity, &mean, &reference.value);
  if (row->beyond) set_cause(row, c, named->quantity, &t->texts);
}

/* The comparison of a file, means alone: series and frames are not read. */
static gg_status restore(json_t *document, char *scene, gg_comparison *c, gg_error *err)
{
  gg_stored_result stored = {.comparison = true, .scene = scene, .document = document};
  for (int k = 0; k < GG_N_ENGINES; k++) {
    const char *name = gg_common_engine_of(k)->name;
    json_t *part = json_object_get(document, name);
    if (json_is_object(part)) stored.engine[k] = (gg_stored_engine){.name = name, .document = part};
  }
  return gg_files_comparison_restore(&stored, c, err);
}

gg_status gg_sweep_point_deviations(gg_point_table *t, size_t first, json_t *document, char *scene, gg_error *err)
{
  for (size_t i = first; i < t->n; i++) {
    gg_point_row *row = &t->row[i];
    row->reference_mean = row->difference = row->difference_error = row->deviation = row->deviation_error = row->z =
        NAN;
  }
  if (!json_object_get(document, "comparison")) return GG_OK;
  gg_comparison *c = gg_base_array_new(1, sizeof *c, err);
  if (!c) return GG_FAILED;
  const unsigned before = gg_base_memory_failures();
  gg_status status = restore(document, scene, c, err);
  for (size_t i = first; i < t->n && status == GG_OK; i++) {
    if (strcmp(t->row[i].method, "md") == 0) t->row[i].structure = structure_of(c);
    compare_row(t, &t->row[i], c);
  }
  gg_run_comparison_clear(c);
  free(c);
  return gg_base_memory_check(before, status, err);
}
