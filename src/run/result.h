/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result of a run: plain data, made by src/run, written by src/files and printed by src/cli. */
#ifndef GG_RESULT_H
#define GG_RESULT_H

#include "base/text.h"
#include "common/engine.h"
#include "common/quantity.h"
#include "measure/frame.h"
#include "measure/observable.h"

/* One mean. `mean` is NaN where it cannot be had, and `reason` then says why (empty: not measured in this scene). */
typedef struct gg_result gg_result; /* the handle of the public header */
typedef struct gg_scene gg_scene;

void gg_run_result_freed(gg_result **result); /* gg_result_free for GG_CLEARED */

typedef struct gg_estimate {
  double mean, error;      /* error: standard error, correlation in time accounted for; NaN if unknown */
  double correlation_time; /* integrated autocorrelation time, in the result's unit of it */
  uint64_t samples;        /* in the averaging window, all replicas */
  char reason[160];
} gg_estimate;

/* True if correlation times are in collisions per grain: while a gas cools or heats up for ever, times grow without
 * end. */
bool gg_run_quantity_counts_in_collisions(const gg_model *model);

/* Names, symbol and unit of a quantity in a scene, made once for a result or a comparison: whoever writes or prints
 * reads them here. */
typedef struct gg_quantity_row {
  gg_quantity quantity;
  const char *name, *unit, *doc;
  char symbol[48]; /* LaTeX; "" of a user-defined quantity */
} gg_quantity_row;

typedef struct gg_quantity_rows { /* in the order in which they are shown */
  int n;
  gg_quantity_row row[GG_MOST_QUANTITIES];
} gg_quantity_rows;
/* They borrow names from the model's extension. */
void gg_run_rows_make(const gg_model *model, gg_quantity_rows *rows);
/* NULL if there is none. */
const gg_quantity_row *gg_run_rows_find(const gg_quantity_rows *rows, const char *name);
const gg_quantity_row *gg_run_rows_at(const gg_quantity_rows *rows, gg_quantity quantity);

typedef enum gg_steadiness {
  GG_STEADY,
  GG_METASTABLE, /* no trend, but free cooling with friction: grains escape friction one by one (theory/spin_escape.h)
                  */
  GG_NOT_STEADY, /* still trending, or too short to tell */
  GG_HEATING     /* no steady state exists; followed as what it is */
} gg_steadiness;

/* True if means over the window have no trend. */
static inline bool gg_run_is_steady(gg_steadiness steadiness)
{
  return steadiness == GG_STEADY || steadiness == GG_METASTABLE;
}

/* The quantities of GG_FOLLOWED from the start to the end, one row a sample; the first replica. In a cooling run values
 * are scaled back to the units of the start. */
typedef struct gg_history {
  size_t n;
  double *time;                /* model units */
  double *value[GG_N_HISTORY]; /* NaN where there is none */
  double window[2];            /* averaging from .. to */
} gg_history;

/* GG_BAD_FILE: it is of no run of this model, as one from a file that was made to be read astray. */
gg_status gg_run_frame_check(const gg_frame *frame, const gg_model *model, gg_error *err);

typedef struct gg_effort {
  uint64_t collisions;
  double cpu_seconds, wall_seconds;
} gg_effort;

/* How the means of a run vary together. The covariance of two is their coefficient here times their errors, so that
 * that of a mean with itself is its error squared. Pairs are estimated one by one: of several means whose sum
 * nearly cancels the variance may come out negative. */
typedef struct gg_correlations {
  size_t n; /* means with an error; 0: not known */
  gg_quantity quantity[GG_MOST_QUANTITIES];
  double *coefficient; /* n x n; 1 on the diagonal */
} gg_correlations;

/* Covariance of two means; NaN with the reason in *why (one of the result's texts, or a constant). */
double gg_run_result_covariance(const gg_result *result, gg_quantity one, gg_quantity other, const char **why);

struct gg_result {
  gg_scene *scene; /* as run: overrides and seed included */
  gg_model model;
  const char *engine; /* "md", "dsmc" */
  gg_quantity_rows rows;
  const char *correlation_time_unit; /* that of time, or "collisions a grain" */
  gg_steadiness steadiness;
  char steadiness_text[256]; /* which quantity decided, and how */
  double escape_rate;      /* cooling with friction: fraction of grains that escape per collision a grain, estimated */
  char ensemble_text[200]; /* why so many grains, where the program chose; else "" */
  gg_estimate value[GG_MOST_QUANTITIES]; /* those of the rows */
  gg_correlations correlations;
  gg_history history;
  gg_curves curves;
  gg_frame final;       /* the first replica's last state */
  uint64_t window_step; /* as gg_frame.step: where its averaging window begins; 0 of a run that had no warm-up */
  gg_effort averaging, total;
  gg_engine_state engine_state; /* counts summed over replicas */
  gg_string_list warnings;
  struct {
    char *version, *command, *machine, *date, *document; /* document: JSON as it was stored */
    size_t frames;
  } origin;          /* of the file that it was read from; NULL of a run */
  gg_extension *own; /* names of what that file's program had brought; else NULL */
};

#define GG_WARN(result, ...) gg_base_string_list_add(&(result)->warnings, __VA_ARGS__)

/* Fill rows and correlation_time_unit, by the model. */
void gg_run_result_label(gg_result *result);

/* The headline quantities of a flow: what run.relative_error applies to. Returns how many. */
int gg_run_headline_quantities(const gg_model *model, gg_quantity headline[GG_N_QUANTITIES]);

/* The warning of results whose restitution follows no scene says so in these words. */
#define GG_OWN_LAW "the calling program's restitution law"

#endif
