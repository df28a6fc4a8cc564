/* The teaching page with a scene in it: a copy of the file that `ninja page` built. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "api/page_places.h"
#include "base/atomic_file.h"
#include "base/memory.h"

/* Where the page says which scene it begins with; NULL as JSON: its own. */
static const char *const marker = "\"@given@\"";

static FILE *open_page(void)
{
  const char *const places[] = {GG_PAGE_BUILT, GG_PAGE_INSTALLED};
  FILE *in = NULL;
  for (int k = 0; k < 2 && !in; k++) in = fopen(places[k], "rb");
  return in;
}

static gg_status read_all(FILE *in, char **text, gg_error *err)
{
  long size = fseek(in, 0, SEEK_END) == 0 ? ftell(in) : -1;
  if (size < 0 || fseek(in, 0, SEEK_SET) != 0)
    return gg_base_fail(err, GG_BAD_FILE, "the page that was built cannot be read: %s", strerror(errno));
  *text = gg_base_array_new((size_t)size + 1, 1, err);
  if (!*text) return GG_FAILED;
  if (fread(*text, 1, (size_t)size, in) == (size_t)size) return GG_OK;
  free(*text);
  return gg_base_fail(err, GG_BAD_FILE, "the page that was built cannot be read: %s", strerror(errno));
}

static gg_status read_page(char **text, gg_error *err)
{
  FILE *in = open_page();
  if (!in)
    return gg_base_fail(
        err, GG_BAD_FILE,
        "the page was not built: it is neither %s nor %s; in the sources of graingas ./check-page builds it "
        "(ninja -C build page, where emscripten is installed)",
        GG_PAGE_BUILT, GG_PAGE_INSTALLED);
  gg_status status = read_all(in, text, err);
  fclose(in);
  return status;
}

/* As a string of JSON within a script: nothing in it can end that. */
static gg_status scene_literal(const gg_scene *scene, char **literal, gg_error *err)
{
  char *yaml = NULL;
  GG_TRY(gg_scene_to_yaml(scene, &yaml, err));
  json_t *string = json_string(yaml);
  char *plain = string ? json_dumps(string, JSON_ENCODE_ANY | JSON_ENSURE_ASCII) : NULL;
  *literal = plain ? gg_base_array_new(6 * strlen(plain) + 1, 1, err) : NULL;
  char *to = *literal;
  for (const char *at = plain; to && *at; at++) to += sprintf(to, *at == '<' ? "\\u003c" : "%c", *at);
  json_decref(string);
  free(plain);
  free(yaml);
  return *literal ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status write_parts(const char *path, const char *page, const char *scene, gg_error *err)
{
  const char *at = strstr(page, marker), *rest = at ? at + strlen(marker) : NULL;
  gg_atomic_file file = GG_ATOMIC_NONE;
  if (!at) return gg_base_fail(err, GG_BAD_FILE, "%s: is an outdated page: build it again", GG_PAGE_BUILT);
  GG_TRY(gg_base_atomic_open(&file, path, err));
  gg_status status = gg_base_atomic_write(&file, page, (size_t)(at - page), err);
  if (status == GG_OK) status = gg_base_atomic_write(&file, scene, strlen(scene), err);
  if (status == GG_OK) status = gg_base_atomic_write(&file, rest, strlen(rest), err);
  if (status == GG_OK) return gg_base_atomic_commit(&file, err);
  gg_base_atomic_abandon(&file);
  return status;
}

gg_status gg_page_write(const gg_scene *scene, const char *path, gg_error *err)
{
  char *page = NULL, *literal = NULL;
  GG_NEED(path);
  if (scene) GG_TRY(gg_scene_check(scene, err));
  GG_TRY(read_page(&page, err));
  gg_status status = scene ? scene_literal(scene, &literal, err) : GG_OK;
  if (status == GG_OK) status = write_parts(path, page, scene ? literal : "null", err);
  free(literal);
  free(page);
  return status;
}
