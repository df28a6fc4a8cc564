#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "common/engine.h"
#include "plot/chart.h"
#include "run/result.h"
#include "sweep/sweep_table.h"

/* Letters, of which a picture has room for some 70; a longer value is cut to what it differs in. */
enum { LONG_VALUE = 20, LONGEST_PART = 32, LONGEST_NAME = 56 };

size_t gg_sweep_line_group_of(const gg_sweep *sweep, size_t i, size_t varied)
{
  size_t stride = 1;
  for (size_t f = sweep->n_varied - 1; f > varied; f--) stride *= sweep->varied[f].n;
  return i - gg_sweep_row(sweep, i, varied) * stride;
}

/* A name as it grows, counted in letters: neither bytes of UTF-8 nor marks of enhanced text take room. */
typedef struct line {
  char *text;
  size_t used;
  int letters;
  bool cut;
} line;

static bool begins_letter(char c)
{
  return (c & 0xc0) != 0x80;
}

static bool has_room(const line *l, size_t bytes, int letters)
{
  enum { END = 40 }; /* bytes kept for the number of one that is cut */
  return !l->cut && l->used + bytes + END <= GG_COMBINATION_NAME && l->letters + letters <= LONGEST_NAME;
}

/* Enhanced text, the whole of it or nothing. */
static void add(line *l, const char *text)
{
  int letters = 0;
  for (const char *c = text; *c; c++) letters += begins_letter(*c) && !strchr("{}^_\\", *c);
  l->cut = !has_room(l, strlen(text), letters);
  if (l->cut) return;
  memcpy(l->text + l->used, text, strlen(text));
  l->used += strlen(text), l->letters += letters;
}

/* Text without marks, as much of it as there is room for. */
static void add_plain(line *l, const char *text, size_t length)
{
  const int end = l->letters + LONGEST_PART;
  for (size_t i = 0; i < length && !l->cut; i++) {
    const bool letter = begins_letter(text[i]);
    l->cut = !has_room(l, 2, letter) || (letter && l->letters == end);
    if (l->cut) return;
    if (strchr("_^{}@&~\\", text[i])) l->text[l->used++] = '\\';
    l->text[l->used++] = text[i];
    l->letters += letter;
  }
}

/* Bytes that all values of a key begin with (end with, beyond the first `head`), up to where a member of a list or a
 * map begins (ends). */
static size_t shared_head(const gg_varied *v, size_t k)
{
  const char *one = v->value[k];
  size_t n = strlen(one);
  for (size_t i = 1; i < v->n; i++) {
    const char *other = v->value[i * v->n_keys + k];
    for (size_t j = 0; j < n; j++)
      if (one[j] != other[j]) n = j;
  }
  while (n && !strchr("{[ ", one[n - 1])) n--;
  if (n >= 2 && one[n - 1] == ' ' && one[n - 2] == ':') /* "mass: 0.5", with the name of the member */
    for (n -= 2; n && !strchr("{[ ", one[n - 1]);) n--;
  return n;
}

static size_t shared_tail(const gg_varied *v, size_t k, size_t head)
{
  const char *one = v->value[k];
  const size_t length = strlen(one);
  size_t n = length - head;
  for (size_t i = 1; i < v->n; i++) {
    const char *other = v->value[i * v->n_keys + k];
    const size_t its = strlen(other);
    if (n > its - head) n = its - head;
    for (size_t j = 0; j < n; j++)
      if (one[length - 1 - j] != other[its - 1 - j]) n = j;
  }
  while (n && !strchr("}],", one[length - n])) n--;
  return n;
}

static void add_value(line *l, const gg_varied *v, size_t row, size_t k)
{
  const char *value = v->value[row * v->n_keys + k];
  const size_t length = strlen(value);
  if (length <= LONG_VALUE || v->n == 1) {
    add_plain(l, value, length);
    return;
  }
  const size_t head = shared_head(v, k), tail = shared_tail(v, k, head);
  if (head) add(l, "…");
  add_plain(l, value + head, length - head - tail);
  if (tail) add(l, "…");
}

