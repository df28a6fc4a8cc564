/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every field of a result, written, read and compared, with values that all differ: a field that is forgotten, or takes
 * another's place, is seen. The tables below name every member: check_tables fails where a struct has one more. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "files/h5/hdf5_reader.h"
#include "files/h5/hdf5_writer.h"
#include "files/h5/result_file.h"
#include "files/h5/result_restore.h"
#include "files/result_document.h"
#include "graingas.h"
#include "own_folder.h"
#include "planted.h"
#include "scene/model_of_scene.h"
#include "scene/scene_reader.h"

/* How a file keeps a member. MD_ONLY, DSMC_ONLY: kept of results of that engine. BY_HAND: compared apart from the
 * tables. LEFT_OUT: 0 or NaN after reading. */
typedef enum kept { KEPT, MD_ONLY, DSMC_ONLY, BY_HAND, LEFT_OUT } kept;
/* number and count: one or more in a row */
typedef enum kind { NUMBER, COUNT, TEXT, TRUTH, OTHER } kind;

typedef struct field {
  const char *name;
  size_t offset, size, alignment;
  kind kind;
  kept kept;
  const char *key; /* in the JSON document's object of this struct; NULL: it is not there */
} field;

#define FIELD(type, member, what, how, json)                                                                           \
  {                                                                                                                    \
    .name = #member, .offset = offsetof(type, member), .size = sizeof((type *)0)->member,                              \
    .alignment = _Alignof(__typeof__(((type *)0)->member)), .kind = what, .kept = how, .key = json                     \
  }
#define LENGTH(table) (sizeof(table) / sizeof *(table))

