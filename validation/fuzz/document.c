/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON document of a result, as it stands in a file, from its text to what `info --json` prints: means, curves,
 * theories, names of quantities that nobody knows. The first byte chooses the scene beside it. */
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "api/api.h"
#include "files/h5/result_restore.h"
#include "fuzz.h"
#include "graingas.h"
#include "stored.h"

static void ask_result(const gg_result *r)
{
  gg_measurement m;
  gg_curve_data curve;
  gg_result_info about;
  if (!r) return;
  gg_result_get_info(r, &about, NULL);
  for (size_t i = 0; gg_result_at(r, i, &m, NULL) == GG_OK; i++) gg_result_unit(r, m.name);
  for (size_t i = 0; gg_result_curve(r, i, &curve, NULL) == GG_OK; i++)
    for (size_t k = 0; gg_result_curve_number(r, i, k, &m, NULL) == GG_OK; k++)
      if (isnan(m.mean)) break;
  for (size_t i = 0; gg_result_warning(r, i); i++)
    if (i == 100) break;
}

static void ask(gg_comparison *c)
{
  char *text = NULL;
  double z;
  int beyond;
  gg_theory_info theory;
  gg_remark remark;
  gg_curve_data curve;
  ask_result(gg_comparison_result(c, "md"));
  ask_result(gg_comparison_result(c, "dsmc"));
  for (size_t i = 0; gg_comparison_theory(c, i, &theory, NULL) == GG_OK; i++)
    for (size_t k = 0; gg_comparison_theory_curve(c, theory.name, k, &curve, NULL) == GG_OK; k++)
      if (curve.n > 1000) break;
  for (size_t i = 0; gg_comparison_remark(c, i, &remark, NULL) == GG_OK; i++)
    if (i == 100) break;
  gg_comparison_agreement(c, "temperature", &z, &beyond, NULL);
  if (gg_comparison_to_json(c, &text, NULL) == GG_OK) free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  gg_stored_result s;
  gg_comparison *c = NULL;
  if (fuzz_stored(&s, data, size)) c = calloc(1, sizeof *c);
  if (c && gg_files_comparison_restore(&s, c, NULL) == GG_OK) ask(c);
  gg_comparison_free(c);
  gg_files_stored_result_clear(&s);
  return 0;
}
