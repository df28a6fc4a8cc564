/* The files of a run, looked at before it begins. */
#include <stdio.h>
#include <stdlib.h>

#include "door/run.h"
#include "io/plot/plot.h"

typedef struct file {
  const char *path, *role, *option; /* option: what to choose another of; NULL: it is only read */
} file;

/* A checkpoint may take the place of the one that the run goes on from. */
static bool may_be_one(const file *a, const file *b)
{
  return !a->path || !b->path || (!a->option && !b->option) || (a->role[4] == 'c' && b->role[4] == 'c');
}

static gg_status check_pairs(const file *all, int n, gg_error *err)
{
  for (int i = 0; i < n; i++)
    for (int j = i + 1; j < n; j++)
      if (!may_be_one(&all[i], &all[j]) && gg_same_file(all[i].path, all[j].path))
        return gg_fail(err, GG_BAD_INPUT, "%s: would be both %s and %s; choose another %s", all[i].path, all[i].role,
                       all[j].role, all[i].option);
  return GG_OK;
}

/* FILE.1, where the checkpoint before is kept; to be freed. */
static char *before(const char *path)
{
  char *name = NULL;
  return path && asprintf(&name, "%s.1", path) >= 0 ? name : NULL;
}

/* It is drawn from the result when that is in place. */
gg_status gg_door_check_picture(const gg_run_options *o, gg_error *err)
{
  bool png;
  if (!o->picture) return GG_OK;
  gg_output_path place;
  GG_TRY(gg_plot_format(o->picture, NULL, &png, err));
  if (!o->output) return gg_fail(err, GG_BAD_INPUT, "%s: a picture is drawn from an output file: name one", o->picture);
  GG_TRY(gg_output_path_find(&place, o->output, err));
  bool stream = place.stream;
  gg_output_path_clear(&place);
  if (stream)
    return gg_fail(err, GG_BAD_INPUT, "%s: a picture is drawn from the output file, and %s keeps none", o->picture,
                   o->output);
  return gg_check_writable(o->picture, GG_PICTURES_ARE, err);
}

gg_status gg_door_check_files(const gg_run_options *o, gg_error *err)
{
  char *second = before(o->checkpoint), *third = before(o->resume);
  char *frames = o->checkpoint ? gg_frame_log_path(o->checkpoint) : NULL;
  const file all[] = {{o->output, "the result", "output"},
                      {o->picture, "the picture", "picture"},
                      {o->checkpoint, "the checkpoint", "checkpoint"},
                      {second, "the checkpoint before", "checkpoint"},
                      {frames, "the frames beside the checkpoint", "checkpoint"},
                      {o->resume, "the checkpoint that is gone on from", NULL},
                      {third, "the checkpoint before it", NULL},
                      {o->input, "the scene", NULL}};
  gg_status status = check_pairs(all, sizeof all / sizeof *all, err);
  free(second);
  free(third);
  free(frames);
  return status;
}