static const field estimate_fields[] = {
    FIELD(gg_estimate, mean, NUMBER, KEPT, "mean"),
    FIELD(gg_estimate, error, NUMBER, KEPT, "stderr"),
    FIELD(gg_estimate, correlation_time, NUMBER, KEPT, "correlation_time"),
    FIELD(gg_estimate, samples, COUNT, KEPT, "samples"),
    FIELD(gg_estimate, reason, TEXT, BY_HAND, NULL), /* of means that are NaN */
};
static const field total_fields[] = {
    FIELD(gg_effort, collisions, COUNT, KEPT, "collisions"),
    FIELD(gg_effort, cpu_seconds, NUMBER, KEPT, "cpu_seconds"),
    FIELD(gg_effort, wall_seconds, NUMBER, KEPT, "wall_seconds"),
};
static const field averaging_fields[] = {
    FIELD(gg_effort, collisions, COUNT, KEPT, "collisions"),
    FIELD(gg_effort, cpu_seconds, NUMBER, KEPT, "cpu_seconds"),
    FIELD(gg_effort, wall_seconds, NUMBER, LEFT_OUT, NULL),
};
static const field state_fields[] = {
    FIELD(gg_engine_state, time, NUMBER, KEPT, "time"),
    FIELD(gg_engine_state, collisions, COUNT, BY_HAND, NULL), /* those of the total effort */
    FIELD(gg_engine_state, events, COUNT, KEPT, "events"),
    FIELD(gg_engine_state, treated, COUNT, MD_ONLY, "contact_time_collisions"),
    FIELD(gg_engine_state, wall_treated, COUNT, LEFT_OUT, NULL),
    FIELD(gg_engine_state, clamped, COUNT, KEPT, "law_clamped"), /* of a law of the user's */
    FIELD(gg_engine_state, overflows, COUNT, DSMC_ONLY, "majorant_overflows"),
    FIELD(gg_engine_state, overfilled, NUMBER, LEFT_OUT, NULL),
    FIELD(gg_engine_state, offset, NUMBER, LEFT_OUT, NULL),
    FIELD(gg_engine_state, turns, NUMBER, LEFT_OUT, NULL), /* frames have the tilt of their box */
    FIELD(gg_engine_state, worst_overlap, NUMBER, MD_ONLY, "worst_overlap"),
    FIELD(gg_engine_state, time_step, NUMBER, DSMC_ONLY, "time_step"),
    FIELD(gg_engine_state, time_step_bias, NUMBER, DSMC_ONLY, "time_step_bias"),
    FIELD(gg_engine_state, particles_bias, NUMBER, DSMC_ONLY, "particles_bias"),
    FIELD(gg_engine_state, others_cpu, NUMBER, LEFT_OUT, NULL),
};
static const field curve_number_fields[] = {
    FIELD(gg_curve_number, name, TEXT, KEPT, NULL),
    FIELD(gg_curve_number, unit, TEXT, KEPT, "unit"),
    FIELD(gg_curve_number, value, NUMBER, KEPT, "mean"),
    FIELD(gg_curve_number, error, NUMBER, KEPT, "stderr"),
    FIELD(gg_curve_number, truncation, NUMBER, LEFT_OUT, NULL), /* it is in the error */
    FIELD(gg_curve_number, setting, OTHER, BY_HAND, NULL),      /* an error of 0 */
};
static const field curve_fields[] = {
    FIELD(gg_curve, name, TEXT, KEPT, NULL),
    FIELD(gg_curve, group, TEXT, KEPT, "group"),
    FIELD(gg_curve, panel, TEXT, KEPT, "panel"),
    FIELD(gg_curve, label, TEXT, KEPT, "label"),
    FIELD(gg_curve, x_name, TEXT, KEPT, "x_name"),
    FIELD(gg_curve, x_unit, TEXT, KEPT, "x_unit"),
    FIELD(gg_curve, y_name, TEXT, KEPT, "y_name"),
    FIELD(gg_curve, unit, TEXT, KEPT, "unit"),
    FIELD(gg_curve, log_x, TRUTH, KEPT, "log_x"),
    FIELD(gg_curve, log_y, TRUTH, KEPT, "log_y"),
    FIELD(gg_curve, n, OTHER, BY_HAND, NULL),
    FIELD(gg_curve, x, OTHER, BY_HAND, NULL),
    FIELD(gg_curve, value, OTHER, BY_HAND, NULL),
    FIELD(gg_curve, error, OTHER, BY_HAND, NULL),
    FIELD(gg_curve, reference, OTHER, BY_HAND, NULL),
    FIELD(gg_curve, reference_label, TEXT, KEPT, NULL),
    FIELD(gg_curve, law_lost, TRUTH, LEFT_OUT, NULL),
    FIELD(gg_curve, divisor, OTHER, BY_HAND, NULL), /* measure's own: NULL */
    FIELD(gg_curve, folded, TRUTH, KEPT, NULL),     /* there where it is true */
    FIELD(gg_curve, block_correlation, NUMBER, LEFT_OUT, NULL),
    FIELD(gg_curve, samples, COUNT, KEPT, "samples"),
    FIELD(gg_curve, n_numbers, OTHER, BY_HAND, NULL),
    FIELD(gg_curve, number, OTHER, BY_HAND, NULL),
};
static const field frame_fields[] = {
    FIELD(gg_frame, time, NUMBER, KEPT, NULL),       FIELD(gg_frame, step, COUNT, KEPT, NULL),
    FIELD(gg_frame, n, OTHER, BY_HAND, NULL),        FIELD(gg_frame, tilt, OTHER, BY_HAND, NULL),
    FIELD(gg_frame, position, OTHER, BY_HAND, NULL), FIELD(gg_frame, velocity, OTHER, BY_HAND, NULL),
    FIELD(gg_frame, spin, OTHER, BY_HAND, NULL),     FIELD(gg_frame, image, OTHER, BY_HAND, NULL),
    FIELD(gg_frame, species, OTHER, BY_HAND, NULL),  FIELD(gg_frame, id, OTHER, BY_HAND, NULL), /* rows are in order */
};
static const field history_fields[] = {
    FIELD(gg_history, n, OTHER, BY_HAND, NULL),
    FIELD(gg_history, time, OTHER, BY_HAND, NULL),
    FIELD(gg_history, value, OTHER, BY_HAND, NULL),
    FIELD(gg_history, window, NUMBER, KEPT, NULL),
};
static const field correlation_fields[] = {
    FIELD(gg_correlations, n, OTHER, BY_HAND, NULL),
    FIELD(gg_correlations, quantity, OTHER, BY_HAND, NULL),
    FIELD(gg_correlations, coefficient, OTHER, BY_HAND, NULL),
};
static const field result_fields[] = {
    FIELD(gg_result, scene, OTHER, BY_HAND, NULL),
    FIELD(gg_result, model, OTHER, BY_HAND, NULL), /* that of the scene */
    FIELD(gg_result, engine, OTHER, BY_HAND, NULL),
    FIELD(gg_result, rows, OTHER, BY_HAND, NULL),
    FIELD(gg_result, correlation_time_unit, OTHER, BY_HAND, NULL),
    FIELD(gg_result, steadiness, OTHER, BY_HAND, NULL),
    FIELD(gg_result, steadiness_text, TEXT, KEPT, "verdict"),
    FIELD(gg_result, escape_rate, OTHER, BY_HAND, NULL),
    FIELD(gg_result, ensemble_text, TEXT, KEPT, "particles_chosen"),
    FIELD(gg_result, value, OTHER, BY_HAND, NULL),
    FIELD(gg_result, correlations, OTHER, BY_HAND, NULL),
    FIELD(gg_result, history, OTHER, BY_HAND, NULL),
    FIELD(gg_result, curves, OTHER, BY_HAND, NULL),
    FIELD(gg_result, final, OTHER, BY_HAND, NULL),
    FIELD(gg_result, window_step, COUNT, LEFT_OUT, NULL), /* frames of the file begin there */
    FIELD(gg_result, averaging, OTHER, BY_HAND, NULL),
    FIELD(gg_result, total, OTHER, BY_HAND, NULL),
    FIELD(gg_result, engine_state, OTHER, BY_HAND, NULL),
    FIELD(gg_result, warnings, OTHER, BY_HAND, NULL),
    FIELD(gg_result, origin, OTHER, BY_HAND, NULL),
    FIELD(gg_result, own, OTHER, BY_HAND, NULL), /* of programs with quantities of their own: tests/api */
};

