/* A panel of a figure. */
#include <string.h>

#include "reproduce/node.h"
#include "scene/fields.h"

static gg_status read_axis(const gg_entry_reader *r, const yaml_node_t *map, gg_figure_axis *axis)
{
  GG_TRY(gg_reproduce_entry_text(r, map, "label", &axis->label));
  GG_TRY(gg_reproduce_entry_flag(r, map, "log", &axis->log));
  GG_TRY(gg_reproduce_entry_number(r, map, "from", &axis->from));
  GG_TRY(gg_reproduce_entry_number(r, map, "to", &axis->to));
  if (!gg_reproduce_entry_get(r, map, "from") != !gg_reproduce_entry_get(r, map, "to") || axis->from > axis->to)
    return gg_reproduce_entry_refuse(r, map, "from", "and to come together, from below to");
  return GG_OK;
}

static gg_status read_x(const gg_entry_reader *r, const yaml_node_t *map, gg_figure_panel *p)
{
  double bins = 1;
  p->bins = 1;
  if (!map) return GG_OK;
  GG_TRY(gg_reproduce_entry_keys(r, map, "x", "key number label as from to log bins"));
  GG_TRY(gg_reproduce_entry_text(r, map, "key", &p->key));
  if (p->key && !gg_scene_key_exists(p->key))
    return gg_reproduce_entry_refuse(r, map, "key", "'%s' is no key of a scene", p->key);
  GG_TRY(gg_reproduce_entry_text(r, map, "number", &p->number));
  GG_TRY(gg_reproduce_entry_number(r, map, "bins", &bins));
  p->bins = bins >= 1 ? (int)bins : 1;
  GG_TRY(gg_reproduce_entry_formula(r, map, "as", &p->x.as));
  return read_axis(r, map, &p->x);
}

static gg_status read_y(const gg_entry_reader *r, const yaml_node_t *map, gg_figure_panel *p)
{
  GG_TRY(gg_reproduce_entry_keys(
      r, map, "y", "quantity number curve series frames snapshot tail frame beside relative_to as label from to log"));
  GG_TRY(gg_reproduce_entry_read_source(r, map, &p->source));
  return read_axis(r, map, &p->y);
}

static gg_status read_lines(const gg_entry_reader *r, const yaml_node_t *map, gg_figure_panel *p)
{
  if (!map) return GG_OK;
  GG_TRY(gg_reproduce_entry_keys(r, map, "lines", "by label as"));
  GG_TRY(gg_reproduce_entry_texts(r, map, "by", &p->lines));
  GG_TRY(gg_reproduce_entry_texts(r, map, "label", &p->line_labels));
  GG_TRY(gg_reproduce_entry_formula(r, map, "as", &p->line_as));
  for (int i = 0; i < p->lines.n; i++)
    if (!gg_scene_key_exists(p->lines.text[i]))
      return gg_reproduce_entry_refuse(r, map, "by", "'%s' is no key of a scene", p->lines.text[i]);
  if (!p->lines.n) return gg_reproduce_entry_refuse(r, map, "lines", "are by a scene key: give it");
  if (p->line_labels.n && p->line_labels.n != p->lines.n)
    return gg_reproduce_entry_refuse(r, map, "label", "is one for each key of the lines");
  return GG_OK;
}

static gg_status read_guides(const gg_entry_reader *r, const yaml_node_t *list, gg_figure_panel *p)
{
  if (!list) return GG_OK;
  if (list->type != YAML_SEQUENCE_NODE) return gg_reproduce_entry_refuse(r, list, "guides", "is a list of {label, as}");
  for (yaml_node_item_t *i = list->data.sequence.items.start; i < list->data.sequence.items.top; i++) {
    const yaml_node_t *map = yaml_document_get_node(r->document, *i);
    GG_TRY(gg_reproduce_entry_keys(r, map, "guides", "label as"));
    if (p->n_guides == GG_MOST_NAMES)
      return gg_reproduce_entry_refuse(r, map, "guides", "are more than %d", GG_MOST_NAMES);
    gg_guide *guide = &p->guide[p->n_guides++];
    GG_TRY(gg_reproduce_entry_text(r, map, "label", &guide->label));
    GG_TRY(gg_reproduce_entry_formula(r, map, "as", &guide->as));
    if (!guide->label || !guide->as.n)
      return gg_reproduce_entry_refuse(r, map, "guides", "have a label and a formula each");
  }
  return GG_OK;
}

static gg_status check_together(const gg_entry_reader *r, const yaml_node_t *map, const gg_figure_panel *p)
{
  bool over_key = p->source.kind == GG_OF_QUANTITY || (p->source.kind == GG_OF_NUMBER && !p->number);
  if (over_key && !p->key) return gg_reproduce_entry_refuse(r, map, "x", "needs the scene key that this is drawn over");
  if (!over_key && p->key)
    return gg_reproduce_entry_refuse(r, map, "x", "has no scene key here: the curve brings its own");
  if (p->theories.n && p->source.kind != GG_OF_QUANTITY)
    return gg_reproduce_entry_refuse(r, map, "theories", "speak of quantities alone");
  return GG_OK;
}

gg_status gg_reproduce_entry_read_panel(const gg_entry_reader *r, const yaml_node_t *map, gg_figure_panel *p)
{
  GG_TRY(gg_reproduce_entry_keys(r, map, "panels", "title of x y lines where engines theories theories_over guides"));
  GG_TRY(gg_reproduce_entry_text(r, map, "title", &p->title));
  GG_TRY(gg_reproduce_entry_texts(r, map, "of", &p->of));
  GG_TRY(read_x(r, gg_reproduce_entry_get(r, map, "x"), p));
  GG_TRY(read_y(r, gg_reproduce_entry_get(r, map, "y"), p));
  GG_TRY(read_lines(r, gg_reproduce_entry_get(r, map, "lines"), p));
  GG_TRY(gg_reproduce_entry_conditions(r, map, "where", &p->where));
  GG_TRY(gg_reproduce_entry_texts(r, map, "engines", &p->engines));
  for (int i = 0; i < p->engines.n; i++)
    if (strcmp(p->engines.text[i], "md") != 0 && strcmp(p->engines.text[i], "dsmc") != 0)
      return gg_reproduce_entry_refuse(r, map, "engines", "are md and dsmc");
  GG_TRY(gg_reproduce_entry_texts(r, map, "theories", &p->theories));
  GG_TRY(gg_reproduce_entry_check_theories(r, map, &p->theories));
  GG_TRY(gg_reproduce_entry_texts(r, map, "theories_over", &p->theories_over));
  GG_TRY(read_guides(r, gg_reproduce_entry_get(r, map, "guides"), p));
  return check_together(r, map, p);
}
