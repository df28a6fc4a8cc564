/* What a page calls: graingas.h with arguments that JavaScript can give, and answers that it can read. Handles are
 * addresses, answers are arrays of doubles in the order that engines.js names, texts are NUL-terminated UTF-8. A call
 * that fails returns 0 or NULL, and page_error says why. */
#include <emscripten.h>
#include <graingas.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PAGE EMSCRIPTEN_KEEPALIVE
#pragma clang diagnostic ignored "-Wmissing-prototypes" /* their callers are in engines.js */

static gg_error why; /* of the last call that failed */

PAGE const char *page_error(void)
{
  return why.message;
}
PAGE int page_status(void)
{
  return why.status;
}

/* ---- Scenes ---- */

PAGE gg_scene *page_scene(const char *yaml)
{
  gg_scene *scene = NULL;
  return gg_scene_parse(yaml, "scene", &scene, &why) == GG_OK ? scene : NULL;
}
PAGE int page_scene_set(gg_scene *scene, const char *key, const char *value)
{
  return gg_scene_set(scene, key, value, &why) == GG_OK;
}
PAGE int page_scene_check(const gg_scene *scene)
{
  return gg_scene_check(scene, &why) == GG_OK;
}
/* To be freed, as all texts here that are `char *`. */
PAGE char *page_scene_yaml(const gg_scene *scene)
{
  char *text = NULL;
  return gg_scene_to_yaml(scene, &text, &why) == GG_OK ? text : NULL;
}
PAGE char *page_scene_json(const gg_scene *scene)
{
  char *text = NULL;
  return gg_scene_to_json(scene, &text, &why) == GG_OK ? text : NULL;
}
PAGE char *page_scene_title(const gg_scene *scene)
{
  char text[256];
  return gg_scene_title(scene, text, sizeof text, &why) == GG_OK ? strdup(text) : NULL;
}

typedef struct lines {
  char *text;
  size_t size;
  FILE *out;
} lines;

static void add_line(void *context, const char *text)
{
  fprintf(((lines *)context)->out, "%s\n", text);
}

/* Keys without effect, a line each. */
PAGE char *page_scene_warnings(const gg_scene *scene, const char *use)
{
  lines all = {0};
  all.out = open_memstream(&all.text, &all.size);
  gg_status status = gg_scene_warnings(scene, use, add_line, &all, &why);
  fclose(all.out);
  if (status == GG_OK) return all.text;
  free(all.text);
  return NULL;
}

/* ---- Simulations ---- */

/* With arrays that stay where they are, and are filled anew when the page asks. */
typedef struct page_simulation {
  gg_simulation *simulation;
  gg_grains grains;
  size_t n;
  double until; /* when an advance in slices is to stop, in milliseconds */
  uint64_t caught;
  gg_collision_event event; /* the last one shown */
} page_simulation;

static int time_is_up(void *context)
{
  return emscripten_get_now() >= ((page_simulation *)context)->until;
}

PAGE void page_simulation_free(page_simulation *p)
{
  if (!p) return;
  gg_simulation_free(p->simulation);
  free(p->grains.position);
  free(p->grains.velocity);
  free(p->grains.spin);
  free(p->grains.species);
  free(p);
}

static int make_arrays(page_simulation *p)
{
  gg_simulation_state state;
  if (gg_simulation_get_state(p->simulation, &state, &why) != GG_OK) return 0;
  p->n = state.grains;
  if (state.box[0] > 0) p->grains.position = calloc(3 * p->n, sizeof(double));
  p->grains.velocity = calloc(3 * p->n, sizeof(double));
  p->grains.spin = calloc(3 * p->n, sizeof(double));
  p->grains.species = calloc(p->n, sizeof(int));
  return p->grains.velocity && p->grains.spin && p->grains.species && (p->grains.position || state.box[0] == 0);
}