void gg_sweep_line_group_name(const gg_sweep *sweep, size_t combination, size_t varied, char text[GG_COMBINATION_NAME])
{
  char symbol[64], name[72];
  line l = {.text = text};
  for (size_t f = 0; f < sweep->n_varied; f++) {
    const gg_varied *v = &sweep->varied[f];
    for (size_t k = 0; f != varied && k < v->n_keys && !l.cut; k++) {
      gg_plot_chart_key(v->key[k], symbol, sizeof symbol, NULL);
      snprintf(name, sizeof name, "%s%s = ", l.used ? ", " : "", symbol);
      add(&l, name);
      add_value(&l, v, gg_sweep_row(sweep, combination, f), k);
    }
  }
  if (l.cut)
    snprintf(text + l.used, GG_COMBINATION_NAME - l.used, "… (point %zu)", combination + 1);
  else
    text[l.used] = '\0';
}

/* A picture of a sweep: quantities over one of its keys. */

enum { MOST_PANELS = 6, MOST_SERIES = 64 };

typedef struct axis_key {
  size_t varied, k;
} axis_key;

/* All of the panels' numbers, each series a stretch of them. */
typedef struct drawing {
  const gg_point_table *table;
  const gg_sweep *sweep;
  axis_key over;
  bool neighbours;       /* points of a combination that are next to each other on the axis differ in that key alone */
  double *x, *y, *error; /* room for every row */
  size_t used;
  gg_chart_series series[MOST_PANELS][MOST_SERIES];
  size_t combination[MOST_PANELS][MOST_SERIES]; /* what tells series apart; names are for the legend */
  char group[MOST_PANELS][MOST_SERIES][GG_COMBINATION_NAME];
  gg_chart_panel panel[MOST_PANELS];
  char quantity[MOST_PANELS][64], label[MOST_PANELS][64], x_label[96];
  const char *unit[MOST_PANELS]; /* of its numbers: phi = 0 has other units than phi > 0 */
  size_t n;
} drawing;

static double value_of(const gg_sweep *sweep, size_t point, axis_key a)
{
  const gg_varied *v = &sweep->varied[a.varied];
  const char *text = v->value[gg_sweep_row(sweep, point, a.varied) * v->n_keys + a.k];
  char *end;
  double x = strtod(text, &end);
  return *end || end == text || !isfinite(x) ? NAN : x;
}

static bool has_numbers(const gg_sweep *sweep, axis_key a)
{
  for (size_t i = 0; i < sweep->n; i++)
    if (isnan(value_of(sweep, i, a))) return false;
  return true;
}

/* The key that was requested, or of those with numbers the one with the most values. */
static gg_status choose_key(drawing *d, const char *over, gg_error *err)
{
  size_t most = 0;
  const gg_sweep *s = d->sweep;
  for (size_t f = 0; f < s->n_varied; f++)
    for (size_t k = 0; k < s->varied[f].n_keys; k++) {
      const axis_key a = {f, k};
      bool meant = over ? strcmp(over, s->varied[f].key[k]) == 0 : s->varied[f].n > most && has_numbers(s, a);
      if (meant && over && !has_numbers(s, a))
        return gg_base_fail(err, GG_BAD_INPUT, "'%.60s' has values that are not numbers and cannot be an axis", over);
      if (meant) most = s->varied[f].n, d->over = a;
      if (meant && over) return GG_OK;
    }
  if (over) return gg_base_fail(err, GG_BAD_INPUT, "'%.60s' is not a key that this sweep varies", over);
  return most > 0
             ? GG_OK
             : gg_base_fail(err, GG_FAILED,
                            "no varied key has numbers, which a picture's axis needs (picture none: the tables alone)");
}

/* Rows and random draws: other keys may change with that of the axis, from one scene to an unrelated one. */
static bool are_neighbours(const drawing *d)
{
  const gg_varied *v = &d->sweep->varied[d->over.varied];
  for (size_t i = 1; i < v->n; i++)
    for (size_t k = 0; k < v->n_keys; k++)
      if (k != d->over.k && strcmp(v->value[i * v->n_keys + k], v->value[k]) != 0) return false;
  return true;
}

