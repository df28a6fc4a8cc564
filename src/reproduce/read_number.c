/* An explicit number of the paper. */
#include <math.h>
#include <string.h>

#include "common/quantity.h"
#include "reproduce/node.h"
#include "scene/fields.h"

/* Half a unit of the last digit: 0.2401 is known to 0.00005. */
static double last_digit(const char *text)
{
  const char *point = strchr(text, '.');
  size_t digits = point ? strspn(point + 1, "0123456789") : 0;
  return 0.5 * pow(10, -(double)digits);
}

static gg_status read_find(const gg_entry_reader *r, const yaml_node_t *map, gg_stated *s)
{
  static const char *const words[] = {"value", "zero", "minimum", "maximum", "prefactor", "exponent"};
  const char *text = "value";
  GG_TRY(gg_reproduce_entry_text(r, map, "find", &text));
  for (s->find = GG_FIND_VALUE; s->find <= GG_FIND_EXPONENT; s->find++)
    if (strcmp(words[s->find], text) == 0) break;
  if (s->find > GG_FIND_EXPONENT)
    return gg_reproduce_entry_refuse(r, map, "find", "is zero, minimum, maximum, prefactor or exponent");
  if (s->find != GG_FIND_VALUE && !s->over)
    return gg_reproduce_entry_refuse(r, map, "find", "needs over: the key along which");
  return GG_OK;
}

gg_status gg_reproduce_entry_read_stated(const gg_entry_reader *r, const yaml_node_t *map, gg_stated *s)
{
  const char *text = NULL;
  GG_TRY(gg_reproduce_entry_keys(r, map, "numbers", "what where sweep over paper error find of x as at theories"));
  GG_TRY(gg_reproduce_entry_text(r, map, "what", &s->what));
  GG_TRY(gg_reproduce_entry_text(r, map, "where", &s->where));
  GG_TRY(gg_reproduce_entry_text(r, map, "sweep", &s->sweep));
  GG_TRY(gg_reproduce_entry_text(r, map, "over", &s->over));
  GG_TRY(gg_reproduce_entry_text(r, map, "paper", &text));
  if (!s->what || !text)
    return gg_reproduce_entry_refuse(r, map, "numbers", "say what they are, and what the paper has");
  GG_TRY(gg_reproduce_entry_number(r, map, "paper", &s->paper));
  s->error = last_digit(text);
  GG_TRY(gg_reproduce_entry_number(r, map, "error", &s->error));
  if (s->over && !gg_scene_key_exists(s->over))
    return gg_reproduce_entry_refuse(r, map, "over", "'%s' is no key of a scene", s->over);
  GG_TRY(read_find(r, map, s));
  const yaml_node_t *of = gg_reproduce_entry_get(r, map, "of");
  if (of && of->type == YAML_MAPPING_NODE) {
    GG_TRY(gg_reproduce_entry_keys(r, of, "of", "quantity number curve tail as relative_to"));
    GG_TRY(gg_reproduce_entry_read_source(r, of, &s->of));
  } else {
    GG_TRY(gg_reproduce_entry_texts(r, map, "of", &s->of.names));
    if (s->of.names.n != 1 || gg_common_quantity_find(s->of.names.text[0]) == GG_N_QUANTITIES)
      return gg_reproduce_entry_refuse(r, map, "of", "names one quantity, or is a map as y of a panel");
  }
  if (s->of.kind > GG_OF_NUMBER) return gg_reproduce_entry_refuse(r, of, "of", "is a quantity or a number of a curve");
  GG_TRY(gg_reproduce_entry_formula(r, map, "as", &s->of.as));
  GG_TRY(gg_reproduce_entry_formula(r, map, "x", &s->x));
  GG_TRY(gg_reproduce_entry_conditions(r, map, "at", &s->at));
  GG_TRY(gg_reproduce_entry_texts(r, map, "theories", &s->theories));
  return gg_reproduce_entry_check_theories(r, map, &s->theories);
}
