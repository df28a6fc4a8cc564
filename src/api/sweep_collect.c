/* What a sweep came to, as tables and a picture. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "base/atomic_file.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "sweep/sweep_table.h"

typedef struct collecting {
  const gg_sweep *sweep;
  gg_collecting options;
  gg_point_table table;
  char *csv, *h5, *svg;
  const char *picture; /* NULL: none */
  void (*written)(void *context, const char *file);
  void *context;
} collecting;

static void report(const collecting *c, const char *file)
{
  if (c->written) c->written(c->context, file);
}

/* Better known before than after. */
static gg_status check_places(const collecting *c, gg_error *err)
{
  GG_TRY(gg_base_atomic_check_writable(c->csv, "tables are files", err));
  GG_TRY(gg_base_atomic_check_writable(c->h5, "tables are files", err));
  return c->picture ? gg_base_atomic_check_writable(c->picture, "pictures are files", err) : GG_OK;
}

/* Values that are words have no axis, for instance: the tables are what there is to have. */
static bool may_lack_picture(const collecting *c, gg_status status, const gg_error *err)
{
  const gg_collecting *o = &c->options;
  if (!o->warn || o->picture || o->over || o->show || status == GG_BAD_FILE) return false;
  o->warn(c->context, err ? err->message : "there is no picture");
  return true;
}

static gg_status write_all(collecting *c, const char *folder, gg_error *err)
{
  const gg_picture_choice choice = {c->options.over, c->options.show};
  const char *command = c->options.command ? c->options.command : "the graingas library";
  GG_TRY(check_places(c, err));
  GG_TRY(gg_sweep_point_table_read(&c->table, c->sweep, folder, err));
  GG_TRY(gg_sweep_point_table_write_csv(&c->table, c->sweep, c->csv, err));
  report(c, c->csv);
  GG_TRY(gg_sweep_point_table_write_h5(&c->table, c->sweep, c->h5, command, err));
  report(c, c->h5);
  if (!c->picture) return GG_OK;
  gg_status status = gg_sweep_point_table_draw(&c->table, c->sweep, &choice, c->picture, err);
  if (status == GG_OK) report(c, c->picture);
  return status == GG_OK || !may_lack_picture(c, status, err) ? status : GG_OK;
}

static char *with(const char *prefix, const char *ending)
{
  char *path = NULL;
  return asprintf(&path, "%s%s", prefix, ending) < 0 ? NULL : path;
}

gg_status gg_sweep_collect(gg_sweep *sweep, const char *folder, const char *prefix, const gg_collecting *options,
                           void (*written)(void *context, const char *file), void *context, gg_error *err)
{
  GG_NEED(sweep, folder, prefix);
  GG_TRY(gg_sweep_check(sweep, err));
  collecting c = {.sweep = sweep, .written = written, .context = context};
  if (options) c.options = *options;
  c.csv = with(prefix, ".csv"), c.h5 = with(prefix, ".h5"), c.svg = with(prefix, ".svg");
  c.picture = c.options.picture ? c.options.picture : c.svg;
  if (strcmp(c.picture ? c.picture : "", "none") == 0) c.picture = NULL;
  GG_C_LOCALE;
  gg_status status = c.csv && c.h5 && c.svg ? write_all(&c, folder, err) : gg_base_out_of_memory(err);
  gg_sweep_point_table_clear(&c.table);
  free(c.csv), free(c.h5), free(c.svg);
  return status;
}
