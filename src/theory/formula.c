/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/formula.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graingas.h"

const char *const gg_theory_parameters[] = {"phi",   "n",       "gamma",   "T_0",      "e",       "beta",    "mu",
                                            "chi",   "K",       "e_12",    "e_22",     "beta_12", "beta_22", "mu_12",
                                            "mu_22", "chi_12",  "chi_22",  "K_2",      "x_1",     "x_2",     "m_1",
                                            "m_2",   "sigma_1", "sigma_2", "sigma_12", "g_x",     "g_y",     NULL};

/* Parameters in the order of the names above; NaN: there is no second species. */
static void read_parameters(const gg_facts *f, double at[GG_THEORY_PARAMETERS])
{
  static const gg_species_facts no_species = {NAN, NAN, NAN, NAN};
  static const gg_pair_facts no_pair = {NAN, NAN, NAN, NAN, NAN};
  const bool two = f->n_species > 1;
  const gg_species_facts *one = &f->species[0], *other = two ? &f->species[1] : &no_species;
  const gg_pair_facts *p = &f->pairs[0], *p12 = two ? &f->pairs[1] : &no_pair,
                      *p22 = two ? &f->pairs[f->n_species + 1] : &no_pair;
  const double values[] = {f->phi,
                           f->density,
                           f->shear_rate,
                           f->temperature,
                           p->e,
                           p->beta,
                           p->mu,
                           p->contact_value,
                           one->inertia,
                           p12->e,
                           p22->e,
                           p12->beta,
                           p22->beta,
                           p12->mu,
                           p22->mu,
                           p12->contact_value,
                           p22->contact_value,
                           other->inertia,
                           one->fraction,
                           other->fraction,
                           one->mass,
                           other->mass,
                           one->diameter,
                           other->diameter,
                           p12->diameter,
                           f->gravity[0],
                           f->gravity[1]};
  _Static_assert(sizeof values / sizeof *values == GG_THEORY_PARAMETERS, "a value for each name");
  memcpy(at, values, sizeof values);
}

/* Index of a parameter that a second species has. */
static bool is_of_second(int parameter)
{
  const char *name = gg_theory_parameters[parameter], *index = strchr(name, '_');
  return index && strchr(index, '2') != NULL;
}

static bool names_second(const gg_expression *e)
{
  bool any = false;
  for (int i = 0; i < e->n; i++)
    any |= e->step[i].code == 'p' && e->step[i].number < GG_THEORY_PARAMETERS && is_of_second((int)e->step[i].number);
  return any;
}

const char *gg_theory_formula_evaluate(void *theory, const gg_facts *facts, double *values)
{
  const gg_formula_theory *t = theory;
  double at[GG_THEORY_PARAMETERS + GG_THEORY_FORMULAS], *value = at + GG_THEORY_PARAMETERS;
  bool second = false;
  for (int k = 0; k < t->n; k++) second |= names_second(&t->of[k]);
  if (facts->n_species > 2) return "is a formula for one or two species";
  if (facts->n_species > 1 && !second) return "is a formula for one species: it names no parameter of the second";
  if (facts->n_species == 1 && second) return "is a formula for two species";
  read_parameters(facts, at);
  for (int k = 0; k < t->n; k++) value[t->order[k]] = gg_common_expression_value(&t->of[t->order[k]], at);
  for (int k = 0; k < t->n_quantities; k++) values[k] = value[t->answer[k]];
  return NULL;
}

static bool is_same(double a, double b)
{
  return a == b || fabs(a - b) <= 1e-9 * fmax(fabs(a), fabs(b));
}

const char *gg_theory_points_evaluate(void *theory, const gg_facts *facts, double *values)
{
  const gg_points_theory *t = theory;
  double at[GG_THEORY_PARAMETERS];
  read_parameters(facts, at);
  for (size_t i = 0; i < t->n_rows; i++) {
    const double *row = t->cell + i * (size_t)(t->n_keys + t->n);
    bool same = true;
    for (int k = 0; k < t->n_keys; k++) same = same && is_same(row[k], at[t->key[k]]);
    if (!same) continue;
    memcpy(values, row + t->n_keys, (size_t)t->n * sizeof *values);
    return NULL;
  }
  return "has no row for this scene in its table";
}

/* Index of the parameter, also by its key in a scene; -1: none. */
static int find_parameter(const char *name)
{
  static const char *const keys[][2] = {
      {"inertia", "K"},           {"species.1.inertia", "K"},       {"species.2.inertia", "K_2"},
      {"collision.e", "e"},       {"collision.e.12", "e_12"},       {"collision.e.22", "e_22"},
      {"collision.beta", "beta"}, {"collision.beta.12", "beta_12"}, {"collision.beta.22", "beta_22"},
      {"collision.mu", "mu"},     {"collision.mu.12", "mu_12"},     {"collision.mu.22", "mu_22"}};
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
    if (strcmp(keys[i][0], name) == 0) name = keys[i][1];
  for (int k = 0; gg_theory_parameters[k]; k++)
    if (strcmp(gg_theory_parameters[k], name) == 0) return k;
  return -1;
}