PAGE page_simulation *page_simulation_new(const gg_scene *scene, int stream)
{
  page_simulation *p = calloc(1, sizeof *p);
  if (!p) return NULL;
  p->until = 1e300;
  int made = gg_simulation_new(scene, (uint64_t)stream, &p->simulation, &why) == GG_OK && make_arrays(p);
  if (made) made = gg_simulation_on_stop(p->simulation, time_is_up, p, &why) == GG_OK;
  if (made) return p;
  page_simulation_free(p);
  return NULL;
}

/* 1: done; 2: stopped as so many milliseconds were over, to be gone on with; 0: failed. */
static int outcome(gg_status status)
{
  return status == GG_OK ? 1 : status == GG_INTERRUPTED ? 2 : 0;
}
PAGE int page_advance(page_simulation *p, double time, double milliseconds)
{
  p->until = emscripten_get_now() + milliseconds;
  return outcome(gg_simulation_advance(p->simulation, time, &why));
}
PAGE int page_collide(page_simulation *p, double collisions, double milliseconds)
{
  p->until = emscripten_get_now() + milliseconds;
  return outcome(gg_simulation_collide(p->simulation, (uint64_t)collisions, &why));
}

static void catch_event(void *context, const gg_collision_event *event)
{
  page_simulation *p = context;
  p->event = *event;
  p->caught++;
}

/* One collision, or in dsmc one step with at least one: the last one of it, as engines.js names its numbers; NULL:
 * failed. */
PAGE const double *page_step(page_simulation *p)
{
  static double numbers[14];
  p->caught = 0;
  p->until = 1e300;
  gg_status status = gg_simulation_on_collision(p->simulation, catch_event, p, &why);
  if (status == GG_OK) status = gg_simulation_collide(p->simulation, 1, &why);
  if (status == GG_OK) status = gg_simulation_on_collision(p->simulation, NULL, NULL, &why);
  if (status != GG_OK || !p->caught) return NULL;
  const gg_collision_event *e = &p->event;
  double *to = numbers;
  for (int i = 0; i < 2; i++) *to++ = (double)e->grain[i];
  for (int i = 0; i < 2; i++) *to++ = e->species[i];
  for (int a = 0; a < 3; a++) *to++ = e->k[a];
  for (int a = 0; a < 3; a++) *to++ = e->velocity[a];
  *to++ = e->normal_speed;
  for (int a = 0; a < 3; a++) *to++ = e->impulse[a];
  return numbers;
}

PAGE const double *page_state(page_simulation *p)
{
  static double numbers[20];
  gg_simulation_state s;
  if (gg_simulation_get_state(p->simulation, &s, &why) != GG_OK) return NULL;
  const double head[] = {s.time,           (double)s.collisions, s.collisions_per_grain,
                         (double)s.grains, s.temperature,        s.rotational_temperature,
                         s.strain,         s.image_offset};
  memcpy(numbers, head, sizeof head);
  memcpy(numbers + 8, s.box, sizeof s.box);
  memcpy(numbers + 11, s.kinetic_stress, sizeof s.kinetic_stress);
  return numbers;
}

PAGE const double *page_sums(page_simulation *p)
{
  static double numbers[4 + 9];
  gg_simulation_sums s;
  if (gg_simulation_take_sums(p->simulation, &s, &why) != GG_OK) return NULL;
  const double head[] = {s.time, (double)s.collisions, (double)s.wall_collisions, s.dissipation};
  memcpy(numbers, head, sizeof head);
  memcpy(numbers + 4, s.collisional_stress, sizeof s.collisional_stress);
  return numbers;
}

/* Fill the arrays; where they are: 0 positions (NULL in dsmc), 1 velocities, 2 spins, 3 species. */
PAGE int page_take_grains(page_simulation *p)
{
  return gg_simulation_get_grains(p->simulation, &p->grains, &why) == GG_OK;
}
PAGE void *page_array(page_simulation *p, int which)
{
  void *const arrays[] = {p->grains.position, p->grains.velocity, p->grains.spin, p->grains.species};
  return arrays[which];
}

