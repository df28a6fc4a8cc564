/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A small result with all that readers read: a tenth of the words, so that an input takes a tenth of the time. */
#include <hdf5.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compressed.h"
#include "files/h5/hdf5_reader.h"
#include "files/h5/hdf5_writer.h"
#include "image.h"

/* Quantities of each kind that readers distinguish: headline, absent from some flows, of mixtures, without a mean. */
static bool is_kept(const char *quantity)
{
  static const char *const kept[] = {"temperature", "rotational_temperature", "temperature_2", "N1", "P_xy"};
  for (size_t i = 0; i < sizeof kept / sizeof *kept; i++)
    if (strcmp(quantity, kept[i]) == 0) return true;
  return false;
}

static void thin_quantities(json_t *quantities)
{
  const char *name;
  json_t *one;
  void *next;
  json_object_foreach_safe(quantities, next, name, one) if (!is_kept(name)) json_object_del(quantities, name);
}

/* Delete all members but the first `most`. */
static void thin_map(json_t *map, size_t most)
{
  const char *name;
  json_t *one;
  void *next;
  size_t n = 0;
  json_object_foreach_safe(map, next, name, one) if (++n > most) json_object_del(map, name);
}

static void thin_run(json_t *run)
{
  json_t *warnings = json_object_get(run, "warnings");
  thin_quantities(json_object_get(run, "results"));
  json_object_del(run, "scene"); /* readers take it from /graingas/scene */
  while (json_array_size(warnings) > 1) json_array_remove(warnings, 1);
}

static void thin_document(json_t *document)
{
  const char *name;
  json_t *theory;
  thin_run(document);
  thin_run(json_object_get(document, "md"));
  thin_run(json_object_get(document, "dsmc"));
  json_object_foreach(json_object_get(document, "theory"), name, theory) thin_quantities(theory);
  thin_map(json_object_get(document, "theory"), 3);
  thin_map(json_object_get(document, "theories"), 3);
}

static char *small_document(const char *path)
{
  gg_h5_in in;
  gg_h5_open(&in, path, false);
  char *text = gg_h5_read_text(&in, "/graingas/document");
  gg_h5_in_close(&in);
  json_t *document = text ? json_loads(text, 0, NULL) : NULL;
  free(text);
  thin_document(document);
  text = json_dumps(document, JSON_COMPACT);
  json_decref(document);
  return text;
}

/* Delete the copies of parts of the document, which are for other programs only. */
static void cut_copies(const char *path)
{
  static const char *const parts[] = {"", "/md", "/dsmc"}, *const copies[] = {"results", "curves"};
  hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
  char name[40];
  for (size_t i = 0; i < 3; i++)
    for (size_t k = 0; k < 2; k++) {
      snprintf(name, sizeof name, "/graingas%s/%s", parts[i], copies[k]);
      H5Ldelete(file, name, H5P_DEFAULT); /* not all exist */
    }
  H5Ldelete(file, "/graingas/document", H5P_DEFAULT);
  H5Ldelete(file, "/graingas/theory", H5P_DEFAULT);
  H5Ldelete(file, "/graingas/scene", H5P_DEFAULT);
  H5Fclose(file);
}

static herr_t copy(hid_t from, const char *name, const H5L_info_t *about, void *to)
{
  (void)about;
  return H5Ocopy(from, name, *(hid_t *)to, name, H5P_DEFAULT, H5P_DEFAULT);
}

fuzz_image fuzz_small_result(const char *path, const char *scene, bool compressed)
{
  gg_h5 h;
  size_t size = 0;
  char *document = small_document(path);
  gg_h5_create(&h, NULL); /* also turns off HDF5's error messages */
  cut_copies(path);
  hid_t from = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (!document || H5Literate(from, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, copy, &h.file) < 0) abort();
  gg_h5_text(&h, "/graingas/document", document);
  gg_h5_text(&h, "/graingas/scene", scene);
  if (compressed) fuzz_compress(h.file);
  void *data = gg_h5_image(&h, &size);
  gg_h5_close(&h);
  H5Fclose(from);
  free(document);
  remove(path);
  return fuzz_image_of_bytes(data, size);
}
