#include "files/h5/hdf5_writer.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The system's word for it ("No space left on device") stands at the bottom of HDF5's error stack. */
static herr_t find_cause(unsigned n, const H5E_error2_t *entry, void *context)
{
  gg_h5 *h = context;
  const char *start = entry->desc ? strstr(entry->desc, "error message = '") : NULL;
  (void)n;
  if (entry->maj_num == H5E_RESOURCE && entry->min_num == H5E_NOSPACE) {
    snprintf(h->why, sizeof h->why, "out of memory");
    return 1;
  }
  if (!start) return 0;
  start += strlen("error message = '");
  const char *end = strchr(start, '\'');
  snprintf(h->why, sizeof h->why, "%.*s", end ? (int)(end - start) : 100, start);
  return 1;
}

void gg_h5_failed(gg_h5 *h, const char *what)
{
  if (h->failed) return;
  h->failed = true;
  /* HDF5 does not always say that it was memory that it lacked; what fails then ends before anything else can. */
  snprintf(h->why, sizeof h->why, "%.200s", errno == ENOMEM ? "out of memory" : what);
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, find_cause, h);
}

static void start(gg_h5 *h)
{
  *h = (gg_h5){.file = -1};
  errno = 0;
  H5Eget_auto2(H5E_DEFAULT, &h->print, &h->print_data);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static void create(gg_h5 *h, const char *path, bool in_memory)
{
  start(h);
  if (!gg_base_memory_is_room()) {
    gg_h5_failed(h, "out of memory");
    return;
  }
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  bool ready = H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0 &&
               /* the form that hdf5_reader.h reads */
               H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST) >= 0 &&
               (!in_memory || H5Pset_fapl_core(access, 1 << 20, 0) >= 0);
  if (!ready) gg_h5_failed(h, "out of memory");
  if (ready) h->file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (h->file < 0) gg_h5_failed(h, "HDF5 cannot create it"); /* before the next call clears HDF5's error stack */
  H5Pclose(access);
}

/* HDF5 takes open files of one name for one file, those in memory, too: each has its own. */
void gg_h5_create_in_memory(gg_h5 *h)
{
  char name[40];
  snprintf(name, sizeof name, "graingas-%p", (void *)h);
  create(h, name, true);
}

void gg_h5_create(gg_h5 *h, const char *path)
{
  create(h, path, false);
}

void *gg_h5_image(gg_h5 *h, size_t *size)
{
  if (h->failed) return NULL;
  ssize_t needed = H5Fflush(h->file, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(h->file, NULL, 0);
  void *image = needed > 0 ? malloc((size_t)needed) : NULL;
  if (!image || H5Fget_file_image(h->file, image, (size_t)needed) < 0) {
    gg_h5_failed(h, "out of memory");
    free(image);
    return NULL;
  }
  *size = (size_t)needed;
  return image;
}

void gg_h5_close(gg_h5 *h)
{
  if (h->file >= 0 && H5Fclose(h->file) < 0) gg_h5_failed(h, "HDF5 cannot close it");
  H5Eset_auto2(H5E_DEFAULT, h->print, h->print_data);
  h->file = -1;
}

gg_status gg_h5_status(const gg_h5 *h, const char *path, const char *verb, gg_error *err)
{
  return h->failed ? gg_base_fail(err, GG_BAD_FILE, "%s: cannot be %s: %s", path, verb, h->why) : GG_OK;
}

static bool exists(gg_h5 *h, const char *path)
{
  char part[256];
  if (h->failed) return false;
  for (const char *end = path + 1;; end++) { /* every group on the way must exist, too */
    if (*end && *end != '/') continue;
    snprintf(part, sizeof part, "%.*s", (int)(end - path), path);
    if (H5Lexists(h->file, part, H5P_DEFAULT) <= 0) return false;
    if (!*end) return true;
  }
}

void gg_h5_group(gg_h5 *h, const char *path)
{
  if (h->failed || exists(h, path)) return;
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  hid_t group = H5Gcreate2(h->file, path, links, H5P_DEFAULT, H5P_DEFAULT);
  if (group < 0) gg_h5_failed(h, path);
  H5Gclose(group);
  H5Pclose(links);
}

void gg_h5_link(gg_h5 *h, const char *target, const char *path)
{
  if (h->failed) return;
  hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  if (H5Lcreate_hard(h->file, target, h->file, path, links, H5P_DEFAULT) < 0) gg_h5_failed(h, path);
  H5Pclose(links);
}
