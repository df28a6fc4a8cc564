/* Comparisons to and from files and documents; pictures, tables and trajectories of files. */
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "files/export/export.h"
#include "files/h5/result_file.h"
#include "files/h5/result_restore.h"
#include "files/result_document.h"
#include "plot/plot.h"

gg_status gg_comparison_to_json(const gg_comparison *comparison, char **text, gg_error *err)
{
  GG_NEED(comparison);
  GG_NEED(text);
  bool simulated = comparison->document || comparison->by_engine[GG_MD] || comparison->by_engine[GG_DSMC];
  return gg_api_text_copy(simulated ? gg_files_comparison_document(comparison)
                                    : gg_files_theory_document(&comparison->scene, comparison),
                          text, err);
}

gg_status gg_comparison_write(const gg_comparison *comparison, const char *path, gg_error *err)
{
  GG_NEED(comparison);
  GG_NEED(path);
  gg_result_file file;
  const gg_result *md = comparison->by_engine[GG_MD], *one = md ? md : comparison->by_engine[GG_DSMC];
  if (!one) return gg_base_fail(err, GG_BAD_INPUT, "%s: not written: nothing was simulated", path);
  if (comparison->of_one) return gg_result_write(one, path, err);
  GG_TRY(
      gg_files_result_file_open(&file, path, one->origin.command ? one->origin.command : "gg_comparison_write", err));
  return gg_files_result_file_finish_comparison(&file, comparison, err);
}

gg_status gg_comparison_read(const char *path, gg_comparison **comparison, gg_error *err)
{
  GG_NEED(path);
  GG_NEED(comparison);
  gg_stored_result stored;
  gg_comparison *c = gg_base_array_new(1, sizeof *c, err);
  if (!c) return GG_FAILED;
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_files_stored_result_read(&stored, path, err);
  if (status == GG_OK) status = gg_files_comparison_restore(&stored, c, err);
  gg_base_c_locale_leave(before);
  gg_files_stored_result_clear(&stored);
  if (status == GG_OK)
    *comparison = c;
  else
    gg_comparison_free(c);
  return status;
}

gg_status gg_plot(const char *result_file, const char *picture, const char *format,
                  void (*drawn)(void *context, const char *picture), void *context, gg_error *err)
{
  GG_NEED(result_file);
  GG_NEED(picture);
  if (gg_base_path_is_same_file(result_file, picture))
    return gg_base_fail(err, GG_BAD_INPUT, "%s: would be both the result and its picture; choose another picture",
                        picture);
  gg_stored_result stored;
  GG_TRY(gg_files_stored_result_read(&stored, result_file, err));
  bool before = gg_base_memory_begin();
  gg_status status = gg_plot_check_pages(&stored, result_file, picture, format, err);
  if (status == GG_OK) status = gg_plot_result(&stored, picture, format, err);
  if (status == GG_OK && drawn) drawn(context, picture);
  if (status == GG_OK) status = gg_plot_pages(&stored, picture, format, drawn, context, err);
  gg_files_stored_result_clear(&stored);
  return gg_base_memory_check(before, status, err); /* a picture that lacks its title */
}

gg_status gg_export(const char *result_file, const char *prefix, unsigned parts,
                    void (*written)(void *context, const char *file), void *context, gg_error *err)
{
  GG_NEED(result_file);
  GG_NEED(prefix);
  const char *slash = strrchr(prefix, '/'), *name = slash ? slash + 1 : prefix;
  if (!*name) return gg_base_fail(err, GG_BAD_INPUT, "'%s': the files need a prefix to their names", prefix);
  if (!(parts & GG_EXPORT_ALL) || parts & ~(unsigned)GG_EXPORT_ALL)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: %u is no set of parts to export; allowed: sums of GG_EXPORT_...",
                        result_file, parts);
  gg_stored_result stored;
  GG_TRY(gg_files_stored_result_read(&stored, result_file, err));
  gg_status status = gg_export_result(&stored, result_file, prefix, parts, written, context, err);
  gg_files_stored_result_clear(&stored);
  return status;
}
