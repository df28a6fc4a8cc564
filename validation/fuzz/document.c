/* The JSON document of a result, as it stands in a file, from its text to what `info --json` prints: means, curves,
 * theories, names of quantities that nobody knows. The first byte chooses the scene beside it. */
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "door/door.h"
#include "fuzz.h"
#include "graingas.h"
#include "io/h5/result_restore.h"
#include "text.h"

static const char *const scenes[] = {"flow: usf\nphi: 0.2\nparticles: 12\ncollision: {e: 0.9, beta: 0, mu: "
                                     "0.5}\nmeasure: [rheology, velocity_distributions]\n",
                                     "flow: hcs\nphi: 0.1\ncollision: {e: 0.9, beta: 0, mu: 0.5}\nspecies: [{fraction: "
                                     "0.5}, {fraction: 0.5, mass: 2}]\ndsmc: {particles: 16}\n",
                                     "flow: couette\nphi: 0.1\nparticles: 20\nmeasure: [rheology, profiles]\n"};

enum { QUICK = 1 }; /* the scene that theories take milliseconds for */

/* Without what theories said they are asked anew, of the scene, whatever else the file says: for some scenes in
 * seconds.
 */
static void spare_theories(json_t *document, size_t scene)
{
  if (scene != QUICK && !json_is_object(json_object_get(document, "theory")))
    json_object_set_new(document, "theory", json_object());
}

/* As gg_stored_result_read leaves it. */
static void fill(gg_stored_result *s, json_t *document)
{
  static const char *const names[] = {"md", "dsmc"};
  s->document = document;
  s->comparison = json_object_get(document, "comparison") != NULL;
  for (int k = 0; k < 2; k++) {
    json_t *part = s->comparison ? json_object_get(document, names[k]) : document;
    const char *engine = json_string_value(json_object_get(document, "engine"));
    if (!json_is_object(part) || (!s->comparison && (!engine || strcmp(engine, names[k]) != 0))) continue;
    s->engine[k].name = names[k];
    s->engine[k].document = part;
  }
}

static void ask_result(const gg_result *r)
{
  gg_measurement m;
  gg_curve_data curve;
  gg_result_info about;
  if (!r) return;
  gg_result_about(r, &about, NULL);
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
  gg_stored_result s = {0};
  if (size < 1) return 0;
  const size_t scene = data[0] % (sizeof scenes / sizeof *scenes);
  json_t *document = json_loadb((const char *)data + 1, size - 1, 0, NULL);
  gg_comparison *c = document ? calloc(1, sizeof *c) : NULL;
  if (json_is_object(document)) spare_theories(document, scene);
  if (document) fill(&s, document);
  s.scene = strdup(scenes[scene]);
  s.version = strdup("0.1.0");
  if (c && s.scene && gg_comparison_restore(&s, c, NULL) == GG_OK) ask(c);
  gg_comparison_free(c);
  gg_stored_result_clear(&s);
  return 0;
}