static bool has_rows(const gg_point_table *t, const char *quantity)
{
  for (size_t i = 0; i < t->n; i++)
    if (strcmp(t->row[i].quantity, quantity) == 0) return true;
  return false;
}

static const char *unit_of(const gg_cli_table_row *row)
{
  return row->unit ? row->unit : "";
}

/* Is this a row of panel p? */
static bool belongs(const drawing *d, size_t p, const gg_cli_table_row *row)
{
  return strcmp(row->quantity, d->quantity[p]) == 0 && strcmp(unit_of(row), d->unit[p]) == 0;
}

static bool is_shown(const drawing *d, const gg_cli_table_row *row)
{
  for (size_t p = 0; p < d->n; p++)
    if (belongs(d, p, row)) return true;
  return false;
}

/* A panel for each unit that the quantity has at some point. */
static gg_status add_panels(drawing *d, const char *quantity, gg_error *err)
{
  if (!has_rows(d->table, quantity))
    return gg_base_fail(err, GG_BAD_INPUT, "no point has a quantity '%.60s'", quantity);
  for (size_t i = 0; i < d->table->n; i++) {
    const gg_cli_table_row *row = &d->table->row[i];
    if (strcmp(row->quantity, quantity) != 0 || is_shown(d, row)) continue;
    if (d->n == MOST_PANELS)
      return gg_base_fail(err, GG_BAD_INPUT, "a picture has at most %d panels, one for each quantity and unit",
                          MOST_PANELS);
    snprintf(d->quantity[d->n], sizeof d->quantity[0], "%s", quantity);
    d->unit[d->n++] = unit_of(row);
  }
  return GG_OK;
}

static gg_status add_named(drawing *d, const char *show, gg_error *err)
{
  while (*show) {
    char word[64];
    size_t length = strcspn(show, ",");
    snprintf(word, sizeof word, "%.*s", (int)length, show);
    GG_TRY(add_panels(d, word, err));
    show += length + (show[length] == ',');
  }
  return GG_OK;
}

/* The headline quantities of the first scene; else, of theories alone, whatever comes first. */
static gg_status choose_quantities(drawing *d, gg_error *err)
{
  gg_scene scene;
  gg_model model;
  gg_quantity headline[GG_N_QUANTITIES];
  GG_TRY(gg_sweep_resolve(d->sweep, 0, &scene, err));
  GG_TRY(gg_common_model_make(&scene, scene.engine, &model, err));
  int n = gg_run_headline_quantities(&model, headline);
  for (int i = 0; i < n && d->n < 4; i++) {
    const char *name = gg_common_quantity_name_in(&model, headline[i]);
    if (has_rows(d->table, name)) GG_TRY(add_panels(d, name, err));
  }
  return d->n || !d->table->n ? GG_OK : add_panels(d, d->table->row[0].quantity, err);
}

static gg_chart_series *series_for(drawing *d, size_t p, const gg_cli_table_row *row)
{
  const size_t n = d->panel[p].n, combination = gg_sweep_line_group_of(d->sweep, row->point, d->over.varied);
  for (size_t k = 0; k < n; k++)
    if (d->combination[p][k] == combination && strcmp(d->series[p][k].method, row->method) == 0)
      return &d->series[p][k];
  if (n == MOST_SERIES) return NULL;
  d->panel[p].n++;
  d->combination[p][n] = combination;
  gg_sweep_line_group_name(d->sweep, combination, d->over.varied, d->group[p][n]);
  d->series[p][n] = (gg_chart_series){.method = row->method,
                                      .group = *d->group[p][n] ? d->group[p][n] : NULL,
                                      .style = row->theory && d->neighbours ? GG_CHART_LINE : GG_CHART_POINTS};
  return &d->series[p][n];
}

