/* Results to and from files and documents. */
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/c_locale.h"
#include "files/h5/result_file.h"
#include "files/h5/result_restore.h"
#include "files/result_document.h"

gg_status gg_result_to_json(const gg_result *result, char **text, gg_error *err)
{
  GG_NEED(result);
  GG_NEED(text);
  return gg_api_text_copy(gg_files_run_document(result), text, err);
}

gg_status gg_result_write(const gg_result *result, const char *path, gg_error *err)
{
  GG_NEED(result);
  GG_NEED(path);
  gg_result_file file;
  const char *command = result->origin.command ? result->origin.command : "gg_result_write";
  GG_TRY(gg_files_result_file_open(&file, path, command, err));
  return gg_files_result_file_finish_run(&file, result, err);
}

static gg_status restore(const gg_stored_result *stored, const char *path, gg_result **result, gg_error *err)
{
  if (stored->comparison)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: holds a comparison: read it with gg_comparison_read", path);
  return gg_files_result_restore(stored, stored->engine[GG_MD].name ? GG_MD : GG_DSMC, result, err);
}

gg_status gg_result_read(const char *path, gg_result **result, gg_error *err)
{
  GG_NEED(path);
  GG_NEED(result);
  gg_stored_result stored;
  locale_t before = gg_base_c_locale_enter();
  gg_status status = gg_files_stored_result_read(&stored, path, err);
  if (status == GG_OK) status = restore(&stored, path, result, err);
  gg_base_c_locale_leave(before);
  gg_files_stored_result_clear(&stored);
  return status;
}