/* The members cover the struct, but for gaps of alignment. */
static void check_table(const char *name, const field *table, size_t n, size_t size)
{
  size_t end = 0;
  for (size_t i = 0; i < n; end = table[i].offset + table[i].size, i++)
    if (table[i].offset < end || table[i].offset - end >= table[i].alignment)
      fail_msg("%s: there is a member before %s that the table lacks", name, table[i].name);
  if (size - end >= sizeof(double)) fail_msg("%s: there is a member at its end that the table lacks", name);
}
#define CHECK(table, type) check_table(#type, table, LENGTH(table), sizeof(type))

static void tables_are_complete(void **state)
{
  (void)state;
  CHECK(estimate_fields, gg_estimate);
  CHECK(total_fields, gg_effort);
  CHECK(averaging_fields, gg_effort);
  CHECK(state_fields, gg_engine_state);
  CHECK(curve_number_fields, gg_curve_number);
  CHECK(curve_fields, gg_curve);
  CHECK(frame_fields, gg_frame);
  CHECK(history_fields, gg_history);
  CHECK(correlation_fields, gg_correlations);
  CHECK(result_fields, gg_result);
}

/* ---- Values that all differ ---- */

static uint64_t last;

static double unlike(void)
{
  return (double)++last + 1.0 / 3;
}

static double *unlike_array(size_t n)
{
  double *x = calloc(n, sizeof *x);
  for (size_t i = 0; i < n; i++) x[i] = unlike();
  return x;
}

/* Fill a struct; only the flag number `truth` is true, so that several structs distinguish all flags. */
static void fill(void *to, const field *table, size_t n, size_t truth)
{
  size_t truths = 0;
  for (size_t i = 0; i < n; i++) {
    char *at = (char *)to + table[i].offset;
    for (size_t k = 0; table[i].kind == NUMBER && k < table[i].size / sizeof(double); k++) ((double *)at)[k] = unlike();
    if (table[i].kind == COUNT) *(uint64_t *)at = ++last;
    if (table[i].kind == TEXT) snprintf(at, table[i].size, "text_%d", (int)++last);
    if (table[i].kind == TRUTH) *(bool *)at = truths++ == truth;
  }
}
#define FILL(to, table, truth) fill(to, table, LENGTH(table), truth)

static bool is_kept(const field *f, gg_engine_kind engine)
{
  return f->kept == KEPT || f->kept == (engine == GG_MD ? MD_ONLY : DSMC_ONLY);
}

static bool is_nothing(const field *f, const char *at)
{
  for (size_t i = 0; f->kind == NUMBER && i < f->size / sizeof(double); i++)
    if (((const double *)at)[i] == 0 || isnan(((const double *)at)[i])) return true;
  for (size_t i = 0; i < f->size; i++)
    if (at[i]) return false;
  return true;
}

