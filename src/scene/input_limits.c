/* What is far beyond a scene is refused before it is read: libyaml takes a time quadratic in the depth of brackets, in
 * the anchors and in the directives of a text. */
#include <yaml.h>

#include "base/memory.h"
#include "scene/scene_reader.h"
#include "scene/yaml_node.h"

enum { MOST_TOKENS = 20000, DEEPEST = 16 }; /* the deepest of ours: collision: {e: {11: 1}}, 3 */

static int step_of(yaml_token_type_t type)
{
  switch (type) {
  case YAML_BLOCK_SEQUENCE_START_TOKEN:
  case YAML_BLOCK_MAPPING_START_TOKEN:
  case YAML_FLOW_SEQUENCE_START_TOKEN:
  case YAML_FLOW_MAPPING_START_TOKEN: return 1;
  case YAML_BLOCK_END_TOKEN:
  case YAML_FLOW_SEQUENCE_END_TOKEN:
  case YAML_FLOW_MAPPING_END_TOKEN: return -1;
  default: return 0;
  }
}

/* Text that is not YAML is for the reader to refuse, with its place. */
static gg_status check_tokens(const gg_scene_reader *r, yaml_parser_t *parser)
{
  yaml_token_type_t type = YAML_NO_TOKEN;
  for (int n = 0, depth = 0; type != YAML_STREAM_END_TOKEN; n++) {
    yaml_token_t token;
    if (!yaml_parser_scan(parser, &token)) return GG_OK;
    size_t line = token.start_mark.line + 1;
    type = token.type;
    yaml_token_delete(&token);
    depth += step_of(type);
    if (depth > DEEPEST)
      return gg_scene_refuse_text(r, line, "is not a scene: lists and maps stand more than %d deep in each other",
                                  DEEPEST);
    if (n == MOST_TOKENS)
      return gg_scene_refuse_text(r, line, "is not a scene: it has more than %d words and marks", MOST_TOKENS);
  }
  return GG_OK;
}

gg_status gg_scene_check_limits(const gg_scene_reader *r, const char *yaml, size_t length)
{
  yaml_parser_t parser;
  if (length > GG_SCENE_MAX_BYTES) return gg_scene_refuse_text(r, 0, "is not a scene: larger than 1 MiB");
  if (!yaml_parser_initialize(&parser))
    return gg_base_error_prefix(r->err, gg_base_out_of_memory(r->err), "%s", r->name);
  yaml_parser_set_input_string(&parser, (const unsigned char *)yaml, length);
  gg_status status = check_tokens(r, &parser);
  yaml_parser_delete(&parser);
  return status;
}
