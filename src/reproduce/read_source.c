/* What a panel or a number of the paper is of. */
#include <stdio.h>
#include <string.h>

#include "common/quantity.h"
#include "measure/stretched_tail.h"
#include "reproduce/node.h"
#include "theory/theory.h"

gg_status gg_reproduce_entry_check_theories(const gg_entry_reader *r, const yaml_node_t *map, const gg_texts *names)
{
  for (int i = 0; i < names->n; i++)
    if (!gg_theory_find(names->text[i]))
      return gg_reproduce_entry_refuse(r, gg_reproduce_entry_get(r, map, "theories"), "theories",
                                       "there is no theory '%s'", names->text[i]);
  return names->n > GG_MOST_NAMES ? gg_reproduce_entry_refuse(r, map, "theories", "are more than %d", GG_MOST_NAMES)
                                  : GG_OK;
}

static gg_status check_quantities(const gg_entry_reader *r, const yaml_node_t *map, const char *key, const gg_source *s)
{
  for (int i = 0; i < s->names.n; i++)
    if (gg_common_quantity_find(s->names.text[i]) == GG_N_QUANTITIES)
      return gg_reproduce_entry_refuse(r, gg_reproduce_entry_get(r, map, key), key, "there is no quantity '%s'",
                                       s->names.text[i]);
  return GG_OK;
}

/* {theory: lun1991}, or scene keys. */
static gg_status read_relative(const gg_entry_reader *r, const yaml_node_t *map, gg_source *s)
{
  const yaml_node_t *to = gg_reproduce_entry_get(r, map, "relative_to");
  if (!to) return GG_OK;
  if (!gg_reproduce_entry_get(r, to, "theory"))
    return gg_reproduce_entry_conditions(r, map, "relative_to", &s->relative_to);
  GG_TRY(gg_reproduce_entry_keys(r, to, "relative_to", "theory"));
  GG_TRY(gg_reproduce_entry_text(r, to, "theory", &s->relative_theory));
  if (gg_theory_find(s->relative_theory)) return GG_OK;
  return gg_reproduce_entry_refuse(r, to, "theory", "there is no theory '%s'", s->relative_theory);
}

static gg_status read_tail(const gg_entry_reader *r, const yaml_node_t *map, gg_source *s)
{
  const yaml_node_t *node = gg_reproduce_entry_get(r, map, "tail");
  gg_texts ends = {0};
  GG_TRY(gg_reproduce_entry_texts(r, map, "tail", &ends));
  if (!node) return GG_OK;
  if (ends.n != 2 || sscanf(ends.text[0], "%lf", &s->tail[0]) != 1 || sscanf(ends.text[1], "%lf", &s->tail[1]) != 1 ||
      !(s->tail[0] > 0 && s->tail[0] < s->tail[1]))
    return gg_reproduce_entry_refuse(r, node, "tail", "is a range [from, to] of x/sigma above 0");
  bool measured = false;
  for (int k = 0; k < GG_TAIL_RANGES; k++)
    measured |=
        s->tail[0] == gg_measure_stretched_tail_range[k][0] && s->tail[1] == gg_measure_stretched_tail_range[k][1];
  if (!measured)
    return gg_reproduce_entry_refuse(r, node, "tail", "is no range that fits are made over: [2, 4.5] or [3.3, 5.5]");
  if (s->number && (strcmp(s->number, "alpha") == 0 || strcmp(s->number, "gamma") == 0)) return GG_OK;
  return gg_reproduce_entry_refuse(r, node, "tail", "goes with number: alpha or gamma");
}

static gg_status read_names(const gg_entry_reader *r, const yaml_node_t *map, gg_source *s)
{
  static const char *const words[] = {"quantity", "number", "curve", "series", "frames", "snapshot"};
  static const gg_source_kind kinds[] = {GG_OF_QUANTITY, GG_OF_NUMBER, GG_OF_CURVE,
                                         GG_OF_SERIES,   GG_OF_FRAMES, GG_OF_SNAPSHOT};
  for (int k = 0; k < 6; k++) {
    if (!gg_reproduce_entry_get(r, map, words[k])) continue;
    s->kind = kinds[k];
    if (s->kind != GG_OF_NUMBER) return gg_reproduce_entry_texts(r, map, words[k], &s->names);
    GG_TRY(gg_reproduce_entry_text(r, map, "number", &s->number));
    GG_TRY(gg_reproduce_entry_texts(r, map, "curve", &s->names));
    return s->names.n ? GG_OK : gg_reproduce_entry_refuse(r, map, "number", "is that of a curve: give it");
  }
  return gg_reproduce_entry_refuse(r, map, "y",
                                   "names what is shown: quantity, number of a curve, curve, series or snapshot");
}

gg_status gg_reproduce_entry_read_source(const gg_entry_reader *r, const yaml_node_t *map, gg_source *s)
{
  double frame = 0;
  s->beside = true;
  GG_TRY(read_names(r, map, s));
  if (s->names.n > GG_MOST_NAMES) return gg_reproduce_entry_refuse(r, map, "y", "names more than %d", GG_MOST_NAMES);
  if (s->kind == GG_OF_QUANTITY) GG_TRY(check_quantities(r, map, "quantity", s));
  if (s->kind == GG_OF_SERIES) GG_TRY(check_quantities(r, map, "series", s));
  if (s->kind == GG_OF_SNAPSHOT &&
      (s->names.n != 1 || (strcmp(s->names.text[0], "xy") && strcmp(s->names.text[0], "zy"))))
    return gg_reproduce_entry_refuse(r, map, "snapshot", "is xy or zy");
  if (s->kind == GG_OF_FRAMES && (s->names.n != 1 || strcmp(s->names.text[0], "velocity") != 0))
    return gg_reproduce_entry_refuse(r, map, "frames", "is velocity");
  GG_TRY(read_tail(r, map, s));
  GG_TRY(gg_reproduce_entry_number(r, map, "frame", &frame));
  s->frame = (int)frame;
  GG_TRY(gg_reproduce_entry_flag(r, map, "beside", &s->beside));
  GG_TRY(read_relative(r, map, s));
  return gg_reproduce_entry_formula(r, map, "as", &s->as);
}