/* Rows of one panel, counted first, so that each series has its stretch. */
static gg_status fill_panel(drawing *d, size_t p, gg_error *err)
{
  const gg_point_table *t = d->table;
  for (int round = 0; round < 2; round++) {
    for (size_t i = 0; i < t->n; i++) {
      if (!belongs(d, p, &t->row[i])) continue;
      gg_chart_series *s = series_for(d, p, &t->row[i]);
      if (!s)
        return gg_base_fail(err, GG_FAILED,
                            "the picture would have more than %d lines: another key over, fewer values, or none",
                            MOST_SERIES);
      if (round) {
        size_t at = (size_t)(s->x - d->x) + s->n;
        d->x[at] = value_of(d->sweep, t->row[i].point, d->over);
        d->y[at] = t->row[i].mean;
        d->error[at] = t->row[i].error;
      }
      s->n++;
    }
    for (size_t k = 0; k < d->panel[p].n && round == 0; k++) {
      gg_chart_series *s = &d->series[p][k];
      s->x = d->x + d->used, s->y = d->y + d->used, s->error = d->error + d->used;
      d->used += s->n;
      s->n = 0;
    }
  }
  return GG_OK;
}

static int by_x(const void *a, const void *b)
{
  const double *one = a, *two = b;
  return one[0] < two[0] ? -1 : one[0] > two[0];
}

/* Lines go from left to right. */
static void sort_series(drawing *d, const gg_chart_series *s)
{
  double(*row)[3] = malloc(s->n * sizeof *row);
  size_t at = (size_t)(s->x - d->x);
  for (size_t i = 0; row && i < s->n; i++)
    row[i][0] = d->x[at + i], row[i][1] = d->y[at + i], row[i][2] = d->error[at + i];
  if (row) qsort(row, s->n, sizeof *row, by_x);
  for (size_t i = 0; row && i < s->n; i++)
    d->x[at + i] = row[i][0], d->y[at + i] = row[i][1], d->error[at + i] = row[i][2];
  free(row);
}

static gg_status fill(drawing *d, gg_error *err)
{
  const gg_varied *v = &d->sweep->varied[d->over.varied];
  const char *x_unit;
  d->neighbours = are_neighbours(d);
  gg_plot_chart_key(v->key[d->over.k], d->x_label, sizeof d->x_label, &x_unit);
  for (size_t p = 0; p < d->n; p++) {
    gg_quantity q = gg_common_quantity_find(d->quantity[p]);
    if (q < GG_N_QUANTITIES)
      gg_common_quantity_symbol(q, d->label[p], sizeof d->label[p]);
    else
      snprintf(d->label[p], sizeof d->label[p], "%s", d->quantity[p]);
    d->panel[p] =
        (gg_chart_panel){.x = {.label = d->x_label, .unit = x_unit}, .y = {.label = d->label[p], .unit = d->unit[p]}};
    d->panel[p].series = d->series[p];
    GG_TRY(fill_panel(d, p, err));
    for (size_t k = 0; k < d->panel[p].n; k++) sort_series(d, &d->series[p][k]);
  }
  return GG_OK;
}

static gg_status draw(drawing *d, const gg_picture_choice *choice, const char *picture, const char *width,
                      gg_error *err)
{
  GG_TRY(choose_key(d, choice->over, err));
  GG_TRY(choice->show ? add_named(d, choice->show, err) : choose_quantities(d, err));
  GG_TRY(fill(d, err));
  const gg_chart chart = {.n = d->n, .panel = d->panel};
  return gg_plot_chart_draw(&chart, picture, width, err);
}

gg_status gg_sweep_point_table_draw(const gg_point_table *t, const gg_sweep *sweep, const gg_picture_choice *choice,
                                    const char *picture, const char *width, gg_error *err)
{
  drawing *d = gg_base_array_new(1, sizeof *d, err);
  if (!d) return GG_FAILED;
  size_t room = t->n * MOST_PANELS;
  d->table = t;
  d->sweep = sweep;
  d->x = gg_base_array_new(room, sizeof *d->x, err);
  d->y = gg_base_array_new(room, sizeof *d->y, err);
  d->error = gg_base_array_new(room, sizeof *d->error, err);
  gg_status status = d->x && d->y && d->error ? draw(d, choice, picture, width, err) : GG_FAILED;
  free(d->x);
  free(d->y);
  free(d->error);
  free(d);
  return status;
}
