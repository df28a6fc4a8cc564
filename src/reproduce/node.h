/* Maps and lists of an entry, read with messages that name file, line and key. */
#ifndef GG_ENTRY_NODE_H
#define GG_ENTRY_NODE_H

#include "reproduce/entry.h"

typedef struct gg_entry_reader {
  yaml_document_t *document;
  const char *file, *text;
  gg_error *err;
} gg_entry_reader;

gg_status gg_reproduce_entry_refuse(const gg_entry_reader *r, const yaml_node_t *node, const char *key,
                                    const char *format, ...) GG_PRINTF(4, 5);

/* The value under a key of a map; NULL: not given. */
const yaml_node_t *gg_reproduce_entry_get(const gg_entry_reader *r, const yaml_node_t *map, const char *key);
/* Is it a map of these keys alone ("x y lines")? Others are refused, the nearest named. */
gg_status gg_reproduce_entry_keys(const gg_entry_reader *r, const yaml_node_t *map, const char *what, const char *keys);

/* Each leaves its output as it is where the key is not given. */
gg_status gg_reproduce_entry_text(const gg_entry_reader *r, const yaml_node_t *map, const char *key, const char **text);
gg_status gg_reproduce_entry_number(const gg_entry_reader *r, const yaml_node_t *map, const char *key, double *number);
gg_status gg_reproduce_entry_flag(const gg_entry_reader *r, const yaml_node_t *map, const char *key, bool *flag);
gg_status gg_reproduce_entry_formula(const gg_entry_reader *r, const yaml_node_t *map, const char *key,
                                     gg_expression *e);
/* One text or a list of them. */
gg_status gg_reproduce_entry_texts(const gg_entry_reader *r, const yaml_node_t *map, const char *key, gg_texts *texts);
/* {KEY: VALUE or [VALUES], ...} of scene keys. */
gg_status gg_reproduce_entry_conditions(const gg_entry_reader *r, const yaml_node_t *map, const char *key,
                                        gg_conditions *all);

/* read_source.c, read_panel.c, read_number.c: the parts of an entry. */
gg_status gg_reproduce_entry_read_source(const gg_entry_reader *r, const yaml_node_t *map, gg_source *source);
gg_status gg_reproduce_entry_read_panel(const gg_entry_reader *r, const yaml_node_t *map, gg_figure_panel *panel);
gg_status gg_reproduce_entry_read_stated(const gg_entry_reader *r, const yaml_node_t *map, gg_stated *stated);
gg_status gg_reproduce_entry_check_theories(const gg_entry_reader *r, const yaml_node_t *map, const gg_texts *names);

#endif
