/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs in pieces, theories, comparisons; results of the command. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exports.h"

PAGE gg_session *page_session(const gg_scene *scene)
{
  gg_session *session = NULL;
  return gg_session_new(scene, &session, &page_why) == GG_OK ? session : NULL;
}
PAGE void page_session_free(gg_session *session)
{
  gg_session_free(session);
}
/* 1: finished; 2: call again; 0: failed. */
PAGE int page_session_go_on(gg_session *session, double milliseconds)
{
  int over = 0;
  return gg_session_advance(session, milliseconds / 1000, &over, &page_why) == GG_OK ? (over ? 1 : 2) : 0;
}
/* Fraction, averaging (0 or 1), collisions, relative error, seconds left; NaN: unknown. */
PAGE const double *page_session_progress(const gg_session *session)
{
  static double numbers[5];
  gg_progress now;
  if (gg_session_get_progress(session, &now, &page_why) != GG_OK) return NULL;
  const double all[] = {now.fraction, now.phase[0] == 'a', (double)now.collisions, now.relative_error, now.time_left};
  return memcpy(numbers, all, sizeof all);
}
PAGE char *page_session_json(gg_session *session)
{
  char *text = NULL;
  gg_result *result = NULL;
  gg_status status = gg_session_result(session, &result, &page_why);
  if (status == GG_OK) status = gg_result_to_json(result, &text, &page_why);
  gg_result_free(result);
  return text;
}

/* A comparison of a theory alone, of all with an empty name; sessions add their results. */
PAGE gg_comparison *page_comparison(const gg_scene *scene, const char *theory)
{
  gg_comparison *comparison = NULL;
  const char *name = *theory ? theory : NULL;
  return gg_theories_evaluate(scene, name, NULL, NULL, &comparison, &page_why) == GG_OK ? comparison : NULL;
}
PAGE void page_comparison_free(gg_comparison *comparison)
{
  gg_comparison_free(comparison);
}
PAGE int page_comparison_take(gg_comparison *comparison, gg_session *session)
{
  gg_result *result = NULL;
  gg_status status = gg_session_result(session, &result, &page_why);
  if (status == GG_OK) status = gg_comparison_take(comparison, result, &page_why);
  if (status != GG_OK) gg_result_free(result);
  return status == GG_OK;
}
PAGE char *page_comparison_json(const gg_comparison *comparison)
{
  char *text = NULL;
  return gg_comparison_to_json(comparison, &text, &page_why) == GG_OK ? text : NULL;
}

/* A whole run without a break, for tests. */
PAGE char *page_run_json(const gg_scene *scene)
{
  char *text = NULL;
  gg_result *result = NULL;
  gg_status status = gg_run(scene, NULL, &result, &page_why);
  if (result) gg_result_to_json(result, &text, NULL);
  gg_result_free(result);
  if (status == GG_OK) return text;
  free(text);
  return NULL;
}

/* T of free cooling by a theory; NaN: no answer, or the gas does not cool freely. */
PAGE double page_cooling(const gg_comparison *comparison, const char *theory, double time)
{
  double T = NAN;
  return gg_comparison_theory_cooling(comparison, theory, time, &T, &page_why) == GG_OK ? T : NAN;
}

/* ---- Results of the command ---- */

/* Compare one engine's result with the theories, which its file does not have. */
static gg_status beside_theories(gg_result *result, gg_comparison **comparison)
{
  gg_status status = gg_theories_evaluate(gg_result_scene(result), NULL, NULL, NULL, comparison, &page_why);
  if (status == GG_OK) status = gg_comparison_take(*comparison, result, &page_why);
  return status;
}

/* Read the result of a run or a comparison. */
PAGE gg_comparison *page_comparison_read(const char *path)
{
  gg_comparison *comparison = NULL;
  gg_result *result = NULL;
  if (gg_result_read(path, &result, &page_why) == GG_OK) {
    if (beside_theories(result, &comparison) == GG_OK) return comparison;
    gg_result_free(result);
    gg_comparison_free(comparison);
    comparison = NULL;
  }
  return gg_comparison_read(path, &comparison, &page_why) == GG_OK ? comparison : NULL;
}

/* History of a quantity of an engine: how many numbers, as many times, the numbers (NaN: none); to be freed. NULL:
 * not recorded. */
PAGE double *page_history(const gg_comparison *comparison, const char *engine, const char *quantity)
{
  size_t n = 0;
  const double *time = NULL, *value = NULL;
  const gg_result *result = gg_comparison_result(comparison, engine);
  if (!result || gg_result_history(result, quantity, &n, &time, &value, &page_why) != GG_OK) return NULL;
  double *all = malloc((2 * n + 1) * sizeof *all);
  if (!all) return page_fail("out of memory");
  all[0] = (double)n;
  memcpy(all + 1, time, n * sizeof *all);
  memcpy(all + 1 + n, value, n * sizeof *all);
  return all;
}