static bool is_same(const field *f, const char *a, const char *b)
{
  return f->kind == TEXT ? strcmp(a, b) == 0 : memcmp(a, b, f->size) == 0;
}

static void compare(const char *what, const void *found, const void *wanted, const field *table, size_t n,
                    gg_engine_kind engine)
{
  for (size_t i = 0; i < n; i++) {
    const char *a = (const char *)found + table[i].offset, *b = (const char *)wanted + table[i].offset;
    if (is_kept(&table[i], engine) && !is_same(&table[i], a, b)) fail_msg("%s: %s is another", what, table[i].name);
    const bool lost = table[i].kept != BY_HAND && !is_kept(&table[i], engine);
    if (lost && !is_nothing(&table[i], a)) fail_msg("%s: %s is not left out", what, table[i].name);
  }
}
#define COMPARE(what, found, wanted, table, engine) compare(what, found, wanted, table, LENGTH(table), engine)

/* The same numbers in an object of the JSON document. */
static void compare_json(const char *what, const json_t *object, const void *wanted, const field *table, size_t n,
                         gg_engine_kind engine)
{
  for (size_t i = 0; i < n; i++) {
    const char *at = (const char *)wanted + table[i].offset;
    const json_t *found = table[i].key ? json_object_get(object, table[i].key) : NULL;
    bool same = true;
    if (!table[i].key) continue;
    if (!is_kept(&table[i], engine))
      same = !found;
    else if (table[i].kind == NUMBER)
      same = json_number_value(found) == *(const double *)at;
    else if (table[i].kind == COUNT)
      same = (uint64_t)json_integer_value(found) == *(const uint64_t *)at;
    else if (table[i].kind == TRUTH)
      same = json_is_boolean(found) && json_is_true(found) == *(const bool *)at;
    else
      same = json_is_string(found) && strcmp(json_string_value(found), at) == 0;
    if (!same) fail_msg("the document's %s: %s is another", what, table[i].key);
  }
}
#define COMPARE_JSON(what, object, wanted, table, engine)                                                              \
  compare_json(what, object, wanted, table, LENGTH(table), engine)

/* ---- A result with such values ---- */

enum { GRAINS = 8, SAMPLES = 5, POINTS = 4, CURVES = 4 };

/* Rough grains of two species. */
static void make_scene(gg_scene *scene, gg_engine_kind engine)
{
  static const char yaml[] =
      "{flow: usf, phi: 0.3, particles: 8, collision: {e: 0.9, beta: 0.25}, run: {seed: 77}, dsmc: {particles: 8}, "
      "species: [{fraction: 0.25, diameter: 1, mass: 1}, {fraction: 0.75, diameter: 2, mass: 5}]}";
  *scene = gg_scene_defaults();
  assert_int_equal(gg_scene_read(scene, yaml, sizeof yaml - 1, "the scene", NULL), GG_OK);
  scene->engine = engine;
}

static void plant_estimates(gg_result *r)
{
  for (int i = 0; i < r->rows.n; i++) {
    gg_estimate *e = &r->value[r->rows.row[i].quantity];
    FILL(e, estimate_fields, 0);
    *e->reason = '\0';
    if (i == 1 || i == 4) { /* a mean that cannot be had: two with reasons of their own */
      e->mean = NAN, e->error = NAN;
      snprintf(e->reason, sizeof e->reason, "the reason is %d", i);
    } else if (i == 3)
      e->error = NAN;
  }
}

/* The table is not symmetric, so that rows and columns differ. */
static void plant_correlations(gg_result *r)
{
  gg_correlations *c = &r->correlations;
  for (int i = 0; i < r->rows.n; i++)
    if (!isnan(r->value[r->rows.row[i].quantity].error)) c->quantity[c->n++] = r->rows.row[i].quantity;
  c->coefficient = calloc(c->n * c->n, sizeof(double));
  for (size_t i = 0; i < c->n * c->n; i++) c->coefficient[i] = 1 - (double)(2 * i + 1) / (double)(c->n * c->n);
}

