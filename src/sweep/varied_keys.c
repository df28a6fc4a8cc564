/* What a sweep varies. */
#include <stdlib.h>
#include <string.h>

#include "sweep/sweep.h"

void gg_sweep_varied_clear(gg_varied *v)
{
  for (size_t k = 0; v->key && k < v->n_keys; k++) free(v->key[k]);
  for (size_t i = 0; v->value && i < v->n * v->n_keys; i++) free(v->value[i]);
  free(v->key);
  free(v->value);
  *v = (gg_varied){0};
}

bool gg_sweep_varies(const gg_sweep *sweep, const char *key)
{
  for (size_t f = 0; f < sweep->n_varied; f++)
    for (size_t k = 0; k < sweep->varied[f].n_keys; k++)
      if (strcmp(sweep->varied[f].key[k], key) == 0) return true;
  return false;
}

/* Is the member among those that a value of the section names? */
static bool names_member(const gg_varied *v, size_t k, const char *member)
{
  for (size_t i = 0; i < v->n; i++)
    if (strstr(v->value[i * v->n_keys + k], member)) return true;
  return false;
}

bool gg_sweep_sets(const gg_sweep *sweep, const char *key)
{
  const char *dot = strchr(key, '.');
  if (gg_sweep_varies(sweep, key)) return true;
  if (!dot) return false;
  const size_t length = (size_t)(dot - key);
  for (size_t f = 0; f < sweep->n_varied; f++) {
    const gg_varied *v = &sweep->varied[f];
    for (size_t k = 0; k < v->n_keys; k++)
      if (strncmp(v->key[k], key, length) == 0 && !v->key[k][length] && names_member(v, k, dot + 1)) return true;
  }
  return false;
}

static gg_status check_new(const gg_sweep *sweep, const gg_varied *v, gg_error *err)
{
  if (sweep->n_varied == GG_MOST_VARIED)
    return gg_base_fail(err, GG_BAD_INPUT, "more than %d keys are varied", GG_MOST_VARIED);
  for (size_t k = 0; k < v->n_keys; k++) {
    if (gg_sweep_varies(sweep, v->key[k]))
      return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': is varied twice", v->key[k]);
    for (size_t j = 0; j < k; j++)
      if (strcmp(v->key[j], v->key[k]) == 0)
        return gg_base_fail(err, GG_BAD_INPUT, "key '%.60s': is varied twice", v->key[k]);
  }
  return GG_OK;
}

gg_status gg_sweep_add(gg_sweep *sweep, gg_varied *v, gg_error *err)
{
  gg_status status = check_new(sweep, v, err);
  if (status == GG_OK) {
    sweep->varied[sweep->n_varied++] = *v;
    *v = (gg_varied){0};
  }
  gg_sweep_varied_clear(v);
  return status;
}