enum { MOST_COLUMNS = 64 };

typedef struct head {
  int n, of[MOST_COLUMNS], n_keys, n_quantities,
      key[GG_THEORY_PARAMETERS]; /* of: index of the cell for a column's number */
  char *quantity[MOST_COLUMNS];
} head;

/* Enter a column of a table: a parameter or a quantity, each once. */
static gg_status read_column(char *word, const char *name, head *h, int *parameter, gg_error *err)
{
  *parameter = find_parameter(word);
  if (h->n == MOST_COLUMNS) return gg_base_fail(err, GG_BAD_INPUT, "%s: more than %d columns", name, MOST_COLUMNS);
  if (*parameter < 0 && strchr(word, '.'))
    return gg_base_fail(err, GG_BAD_INPUT, "%s: column '%.60s': this key is no parameter of a table", name, word);
  bool twice = false;
  for (int k = 0; k < h->n_keys; k++) twice |= h->key[k] == *parameter;
  for (int k = 0; k < h->n_quantities; k++) twice |= strcmp(h->quantity[k], word) == 0;
  if (twice) return gg_base_fail(err, GG_BAD_INPUT, "%s: '%.60s' has two columns", name, word);
  if (*parameter < 0)
    h->of[h->n] = h->n_quantities, h->quantity[h->n_quantities++] = word;
  else
    h->of[h->n] = h->n_keys, h->key[h->n_keys++] = *parameter;
  h->n++;
  return GG_OK;
}

/* Split the line into its names, in place. */
static gg_status read_head(char *line, const char *name, head *h, gg_error *err)
{
  int parameter[MOST_COLUMNS + 1];
  char *rest = line;
  *h = (head){0};
  for (char *word; (word = strsep(&rest, ","));) {
    word += strspn(word, " \t");
    word[strcspn(word, "\r \t")] = '\0';
    GG_TRY(read_column(word, name, h, &parameter[h->n], err));
  }
  for (int k = 0; k < h->n; k++)
    if (parameter[k] < 0) h->of[k] += h->n_keys;
  if (h->n_keys && h->n_quantities) return GG_OK;
  return gg_base_fail(err, GG_BAD_INPUT, "%s: its first line has to name parameters (phi, e ...) and quantities", name);
}

static gg_status read_row(char *line, const char *name, size_t number, const head *h, double *row, gg_error *err)
{
  int n = 0;
  char *rest = line;
  for (char *word, *end; n < h->n && (word = strsep(&rest, ",")); n++) {
    word += strspn(word, " \t");
    row[h->of[n]] = strtod(word, &end);
    if (end == word) row[h->of[n]] = NAN;
    if (end[strspn(end, " \t\r")])
      return gg_base_fail(err, GG_BAD_INPUT, "%s:%zu: column %d is not a number", name, number, n + 1);
  }
  if (n == h->n && !rest) return GG_OK;
  return gg_base_fail(err, GG_BAD_INPUT, "%s:%zu: %d numbers are needed, one a column", name, number, h->n);
}

static size_t count_lines(const char *text)
{
  size_t n = 1;
  for (; *text; text++) n += *text == '\n';
  return n;
}

static gg_status read_rows(char *rest, const char *name, const head *h, gg_points_theory *t, gg_error *err)
{
  size_t number = 2;
  for (char *line; (line = strsep(&rest, "\n")); number++) {
    if (!line[strspn(line, " \t\r")]) continue;
    GG_TRY(read_row(line, name, number, h, t->cell + t->n_rows * (size_t)h->n, err));
    t->n_rows++;
  }
  return t->n_rows ? GG_OK : gg_base_fail(err, GG_BAD_INPUT, "%s: has no row of numbers", name);
}

gg_status gg_theory_points_read(const char *text, const char *name, gg_points_theory **theory, char ***quantity,
                                char **names, gg_error *err)
{
  head h;
  char *copy = strdup(text), *rest = copy;
  if (!copy) return gg_base_out_of_memory(err);
  gg_status status = read_head(strsep(&rest, "\n"), name, &h, err);
  const size_t cells = status == GG_OK && rest ? count_lines(rest) * (size_t)h.n : 0;
  gg_points_theory *t = NULL;
  char **list = NULL;
  if (status == GG_OK) {
    t = gg_base_array_new(1, sizeof *t + cells * sizeof(double), err);
    list = gg_base_array_new((size_t)h.n_quantities, sizeof *list, err);
    status = t && list ? GG_OK : GG_FAILED;
  }
  if (status == GG_OK) {
    *t = (gg_points_theory){.n_keys = h.n_keys, .n = h.n_quantities};
    memcpy(t->key, h.key, sizeof t->key);
    memcpy(list, h.quantity, (size_t)h.n_quantities * sizeof *list);
    status = read_rows(rest, name, &h, t, err);
  }
  if (status == GG_OK)
    *theory = t, *quantity = list, *names = copy;
  else
    free(t), free(list), free(copy);
  return status;
}