PAGE int page_species(const page_simulation *p)
{
  return gg_simulation_species(p->simulation);
}
PAGE const double *page_species_state(const page_simulation *p, int species)
{
  static double numbers[6];
  gg_species_state s;
  if (gg_simulation_get_species(p->simulation, species, &s, &why) != GG_OK) return NULL;
  const double all[] = {(double)s.grains, s.diameter, s.mass, s.inertia, s.temperature, s.rotational_temperature};
  return memcpy(numbers, all, sizeof all);
}

PAGE const char *page_hash(const page_simulation *p)
{
  static char text[17];
  uint64_t hash;
  if (gg_simulation_hash(p->simulation, &hash, &why) != GG_OK) return NULL;
  snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
  return text;
}

/* ---- Runs in pieces, theories, comparisons ---- */

PAGE gg_session *page_session(const gg_scene *scene)
{
  gg_session *session = NULL;
  return gg_session_new(scene, &session, &why) == GG_OK ? session : NULL;
}
PAGE void page_session_free(gg_session *session)
{
  gg_session_free(session);
}
/* 1: over; 2: to be gone on with; 0: failed. */
PAGE int page_session_go_on(gg_session *session, double milliseconds)
{
  int over = 0;
  return gg_session_go_on(session, milliseconds / 1000, &over, &why) == GG_OK ? (over ? 1 : 2) : 0;
}
/* Fraction, averaging (0 or 1), collisions, relative error, seconds left; NaN: not known. */
PAGE const double *page_session_progress(const gg_session *session)
{
  static double numbers[5];
  gg_progress now;
  if (gg_session_get_progress(session, &now, &why) != GG_OK) return NULL;
  const double all[] = {now.fraction, now.phase[0] == 'a', (double)now.collisions, now.relative_error, now.time_left};
  return memcpy(numbers, all, sizeof all);
}
PAGE char *page_session_json(gg_session *session)
{
  char *text = NULL;
  gg_result *result = NULL;
  gg_status status = gg_session_result(session, &result, &why);
  if (status == GG_OK) status = gg_result_to_json(result, &text, &why);
  gg_result_free(result);
  return text;
}

/* Of the theories alone, until sessions put their results beside them. */
PAGE gg_comparison *page_comparison(const gg_scene *scene)
{
  gg_comparison *comparison = NULL;
  return gg_evaluate_theories(scene, NULL, &comparison, &why) == GG_OK ? comparison : NULL;
}
PAGE void page_comparison_free(gg_comparison *comparison)
{
  gg_comparison_free(comparison);
}
PAGE int page_comparison_take(gg_comparison *comparison, gg_session *session)
{
  gg_result *result = NULL;
  gg_status status = gg_session_result(session, &result, &why);
  if (status == GG_OK) status = gg_comparison_take(comparison, result, &why);
  if (status != GG_OK) gg_result_free(result);
  return status == GG_OK;
}
PAGE char *page_comparison_json(const gg_comparison *comparison)
{
  char *text = NULL;
  return gg_comparison_to_json(comparison, &text, &why) == GG_OK ? text : NULL;
}

/* A whole run without a break, for tests. */
PAGE char *page_run_json(const gg_scene *scene)
{
  char *text = NULL;
  gg_result *result = NULL;
  gg_status status = gg_run(scene, NULL, &result, &why);
  if (result) gg_result_to_json(result, &text, NULL);
  gg_result_free(result);
  if (status == GG_OK) return text;
  free(text);
  return NULL;
}

/* ---- Tables ---- */

/* The i-th entry of a list (gg_catalogue) as name, doc, unit, type, allowed and value, a line each; NULL after the
 * last. */
PAGE char *page_entry(int list, int i, const gg_scene *scene)
{
  gg_entry e;
  char *text = NULL;
  if (gg_catalogue_entry((gg_catalogue)list, (size_t)i, scene, &e, &why) != GG_OK) return NULL;
  const char *const part[] = {e.name, e.doc, e.unit, e.type, e.allowed, e.value};
#define LINE(k) part[k] ? part[k] : ""
  return asprintf(&text, "%s\n%s\n%s\n%s\n%s\n%s", LINE(0), LINE(1), LINE(2), LINE(3), LINE(4), LINE(5)) < 0 ? NULL
                                                                                                             : text;
#undef LINE
}
