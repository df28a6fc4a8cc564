/* Figures of the papers: what there is, and one or all of them reproduced. */
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/memory.h"
#include "base/text.h"
#include "common/engine.h"
#include "reproduce/figures.h"

/* Names of the points that figures before had. */
typedef struct seen {
  size_t n, room;
  char (*name)[sizeof((gg_sweep_point *)0)->name];
} seen;

static bool is_seen(const seen *s, const char *name)
{
  for (size_t i = 0; i < s->n; i++)
    if (strcmp(s->name[i], name) == 0) return true;
  return false;
}

static gg_status note(seen *s, const char *name, gg_error *err)
{
  if (s->n == s->room) {
    size_t room = s->room ? 2 * s->room : 256;
    void *more = realloc(s->name, room * sizeof *s->name);
    if (!more) return gg_base_out_of_memory(err);
    s->name = more, s->room = room;
  }
  strcpy(s->name[s->n++], name);
  return GG_OK;
}

static int64_t larger(int64_t a, int64_t b)
{
  return a > b ? a : b;
}

/* Which engines a point asks for, and how many grains of each. */
static void note_engines(gg_figure_needs *needs, const gg_scene *scene, bool both)
{
  gg_model m;
  if (both || scene->engine == GG_MD) {
    needs->md = true;
    needs->particles = larger(needs->particles, scene->particles);
  }
  if (both || scene->engine == GG_DSMC) {
    needs->dsmc = true;
    if (gg_common_model_make(scene, GG_DSMC, &m, NULL) == GG_OK) needs->particles = larger(needs->particles, m.n);
  }
}

/* How many points, which engines, and how long they will take. */
static gg_status needs_of(const gg_figure_entry *entry, bool quick, gg_figure_needs *needs, seen *before, gg_error *err)
{
  gg_sweep *sweeps[GG_MOST_SWEEPS];
  *needs = (gg_figure_needs){0};
  GG_TRY(gg_reproduce_figure_sweeps(entry, quick, sweeps, err));
  gg_status status = GG_OK;
  for (int s = 0; s < entry->n_sweeps; s++) {
    bool both = strcmp(gg_sweep_does(sweeps[s]), "compare") == 0;
    for (size_t i = 0; i < gg_sweep_points(sweeps[s]) && status == GG_OK; i++) {
      gg_sweep_point point;
      gg_scene *scene;
      status = gg_sweep_at(sweeps[s], i, &point, err);
      if (status == GG_OK) status = gg_sweep_scene(sweeps[s], i, &scene, err);
      if (status != GG_OK) break;
      needs->points++, needs->cpu_seconds += point.cpu_seconds;
      if (is_seen(before, point.name))
        needs->shared += point.cpu_seconds;
      else
        status = note(before, point.name, err);
      note_engines(needs, scene, both);
      gg_scene_free(scene);
    }
    gg_sweep_free(sweeps[s]);
  }
  return status;
}

static gg_status describe(const gg_figure_entry *e, gg_on_figure *figure, void *context, seen before[2], gg_error *err)
{
  char file[64];
  gg_figure_info info = {.name = e->figure,
                         .file = file,
                         .shows = e->shows,
                         .cannot = e->cannot,
                         .verdict = e->cannot ? NULL : e->verdict,
                         .because = e->because};
  gg_reproduce_figure_base(e, file, sizeof file);
  if (!e->cannot) GG_TRY(needs_of(e, true, &info.quick, &before[0], err));
  if (!e->cannot) GG_TRY(needs_of(e, false, &info.full, &before[1], err));
  figure(context, &info);
  return GG_OK;
}

gg_status gg_list_figures(gg_on_figure *figure, void *context, gg_error *err)
{
  GG_NEED_CALLBACK(figure);
  gg_status status = GG_OK;
  seen points[2] = {{0}};
  locale_t before = gg_base_c_locale_enter();
  for (size_t k = 0; gg_entry_files[k].file && status == GG_OK; k++) {
    gg_figure_entry entry;
    status = gg_reproduce_figure_read(k, &entry, err);
    if (status != GG_OK) break;
    status = describe(&entry, figure, context, points, err);
    gg_reproduce_entry_clear(&entry);
  }
  free(points[0].name);
  free(points[1].name);
  gg_base_c_locale_leave(before);
  return status;
}

static gg_status reproduce(size_t k, const gg_reproduce_options *options, gg_error *err)
{
  gg_figure_entry entry;
  GG_TRY(gg_reproduce_figure_read(k, &entry, err));
  gg_status status;
  if (entry.cannot)
    status = gg_base_fail(err, GG_FAILED, "%s cannot be reproduced: %s", entry.figure, entry.cannot);
  else
    status = gg_reproduce_figure_reproduce(&entry, options, err);
  gg_reproduce_entry_clear(&entry);
  return status;
}

/* One after the other; failures are reported, and the rest continues. */
static gg_status reproduce_all(const gg_reproduce_options *options, gg_error *err)
{
  int failed = 0;
  for (size_t k = 0; gg_entry_files[k].file; k++) {
    gg_error why;
    gg_figure_entry entry;
    GG_TRY(gg_reproduce_figure_read(k, &entry, err));
    bool cannot = entry.cannot;
    gg_status status = cannot ? GG_OK : gg_reproduce_figure_reproduce(&entry, options, &why);
    if (status == GG_FAILED && options->warn) options->warn(options->context, entry.figure, why.message);
    gg_reproduce_entry_clear(&entry);
    failed += status == GG_FAILED;
    if (status != GG_OK && status != GG_FAILED) return gg_base_fail(err, status, "%s", why.message);
  }
  return failed ? gg_base_fail(err, GG_FAILED, "%d figures did not reach the accuracy asked for", failed) : GG_OK;
}

gg_status gg_reproduce(const char *figure, const gg_reproduce_options *options, gg_error *err)
{
  GG_NEED(figure);
  const gg_reproduce_options none = {0};
  size_t k;
  locale_t before = gg_base_c_locale_enter();
  gg_status status = GG_OK;
  if (strcmp(figure, "all") != 0) {
    status = gg_reproduce_figure_find(figure, &k, err);
    if (status == GG_OK) status = reproduce(k, options ? options : &none, err);
  } else {
    status = reproduce_all(options ? options : &none, err);
  }
  gg_base_c_locale_leave(before);
  return status;
}

gg_status gg_reproduction_page(char **text, gg_error *err)
{
  GG_NEED(text);
  return gg_reproduce_figure_page(text, err);
}
