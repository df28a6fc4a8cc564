#include "files/h5/result_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "base/c_locale.h"
#include "base/memory.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/particles.h"
#include "files/result_document.h"

typedef struct gg_result_writer {
  bool streaming; /* frames go to the disk as they come; otherwise the file is made in memory */
  gg_h5 h;
  gg_h5_particles particles;
} gg_result_writer;

gg_status gg_files_result_file_open(gg_result_file *f, const char *path, const char *command, gg_error *err)
{
  *f = (gg_result_file){.file = GG_ATOMIC_NONE, .command = command};
  return gg_base_atomic_open(&f->file, path, err);
}

static void forget(gg_result_file *f)
{
  gg_result_writer *w = f->now;
  f->now = NULL;
  if (!w) return;
  gg_h5_particles_close(&w->h, &w->particles);
  if (w->h.file >= 0) gg_h5_close(&w->h);
  free(w);
}

void gg_files_result_file_abandon(gg_result_file *f)
{
  forget(f);
  gg_base_atomic_abandon(&f->file);
}

/* On the disk under its temporary name, or in memory: what is small, and what goes to a device or pipe. */
static gg_status create(gg_result_file *f, bool streaming, gg_error *err)
{
  if (f->now) return GG_OK;
  gg_result_writer *w = gg_base_array_new(1, sizeof *w, err);
  if (!w) {
    gg_files_result_file_abandon(f);
    return GG_FAILED;
  }
  w->streaming = streaming;
  if (streaming)
    gg_h5_create(&w->h, f->file.temporary);
  else
    gg_h5_create_in_memory(&w->h);
  f->now = w;
  return GG_OK;
}

/* HDF5 recovers badly from a full disk: ask first. */
static gg_status check_room(const gg_result_file *f, const gg_frame *frame, gg_error *err)
{
  struct statvfs disk;
  double needed = 2.0 * (double)frame->n * 9 * sizeof(double) + (1 << 22);
  if (f->file.place.stream) return GG_OK;
  if (fstatvfs(f->file.fd, &disk) == 0 && (double)disk.f_bavail * (double)disk.f_frsize < needed)
    return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be written: %s", f->file.path, strerror(ENOSPC));
  return GG_OK;
}

gg_status gg_files_result_file_frame(gg_result_file *f, const gg_model *model, const gg_frame *frame, gg_error *err)
{
  GG_TRY(check_room(f, frame, err));
  GG_TRY(create(f, !f->file.place.stream, err));
  gg_h5_particles_append(&f->now->h, &f->now->particles, model, frame);
  return gg_h5_status(&f->now->h, f->file.path, "written", err);
}

static gg_status write_image(gg_result_file *f, const void *image, size_t size, gg_error *err)
{
  unsigned char seal[GG_SEAL_SIZE];
  gg_files_checksum_trailer_of(image, size, seal);
  GG_TRY(gg_base_atomic_write(&f->file, image, size, err));
  return gg_base_atomic_write(&f->file, seal, sizeof seal, err);
}

/* HDF5 wrote it, in an order of its own: it is read once for its checksum. */
static gg_status seal_streamed(gg_result_file *f, gg_error *err)
{
  unsigned char seal[GG_SEAL_SIZE];
  if (gg_files_checksum_trailer_of_file(f->file.fd, seal) != 0 || lseek(f->file.fd, 0, SEEK_END) < 0)
    return gg_base_path_write_error(f->file.path, strerror(errno), err);
  return gg_base_atomic_write(&f->file, seal, sizeof seal, err);
}

/* Close what was streamed, or write what was made in memory; then put it in place. */
static gg_status finish(gg_result_file *f, gg_error *err)
{
  gg_result_writer *w = f->now;
  gg_h5_particles_close(&w->h, &w->particles);
  size_t size = 0;
  void *image = w->streaming ? NULL : gg_h5_image(&w->h, &size);
  gg_h5_close(&w->h);
  gg_status status = gg_h5_status(&w->h, f->file.path, "written", err);
  if (status == GG_OK) status = w->streaming ? seal_streamed(f, err) : write_image(f, image, size, err);
  free(image);
  forget(f);
  if (status == GG_OK) return gg_base_atomic_commit(&f->file, err);
  gg_base_atomic_abandon(&f->file);
  return status;
}

static void write_document(gg_result_file *f, const gg_scene *scene, json_t *document)
{
  char *text = document ? gg_files_document_text(document) : NULL;
  if (text)
    gg_h5_write_header(&f->now->h, f->command, scene, text);
  else
    gg_h5_failed(&f->now->h, "out of memory");
  free(text);
  json_decref(document);
}

static void write_last_frame(gg_result_file *f, const gg_result *r)
{
  gg_result_writer *w = f->now;
  bool fresh = !w->particles.started || r->final.step > w->particles.last_step;
  if (r->final.n && r->final.velocity && fresh) gg_h5_particles_append(&w->h, &w->particles, &r->model, &r->final);
}

gg_status gg_files_result_file_finish_run(gg_result_file *f, const gg_result *result, gg_error *err)
{
  GG_TRY(create(f, false, err));
  locale_t before = gg_base_c_locale_enter();
  write_document(f, &result->scene, gg_files_run_document(result));
  gg_h5_text_attribute(&f->now->h, "/graingas", "kind", "run");
  gg_h5_write_engine(&f->now->h, "/graingas", "/observables/", result);
  write_last_frame(f, result);
  gg_base_c_locale_leave(before);
  return finish(f, err);
}

gg_status gg_files_result_file_finish_comparison(gg_result_file *f, const gg_comparison *c, gg_error *err)
{
  const gg_result *md = c->by_engine[GG_MD], *dsmc = c->by_engine[GG_DSMC];
  GG_TRY(create(f, false, err));
  locale_t before = gg_base_c_locale_enter();
  write_document(f, &c->scene, gg_files_comparison_document(c));
  gg_h5_text_attribute(&f->now->h, "/graingas", "kind", "compare");
  if (md) gg_h5_write_engine(&f->now->h, "/graingas/md", "/observables/md_", md);
  if (dsmc) gg_h5_write_engine(&f->now->h, "/graingas/dsmc", "/observables/dsmc_", dsmc);
  gg_h5_write_theories(&f->now->h, c);
  if (md || dsmc) write_last_frame(f, md ? md : dsmc);
  gg_base_c_locale_leave(before);
  return finish(f, err);
}