static void plant_history(gg_result *r)
{
  gg_history *h = &r->history;
  FILL(h, history_fields, 0);
  h->n = SAMPLES;
  h->time = unlike_array(h->n);
  for (int k = 0; k < GG_N_HISTORY; k++) {
    h->value[k] = unlike_array(h->n);
    const bool has = gg_run_rows_at(&r->rows, gg_common_quantity_of_history(k));
    for (size_t i = 0; !has && i < h->n; i++) h->value[k][i] = NAN;
  }
}

/* Each curve has another truth; the last has none, and no law beside it. */
static void plant_curves(gg_result *r)
{
  for (size_t k = 0; k < CURVES; k++) {
    gg_curve *c = gg_measure_curve_add(&r->curves, POINTS + k, "", "", "");
    const gg_curve own = *c;
    FILL(c, curve_fields, k);
    c->law_lost = false, c->folded = k == 2; /* truths: log_x, log_y, law_lost, folded */
    assert_true(c->n == own.n && c->x == own.x);
    for (size_t i = 0; i < c->n; i++) c->x[i] = unlike(), c->value[i] = unlike(), c->error[i] = unlike();
    c->value[1] = c->error[1] = NAN;
    if (k + 1 < CURVES)
      c->reference = unlike_array(c->n + 1);
    else
      *c->reference_label = '\0';
    c->n_numbers = (int)k + 1;
    for (int i = 0; i < c->n_numbers; i++) FILL(&c->number[i], curve_number_fields, 0);
    c->number[0].setting = true, c->number[0].error = 0;
  }
}

static void plant_frame(gg_result *r)
{
  gg_frame *f = &r->final;
  FILL(f, frame_fields, 0);
  f->n = GRAINS;
  f->velocity = unlike_array(3 * f->n);
  f->spin = unlike_array(3 * f->n);
  if (!r->model.homogeneous) f->position = unlike_array(3 * f->n);
  f->species = calloc(f->n, 1);
  f->id = calloc(f->n, sizeof *f->id);
  for (size_t i = 0; i < f->n; i++) {
    f->id[i] = (int64_t)((3 * i + 5) % f->n);
    f->species[i] = f->id[i] >= 2;
  }
}

static double law(void *context, double speed, int one, int other)
{
  (void)context, (void)speed, (void)one, (void)other;
  return 1;
}

static gg_result *plant(gg_engine_kind engine, gg_steadiness steadiness)
{
  gg_result *r = calloc(1, sizeof *r);
  last = 100;
  gg_scene scene;
  make_scene(&scene, engine);
  r->scene = gg_scene_copy_new(&scene, NULL);
  assert_int_equal(gg_scene_model_make(r->scene, engine, &r->model, NULL), GG_OK);
  r->model.law.e = law; /* so that there is a count of its values that were clamped */
  r->engine = engine == GG_MD ? "md" : "dsmc";
  gg_run_result_label(r);
  r->steadiness = steadiness;
  r->escape_rate = steadiness == GG_METASTABLE ? 1.5e-7 : NAN;
  FILL(r, result_fields, 0);
  plant_estimates(r);
  plant_correlations(r);
  plant_history(r);
  r->curves.model = &r->model;
  plant_curves(r);
  plant_frame(r);
  FILL(&r->averaging, averaging_fields, 0);
  FILL(&r->total, total_fields, 0);
  FILL(&r->engine_state, state_fields, 0);
  r->engine_state.collisions = r->total.collisions;
  for (int i = 0; i < 3; i++) GG_WARN(r, "warning %d", i);
  return r;
}

/* ---- The same after reading ---- */

static void same_numbers(const char *what, const double *found, const double *wanted, size_t n)
{
  if (!found != !wanted) fail_msg("%s: they are not there, or should not be", what);
  for (size_t i = 0; wanted && i < n; i++)
    if (!(found[i] == wanted[i] || (isnan(found[i]) && isnan(wanted[i]))))
      fail_msg("%s: number %zu is %.17g, not %.17g", what, i, found[i], wanted[i]);
}

