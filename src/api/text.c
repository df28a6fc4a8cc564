/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Version, checks of arguments, names of engines, formatting of texts. */
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/build.h"
#include "base/cancellation.h"
#include "base/memory.h"
#include "base/spelling.h"
#include "base/thread_pool.h"
#include "common/engine.h"
#include "files/result_document.h"
#include "theory/references.h"

const char *gg_version(void)
{
  return gg_base_build_version;
}

int gg_processors(void)
{
  return gg_base_processors();
}

gg_status gg_cite(const char *words, size_t *n, char **text, gg_error *err)
{
  GG_NEED(words, text);
  *text = gg_theory_references(words, n);
  return *text ? GG_OK : gg_base_out_of_memory(err);
}

void gg_callback_fail(const char *reason)
{
  gg_base_callback_fail(reason);
}

gg_status gg_api_arguments_check(const char *function, const char *names, const void *const *argument, size_t n,
                                 gg_error *err)
{
  for (size_t i = 0; i < n; i++, names += strcspn(names, ",") + 2)
    if (!argument[i])
      return GG_REFUSE(err, "%s: argument '%.*s' is missing (NULL)", function, (int)strcspn(names, ","), names);
  return GG_OK;
}

gg_status gg_api_options_copy(const char *function, void *copy, size_t own_size, const void *options, size_t size,
                              gg_error *err)
{
  memset(copy, 0, own_size);
  if (!options) return GG_OK;
  if (size == 0 || size > own_size)
    return GG_REFUSE(err,
                     "%s: options.size is %zu, allowed is sizeof options: at most %zu in this library (graingas %s)",
                     function, size, own_size, gg_base_build_version);
  memcpy(copy, options, size);
  return GG_OK;
}

bool gg_api_is_requested(void *request)
{
  gg_api_request *r = request;
  if (!r->made && r->stop && r->stop(r->context)) r->made = true;
  return r->made;
}

gg_status gg_api_engine_find(const char *name, gg_engine_kind *kind, gg_error *err)
{
  for (int k = 0; k < GG_N_ENGINES; k++)
    if (strcmp(gg_common_engine_of(k)->name, name) == 0) return *kind = (gg_engine_kind)k, GG_OK;
  return GG_REFUSE(err, "there is no engine called '%.40s'; there are md and dsmc", name);
}

gg_status gg_api_text_copy(json_t *document, char **text, gg_error *err)
{
  char *made = document ? gg_files_document_text(document) : NULL;
  json_decref(document);
  if (!made) return gg_base_out_of_memory(err);
  *text = made;
  return GG_OK;
}

const char *gg_nearest_word(const char *word, const char *const *known)
{
  if (!word || !known) return NULL;
  gg_nearest nearest = {.word = word};
  for (; *known; known++) gg_base_spelling_try(&nearest, *known);
  return nearest.best;
}

gg_status gg_api_row_find(const gg_quantity_rows *rows, const char *name, const gg_quantity_row **row, gg_error *err)
{
  gg_nearest nearest = {.word = name};
  if ((*row = gg_run_rows_find(rows, name))) return GG_OK;
  for (int i = 0; i < rows->n; i++) gg_base_spelling_try(&nearest, rows->row[i].name);
  if (!nearest.best) return GG_REFUSE(err, "there is no quantity called '%.60s'", name);
  return GG_REFUSE(err, "there is no quantity called '%.60s'; did you mean '%s'?", name, nearest.best);
}

void gg_text_make_printable(char *text)
{
  if (text) gg_base_text_make_printable(text);
}
