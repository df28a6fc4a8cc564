/* Runs and comparisons with options. */
#include "door/run.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "io/atomic_file.h"
#include "io/c_locale.h"
#include "io/h5/checkpoint_file.h"

static void hear_progress(void *context, const gg_progress *progress)
{
  gg_door_run *r = context;
  if (r->options.progress && r->options.progress(r->options.context, progress)) atomic_store(&r->stopped, true);
}

bool gg_door_run_stopped(void *context)
{
  gg_door_run *r = context;
  if (r->options.stop && r->options.stop(r->options.context)) atomic_store(&r->stopped, true);
  return atomic_load(&r->stopped);
}

static gg_status store_checkpoint(void *context, gg_archive *archive, gg_error *err)
{
  gg_door_run *r = context;
  locale_t before = gg_c_locale_enter();
  gg_status status = gg_door_trajectory_mark(r, archive, err);
  if (status == GG_OK) status = gg_checkpoint_write(r->options.checkpoint, archive, &r->scene, err);
  gg_c_locale_leave(before);
  if (status != GG_OK) return status;
  r->stored = true;
  if (r->options.stored) r->options.stored(r->options.context, r->options.checkpoint);
  return GG_OK;
}

static gg_status read_resume(gg_door_run *r, gg_error *err)
{
  bool older;
  char text[1024];
  const char *path = r->options.resume;
  GG_TRY(gg_checkpoint_read(path, &r->resume, &older, err));
  snprintf(text, sizeof text, "%s cannot be read; going on from the one before, %s.1", path, path);
  if (older && r->options.warn) r->options.warn(r->options.context, text);
  return GG_OK;
}

static bool same_file(const char *a, const char *b)
{
  struct stat one, two;
  if (!a || !b) return false;
  return strcmp(a, b) == 0 ||
         (stat(a, &one) == 0 && stat(b, &two) == 0 && one.st_dev == two.st_dev && one.st_ino == two.st_ino);
}

/* What cannot be written is better known before the run than after it. */
static gg_status check_files(const gg_run_options *o, gg_error *err)
{
  if (same_file(o->output, o->checkpoint) || same_file(o->output, o->resume))
    return gg_fail(err, GG_BAD_INPUT, "%s: a checkpoint would be overwritten by the result; choose another output",
                   o->output);
  return o->checkpoint ? gg_check_writable(o->checkpoint, err) : GG_OK;
}

gg_status gg_door_run_begin(gg_door_run *r, const gg_scene *scene, const gg_run_options *options, gg_hooks *hooks,
                            gg_error *err)
{
  memset(r, 0, sizeof *r);
  r->file = (gg_result_file){.h.file = -1, .file.fd = -1};
  r->log.fd = -1;
  if (options) r->options = *options;
  if (r->options.threads < 1) r->options.threads = 1;
  if (!r->options.command) r->options.command = "the graingas library";
  atomic_init(&r->stopped, false);
  *hooks = (gg_hooks){.context = r, .progress = hear_progress, .interrupted = gg_door_run_stopped};
  if (r->options.checkpoint) hooks->checkpoint = store_checkpoint;
  GG_TRY(gg_door_finished(scene, &r->scene, err));
  GG_TRY(gg_model_make(&r->scene, r->scene.engine, &r->model, err));
  GG_TRY(check_files(&r->options, err));
  if (r->options.resume) GG_TRY(read_resume(r, err));
  if (!r->options.output) return GG_OK;
  return gg_result_file_open(&r->file, r->options.output, r->options.command, err);
}

void gg_door_run_end(gg_door_run *r)
{
  gg_result_file_abandon(&r->file);
  gg_door_trajectory_end(r);
  gg_archive_clear(&r->resume);
}

const gg_archive *gg_door_run_resume(const gg_door_run *r)
{
  return r->resume.n_items ? &r->resume : NULL;
}

gg_status gg_door_run_status(gg_status run, gg_status written, const gg_error *why, gg_error *err)
{
  if (written == GG_OK) return run;
  if (run == GG_OK) return gg_fail(err, written, "%s", why->message);
  char message[sizeof why->message];
  memcpy(message, why->message, sizeof message);
  return gg_fail(err, written, "%.500s; and %.500s", message, err ? err->message : "");
}

gg_status gg_run(const gg_scene *scene, const gg_run_options *options, gg_result **result, gg_error *err)
{
  GG_NEED(scene);
  GG_NEED(result);
  gg_door_run run;
  gg_hooks hooks;
  gg_error why = {0};
  gg_status status = gg_door_run_begin(&run, scene, options, &hooks, err), written = GG_OK;
  gg_result *made = NULL;
  if (status == GG_OK) status = gg_door_trajectory_begin(&run, &hooks, err);
  if (status == GG_OK)
    status = gg_run_scene(&run.scene, gg_door_run_resume(&run), run.options.threads, &hooks, &made, err);
  if (made && run.options.output && (status == GG_OK || status == GG_FAILED)) {
    written = gg_door_trajectory_finish(&run, made, &why);
    if (written == GG_OK) written = gg_result_file_finish_run(&run.file, made, &why);
  }
  gg_door_run_end(&run);
  if (made) *result = made;
  return gg_door_run_status(status, written, &why, err);
}