static void compare_estimates(const gg_result *r, const gg_result *wanted)
{
  assert_int_equal(r->rows.n, wanted->rows.n);
  assert_true(r->rows.n > 40); /* most of those that there are */
  for (int i = 0; i < r->rows.n; i++) {
    const gg_quantity_row *row = &r->rows.row[i], *other = &wanted->rows.row[i];
    const gg_estimate *e = &r->value[row->quantity], *w = &wanted->value[row->quantity];
    assert_int_equal(row->quantity, other->quantity);
    assert_string_equal(row->name, other->name);
    assert_string_equal(row->unit, other->unit);
    same_numbers(row->name, (double[]){e->mean, e->error, e->correlation_time},
                 (double[]){w->mean, w->error, w->correlation_time}, 3);
    assert_int_equal(e->samples, w->samples);
    assert_string_equal(e->reason, w->reason);
  }
}

static void compare_correlations(const gg_correlations *c, const gg_correlations *wanted)
{
  assert_int_equal(c->n, wanted->n);
  assert_memory_equal(c->quantity, wanted->quantity, c->n * sizeof *c->quantity);
  same_numbers("correlations", c->coefficient, wanted->coefficient, c->n * c->n);
}

static void compare_history(const gg_history *h, const gg_history *wanted)
{
  COMPARE("history", h, wanted, history_fields, GG_MD);
  assert_int_equal(h->n, wanted->n);
  same_numbers("times", h->time, wanted->time, h->n);
  for (int k = 0; k < GG_N_HISTORY; k++)
    same_numbers(gg_common_quantity_name(gg_common_quantity_of_history(k)), h->value[k], wanted->value[k], h->n);
}

static void compare_curves(const gg_curves *curves, const gg_curves *wanted)
{
  assert_int_equal(curves->n, CURVES);
  for (int k = 0; k < CURVES; k++) {
    const gg_curve *c = &curves->curve[k], *w = &wanted->curve[k];
    COMPARE("curve", c, w, curve_fields, GG_MD);
    assert_int_equal(c->n, w->n);
    same_numbers("x of a curve", c->x, w->x, w->n);
    same_numbers("values of a curve", c->value, w->value, w->n);
    same_numbers("errors of a curve", c->error, w->error, w->n);
    same_numbers("law beside a curve", c->reference, w->reference, w->n);
    assert_int_equal(c->n_numbers, w->n_numbers);
    for (int i = 0; i < c->n_numbers; i++) {
      COMPARE("number of a curve", &c->number[i], &w->number[i], curve_number_fields, GG_MD);
      assert_int_equal(c->number[i].setting, i == 0);
    }
  }
}

/* Rows come back in the order of the grains' numbers. */
static void compare_frame(const gg_frame *f, const gg_frame *wanted)
{
  COMPARE("frame", f, wanted, frame_fields, GG_MD);
  assert_int_equal(f->n, wanted->n);
  assert_int_equal(!f->position, !wanted->position);
  for (size_t i = 0; i < f->n; i++) {
    const size_t at = (size_t)wanted->id[i];
    if (f->position) same_numbers("position", f->position + 3 * at, wanted->position + 3 * i, 3);
    same_numbers("velocity", f->velocity + 3 * at, wanted->velocity + 3 * i, 3);
    same_numbers("spin", f->spin + 3 * at, wanted->spin + 3 * i, 3);
    assert_int_equal(f->species[at], wanted->species[i]);
  }
}

static void compare_scenes(const gg_scene *scene, const gg_scene *wanted)
{
  char *a = gg_scene_yaml(scene), *b = gg_scene_yaml(wanted);
  assert_string_equal(a, b);
  free(a);
  free(b);
}

static void compare_results(const gg_result *r, const gg_result *wanted, gg_engine_kind engine)
{
  COMPARE("result", r, wanted, result_fields, engine);
  compare_scenes(r->scene, wanted->scene);
  assert_string_equal(r->engine, wanted->engine);
  assert_string_equal(r->correlation_time_unit, wanted->correlation_time_unit);
  assert_int_equal(r->steadiness, wanted->steadiness);
  assert_true(r->escape_rate == wanted->escape_rate || (isnan(r->escape_rate) && isnan(wanted->escape_rate)));
  compare_estimates(r, wanted);
  compare_correlations(&r->correlations, &wanted->correlations);
  compare_history(&r->history, &wanted->history);
  compare_curves(&r->curves, &wanted->curves);
  compare_frame(&r->final, &wanted->final);
  COMPARE("averaging", &r->averaging, &wanted->averaging, averaging_fields, engine);
  COMPARE("total", &r->total, &wanted->total, total_fields, engine);
  COMPARE("engine's state", &r->engine_state, &wanted->engine_state, state_fields, engine);
  assert_int_equal(r->engine_state.collisions, wanted->total.collisions);
  assert_true(r->warnings.n >= wanted->warnings.n); /* and those of means that cannot be had */
  for (size_t i = 0; i < wanted->warnings.n; i++) assert_string_equal(r->warnings.text[i], wanted->warnings.text[i]);
  assert_string_equal(r->origin.version, gg_version());
  assert_string_equal(r->origin.command, "graingas fields");
  assert_true(*r->origin.machine && strlen(r->origin.date) >= strlen("2000-01-01"));
  assert_string_not_equal(r->origin.machine, r->origin.date);
  assert_int_equal(r->origin.frames, 1);
  assert_null(r->own);
}

