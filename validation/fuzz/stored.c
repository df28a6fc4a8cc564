/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stored.h"

#include <string.h>

static const char *const scenes[] = {"flow: usf\nphi: 0.2\nparticles: 12\ncollision: {e: 0.9, beta: 0, mu: "
                                     "0.5}\nmeasure: [rheology, velocity_distributions]\n",
                                     "flow: hcs\nphi: 0.1\ncollision: {e: 0.9, beta: 0, mu: 0.5}\nspecies: [{fraction: "
                                     "0.5}, {fraction: 0.5, mass: 2}]\ndsmc: {particles: 16}\n",
                                     "flow: couette\nphi: 0.1\nparticles: 20\nmeasure: [rheology, profiles]\n"};

enum { QUICK = 1 }; /* index of the scene for which theories take milliseconds */

/* Give a document without theories an empty set of them. Otherwise readers evaluate the theories for the scene, which
 * takes seconds for some. */
static void spare_theories(json_t *document, size_t scene)
{
  if (scene != QUICK && !json_is_object(json_object_get(document, "theory")))
    json_object_set_new(document, "theory", json_object());
}

bool fuzz_stored(gg_stored_result *s, const uint8_t *data, size_t size)
{
  static const char *const names[] = {"md", "dsmc"};
  *s = (gg_stored_result){0};
  if (size < 1) return false;
  const size_t scene = data[0] % (sizeof scenes / sizeof *scenes);
  json_t *document = s->document = json_loadb((const char *)data + 1, size - 1, 0, NULL);
  s->scene = strdup(scenes[scene]);
  s->version = strdup("0.1.0");
  if (!document || !s->scene || !s->version) return false;
  if (json_is_object(document)) spare_theories(document, scene);
  s->comparison = json_object_get(document, "comparison") != NULL;
  for (int k = 0; k < 2; k++) {
    json_t *part = s->comparison ? json_object_get(document, names[k]) : document;
    const char *engine = json_string_value(json_object_get(document, "engine"));
    if (!json_is_object(part) || (!s->comparison && (!engine || strcmp(engine, names[k]) != 0))) continue;
    s->engine[k].name = names[k];
    s->engine[k].document = part;
  }
  return true;
}
