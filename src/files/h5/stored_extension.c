#include "files/h5/stored_extension.h"

#include "theory/theory.h"

static void sample_nothing(void *context, void *state, const gg_sample *sample, double *values)
{
  (void)context, (void)state, (void)sample, (void)values;
}

static const char *evaluate_nothing(void *context, const gg_facts *facts, double *values)
{
  (void)context, (void)facts, (void)values;
  return "belongs to the program that wrote the file";
}

static gg_status add_quantities(const json_t *results, gg_extension **x, gg_error *err)
{
  gg_quantity_definition own[GG_MOST_OWN_QUANTITIES];
  int n = 0;
  const char *name;
  json_t *stored;
  json_object_foreach((json_t *)(uintptr_t)results, name, stored)
  {
    if (gg_common_quantity_find(name) != GG_N_QUANTITIES || n == GG_MOST_OWN_QUANTITIES) continue;
    own[n++] = (gg_quantity_definition){.name = name,
                                        .unit = json_string_value(json_object_get(stored, "unit")),
                                        .doc = json_string_value(json_object_get(stored, "doc"))};
  }
  if (n == 0) return GG_OK;
  const gg_observable_definition all = {
      .name = "stored", .n_quantities = n, .quantities = own, .sample = sample_nothing};
  gg_extension *with = gg_common_extension_with_observable(*x, &all, err);
  if (!with) return GG_FAILED;
  *x = with;
  return GG_OK;
}

static gg_status add_theory(const char *name, const json_t *about, gg_extension **x, gg_error *err)
{
  static const char *const some[] = {"temperature"}; /* what it answers stands in the file */
  const gg_theory_definition t = {.name = name,
                                  .title = json_string_value(json_object_get(about, "title")),
                                  .citation = json_string_value(json_object_get(about, "citation")),
                                  .assumptions = json_string_value(json_object_get(about, "assumptions")),
                                  .n_quantities = 1,
                                  .quantities = some,
                                  .evaluate = evaluate_nothing};
  return gg_theory_user_theory_add(x, &t, err);
}

gg_status gg_files_stored_extension(const json_t *results, const json_t *theories, gg_extension **extension,
                                    gg_error *err)
{
  gg_extension *x = NULL;
  gg_status status = add_quantities(results, &x, err);
  const char *name;
  json_t *about;
  json_object_foreach((json_t *)(uintptr_t)theories, name, about)
  {
    if (status != GG_OK || gg_theory_find(name) || gg_common_extension_theories(x) == GG_MOST_OWN_THEORIES) continue;
    status = add_theory(name, about, &x, err);
  }
  if (status == GG_OK)
    *extension = x;
  else
    gg_common_extension_release(x);
  return status;
}