/* ---- The document ---- */

static void compare_list(const char *what, const json_t *list, const double *wanted, size_t n)
{
  assert_int_equal(json_array_size(list), n);
  for (size_t i = 0; i < n; i++) {
    const json_t *one = json_array_get(list, i);
    same_numbers(what, (double[]){json_is_null(one) ? NAN : json_number_value(one)}, &wanted[i], 1);
  }
}

static void compare_curve_json(const json_t *stored, const gg_curve *c)
{
  COMPARE_JSON("curve", stored, c, curve_fields, GG_MD);
  assert_int_equal(json_is_true(json_object_get(stored, "folded")), c->folded);
  compare_list("x", json_object_get(stored, "x"), c->x, c->n);
  compare_list("value", json_object_get(stored, "value"), c->value, c->n);
  compare_list("stderr", json_object_get(stored, "stderr"), c->error, c->n);
  const json_t *law = json_object_get(stored, "reference");
  assert_int_equal(!law, !c->reference);
  if (law) compare_list("reference", json_object_get(law, "value"), c->reference, c->n);
  if (law) assert_string_equal(json_string_value(json_object_get(law, "label")), c->reference_label);
  for (int i = 0; i < c->n_numbers; i++)
    COMPARE_JSON("curve's number", json_object_get(json_object_get(stored, "numbers"), c->number[i].name),
                 &c->number[i], curve_number_fields, GG_MD);
}

static void compare_document(const json_t *d, const gg_result *r, gg_engine_kind engine)
{
  assert_string_equal(json_string_value(json_object_get(d, "graingas")), gg_version());
  assert_string_equal(json_string_value(json_object_get(d, "engine")), r->engine);
  assert_int_equal(json_is_true(json_object_get(d, "steady")), gg_run_is_steady(r->steadiness));
  assert_int_equal(json_is_true(json_object_get(d, "metastable")), r->steadiness == GG_METASTABLE);
  assert_int_equal(json_integer_value(json_object_get(d, "particles")), r->model.n);
  COMPARE_JSON("result", d, r, result_fields, engine);
  COMPARE_JSON("averaging", d, &r->averaging, averaging_fields, engine);
  COMPARE_JSON("total", json_object_get(d, "total"), &r->total, total_fields, engine);
  COMPARE_JSON("engine_state", json_object_get(d, "engine_state"), &r->engine_state, state_fields, engine);
  for (int i = 0; i < r->rows.n; i++) {
    const gg_quantity_row *row = &r->rows.row[i];
    const gg_estimate *e = &r->value[row->quantity];
    const json_t *stored = json_object_get(json_object_get(d, "results"), row->name);
    assert_string_equal(json_string_value(json_object_get(stored, "unit")), row->unit);
    assert_string_equal(json_string_value(json_object_get(stored, "correlation_time_unit")), r->correlation_time_unit);
    if (!isnan(e->mean) && !isnan(e->error)) {
      COMPARE_JSON(row->name, stored, e, estimate_fields, engine);
      continue;
    }
    assert_true(json_is_null(json_object_get(stored, "stderr")));
    assert_int_equal(json_is_null(json_object_get(stored, "mean")), isnan(e->mean));
    if (isnan(e->mean)) assert_string_equal(json_string_value(json_object_get(stored, "reason")), e->reason);
  }
  for (int k = 0; k < CURVES; k++)
    compare_curve_json(json_object_get(json_object_get(d, "curves"), r->curves.curve[k].name), &r->curves.curve[k]);
}

/* ---- The arrays that other programs read ---- */

