/* The sweeps of a figure: run, and read back. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "reproduce/figures.h"
#include "sweep/sweep.h"

/* Where the results of all figures of a folder lie: the same runs serve several of them. */
static char *folder_of(const gg_reproduce_options *o)
{
  char *path = NULL;
  return asprintf(&path, "%s%sfigures.sweep", o->folder ? o->folder : "", o->folder ? "/" : "") < 0 ? NULL : path;
}

/* At quick precision a key takes fewer values. */
static void vary_no_more(gg_sweep *sweep, const char *key)
{
  for (size_t f = 0; f < sweep->n_varied; f++) {
    if (sweep->varied[f].n_keys != 1 || strcmp(sweep->varied[f].key[0], key) != 0) continue;
    gg_sweep_varied_clear(&sweep->varied[f]);
    sweep->n_varied--;
    memmove(&sweep->varied[f], &sweep->varied[f + 1], (sweep->n_varied - f) * sizeof *sweep->varied);
    return;
  }
}

/* "[0.5, 0.7]" -> "0.5, 0.7" */
static gg_status vary_anew(gg_sweep *sweep, const gg_set *set, gg_error *err)
{
  size_t length = strlen(set->value), skip = 0;
  while (length && strchr(" \n]", set->value[length - 1])) length--;
  if (*set->value == '[') skip = 1;
  char *values = strndup(set->value + skip, length - skip);
  if (!values) return gg_base_out_of_memory(err);
  vary_no_more(sweep, set->key);
  gg_status status = gg_sweep_vary(sweep, set->key, values, err);
  free(values);
  return status;
}

static gg_status make_quick(gg_sweep *sweep, const gg_figure_entry *of, gg_error *err)
{
  for (int i = 0; i < of->n_quick; i++) GG_TRY(gg_sweep_set(sweep, of->quick[i].key, of->quick[i].value, err));
  for (int i = 0; i < of->n_quick_vary; i++) GG_TRY(vary_anew(sweep, &of->quick_vary[i], err));
  return GG_OK;
}

static gg_status parse(const gg_entry_sweep *of, const gg_figure_entry *owner, bool quick, gg_sweep **sweep,
                       gg_error *err)
{
  *sweep = NULL;
  GG_TRY(gg_sweep_parse(of->yaml, owner->file, sweep, err));
  gg_status status = quick ? make_quick(*sweep, owner, err) : GG_OK;
  if (status != GG_OK) status = gg_base_error_prefix(err, status, "%s: quick", owner->file);
  if (status == GG_OK) status = gg_sweep_check(*sweep, err);
  if (status == GG_OK) return GG_OK;
  gg_sweep_free(*sweep);
  *sweep = NULL;
  return status;
}

/* A sweep that is another figure's comes with that figure's quick precision. */
static gg_status make_sweep(const gg_figure_entry *entry, int i, bool quick, gg_sweep **sweep, gg_error *err)
{
  const gg_entry_sweep *own = &entry->sweep[i];
  gg_figure_entry other;
  size_t k;
  if (own->yaml) return parse(own, entry, quick, sweep, err);
  gg_status status = gg_reproduce_figure_find(own->figure, &k, err);
  if (status == GG_OK) status = gg_reproduce_figure_read(k, &other, err);
  if (status != GG_OK) return gg_base_error_prefix(err, status, "%s: key 'sweep'", entry->file);
  if (other.n_sweeps != 1 || !other.sweep[0].yaml)
    status =
        gg_base_fail(err, GG_BAD_INPUT, "%s: key 'sweep': %s has not one sweep of its own", entry->file, other.figure);
  else
    status = parse(&other.sweep[0], &other, quick, sweep, err);
  gg_reproduce_entry_clear(&other);
  return status;
}

static void free_sweeps(gg_sweep *sweeps[GG_MOST_SWEEPS])
{
  for (int i = 0; i < GG_MOST_SWEEPS; i++) {
    gg_sweep_free(sweeps[i]);
    sweeps[i] = NULL;
  }
}

gg_status gg_reproduce_figure_sweeps(const gg_figure_entry *entry, bool quick, gg_sweep *sweeps[GG_MOST_SWEEPS],
                                     gg_error *err)
{
  for (int i = 0; i < GG_MOST_SWEEPS; i++) sweeps[i] = NULL;
  for (int i = 0; i < entry->n_sweeps; i++) {
    gg_status status = make_sweep(entry, i, quick, &sweeps[i], err);
    if (status == GG_OK) continue;
    free_sweeps(sweeps);
    return status;
  }
  return GG_OK;
}