static void compare_array(gg_h5_in *h, const char *path, const double *wanted, size_t n)
{
  size_t size = 0;
  double *found = gg_h5_read_array(h, path, GG_ITEM_F64, &size);
  if (!found || size != n) fail_msg("%s: %zu numbers, not %zu", path, size, n);
  same_numbers(path, found, wanted, n);
  free(found);
}

static void compare_or_absent(gg_h5_in *h, const char *path, double wanted)
{
  if (isnan(wanted))
    assert_false(gg_h5_exists(h, path));
  else
    compare_array(h, path, &wanted, 1);
}

static void compare_curve_arrays(gg_h5_in *h, const gg_curve *c)
{
  char path[200];
  const struct {
    const char *name;
    const double *wanted;
  } arrays[] = {{"x", c->x}, {"value", c->value}, {"stderr", c->error}, {"reference", c->reference}};
  for (size_t i = 0; i < LENGTH(arrays); i++) {
    snprintf(path, sizeof path, "/graingas/curves/%s/%s", c->name, arrays[i].name);
    if (arrays[i].wanted)
      compare_array(h, path, arrays[i].wanted, c->n);
    else
      assert_false(gg_h5_exists(h, path));
  }
  for (int i = 0; i < c->n_numbers; i++) {
    snprintf(path, sizeof path, "/graingas/curves/%s/numbers/%s/mean", c->name, c->number[i].name);
    compare_or_absent(h, path, c->number[i].value);
    snprintf(path, sizeof path, "/graingas/curves/%s/numbers/%s/stderr", c->name, c->number[i].name);
    compare_or_absent(h, path, c->number[i].error);
  }
}

static void compare_arrays(const char *file, const gg_result *r)
{
  char path[200];
  gg_h5_in h;
  gg_h5_open(&h, file, false);
  for (int i = 0; i < r->rows.n; i++) {
    const gg_estimate *e = &r->value[r->rows.row[i].quantity];
    const struct {
      const char *name;
      double wanted;
    } numbers[] = {{"mean", e->mean},
                   {"stderr", e->error},
                   {"correlation_time", e->correlation_time},
                   {"samples", (double)e->samples}};
    for (size_t k = 0; k < LENGTH(numbers); k++) {
      snprintf(path, sizeof path, "/graingas/results/%s/%s", r->rows.row[i].name, numbers[k].name);
      compare_or_absent(&h, path, numbers[k].wanted);
    }
  }
  compare_or_absent(&h, "/graingas/averaging/collisions", (double)r->averaging.collisions);
  compare_or_absent(&h, "/graingas/averaging/cpu_seconds", r->averaging.cpu_seconds);
  compare_or_absent(&h, "/graingas/total/collisions", (double)r->total.collisions);
  compare_or_absent(&h, "/graingas/total/cpu_seconds", r->total.cpu_seconds);
  compare_or_absent(&h, "/graingas/seed", 77);
  for (int k = 0; k < CURVES; k++) compare_curve_arrays(&h, &r->curves.curve[k]);
  gg_h5_in_close(&h);
}

static void check(gg_engine_kind engine, gg_steadiness steadiness)
{
  gg_error err = {0};
  gg_result *r = plant(engine, steadiness), *again = NULL;
  gg_result_file f;
  gg_stored_result s;
  if (gg_files_result_file_open(&f, "f.h5", "graingas fields", &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_files_result_file_finish_run(&f, r, &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_files_stored_result_read(&s, "f.h5", &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_files_result_restore(&s, engine, &again, &err) != GG_OK) fail_msg("%s", err.message);
  compare_results(again, r, engine);
  compare_document(s.document, r, engine);
  compare_arrays("f.h5", r);
  gg_files_stored_result_clear(&s);
  gg_result_free(again);
  gg_result_free(r);
  remove_all();
}

static void of_md(void **state)
{
  (void)state;
  check(GG_MD, GG_STEADY);
}

static void of_dsmc(void **state)
{
  (void)state;
  check(GG_DSMC, GG_NOT_STEADY);
  check(GG_DSMC, GG_METASTABLE);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tables_are_complete),
      cmocka_unit_test(of_md),
      cmocka_unit_test(of_dsmc),
  };
  H5dont_atexit();
  return cmocka_run_group_tests(tests, enter, leave);
}