void gg_reproduce_figure_points_clear(gg_figure_points *all)
{
  for (size_t i = 0; i < all->n; i++) {
    for (size_t k = 0; k < all->point[i].n_varied; k++) free(all->point[i].varied[k]);
    free(all->point[i].path);
    gg_files_stored_result_clear(&all->point[i].stored);
  }
  free(all->point);
  *all = (gg_figure_points){0};
}

static gg_status read_point(gg_sweep *sweep, const char *name, const char *folder, size_t i, gg_figure_points *all,
                            gg_error *err)
{
  gg_point_state state;
  gg_scene *scene;
  char *path = NULL;
  GG_TRY(gg_sweep_find(sweep, folder, i, &state, &path, err));
  if (state == GG_POINT_MISSING) return free(path), GG_OK;
  gg_figure_point *more = realloc(all->point, (all->n + 1) * sizeof *more);
  if (!more) return free(path), gg_base_out_of_memory(err);
  all->point = more;
  gg_figure_point *p = &all->point[all->n++];
  *p = (gg_figure_point){.sweep = name, .path = path};
  GG_TRY(gg_sweep_scene(sweep, i, &scene, err));
  p->scene = *scene;
  gg_scene_free(scene);
  for (const char *key; p->n_varied < GG_MOST_VARIED_KEYS && (key = gg_sweep_key(sweep, p->n_varied));) {
    if (!(p->varied[p->n_varied] = strdup(key))) return gg_base_out_of_memory(err);
    p->n_varied++;
  }
  GG_TRY(gg_files_stored_result_read(&p->stored, path, err));
  if (p->stored.changed)
    return gg_base_fail(err, GG_BAD_FILE, "%s: another program has changed it; remove it, and it is made anew", path);
  return gg_sweep_point_check(&p->scene, sweep->settings.does, json_object_get(p->stored.document, "scene"), path, err);
}

static gg_status read_points(const gg_figure_entry *entry, gg_sweep **sweeps, const char *folder, gg_figure_points *all,
                             gg_error *err)
{
  for (int s = 0; s < entry->n_sweeps; s++)
    for (size_t i = 0; i < gg_sweep_points(sweeps[s]); i++)
      GG_TRY(read_point(sweeps[s], entry->sweep[s].name, folder, i, all, err));
  return all->n ? GG_OK : gg_base_fail(err, GG_FAILED, "%s: no point came to an end", entry->figure);
}

/* What one sweep's run tells, handed on. */
typedef struct teller {
  const gg_reproduce_options *options;
  const char *figure;
} teller;

static void progress(void *context, const gg_sweep_progress *now)
{
  const teller *t = context;
  if (t->options->progress) t->options->progress(t->options->context, t->figure, now);
}

static int stop(void *context)
{
  const teller *t = context;
  return t->options->stop ? t->options->stop(t->options->context) : 0;
}

static void ended(void *context, size_t i, gg_status status, const char *file, const char *message)
{
  const teller *t = context;
  (void)i, (void)file;
  if (status != GG_OK && t->options->warn) t->options->warn(t->options->context, t->figure, message);
}

static void warn(void *context, const char *message)
{
  const teller *t = context;
  if (t->options->warn) t->options->warn(t->options->context, t->figure, message);
}

static gg_status run_all(const gg_figure_entry *entry, gg_sweep **sweeps, const char *folder,
                         const gg_reproduce_options *options, gg_error *err)
{
  teller t = {options, entry->figure};
  gg_sweep_options o = {.threads = options->threads,
                        .command = options->command,
                        .accept_version = options->accept_version,
                        .warn = warn,
                        .context = &t,
                        .progress = progress,
                        .stop = stop,
                        .ended = ended};
  gg_status worst = GG_OK;
  for (int s = 0; s < entry->n_sweeps; s++) {
    gg_status status = gg_sweep_run(sweeps[s], folder, &o, err);
    if (status == GG_FAILED)
      worst = status;
    else
      GG_TRY(status);
  }
  return worst;
}

gg_status gg_reproduce_figure_run(const gg_figure_entry *entry, const gg_reproduce_options *options,
                                  gg_figure_points *all, gg_error *err)
{
  gg_sweep *sweeps[GG_MOST_SWEEPS];
  *all = (gg_figure_points){0};
  GG_TRY(gg_reproduce_figure_sweeps(entry, options->quick, sweeps, err));
  char *folder = folder_of(options);
  gg_status status = folder ? run_all(entry, sweeps, folder, options, err) : gg_base_out_of_memory(err);
  if (status == GG_OK || (status == GG_FAILED && folder)) {
    gg_error reading;
    gg_status read = read_points(entry, sweeps, folder, all, &reading);
    if (read != GG_OK) {
      gg_reproduce_figure_points_clear(all); /* a part of them is no figure */
      status = gg_base_fail(err, read, "%s", reading.message);
    }
  }
  free(folder);
  free_sweeps(sweeps);
  return status;
}
