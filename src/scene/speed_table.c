/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients of contacts as tables of the normal speed, in the form of common/laws/speed_laws.h. */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "scene/scene_reader.h"

gg_status gg_scene_speed_table_add(double speed, double value, char text[GG_LAWS_TEXT], gg_error *err)
{
  char v[GG_NUMBER_TEXT], x[GG_NUMBER_TEXT];
  const size_t used = strlen(text);
  gg_io_number_format(speed, v), gg_io_number_format(value, x);
  const int added = snprintf(text + used, GG_LAWS_TEXT - used, "%s%s %s;", used ? "" : "table ", v, x);
  if (added < (int)(GG_LAWS_TEXT - used)) return GG_OK;
  return GG_REFUSE(err, "a table has at most %d rows, and %d characters", GG_LAW_ROWS, GG_LAWS_TEXT);
}

static gg_status read_rows(FILE *in, const char *path, char text[GG_LAWS_TEXT], gg_error *err)
{
  char line[512], separator[8], rest;
  double speed, value;
  for (int n = 1; fgets(line, sizeof line, in); n++) {
    const char *at = line + strspn(line, " \t\r\n");
    if (!*at || *at == '#' || (!*text && isalpha((unsigned char)*at))) continue;
    if (sscanf(at, "%lf%7[ \t,]%lf %c", &speed, separator, &value, &rest) != 3)
      return GG_REFUSE(err, "%s:%d: two numbers are expected, a speed and the value there", path, n);
    GG_TRY(gg_scene_speed_table_add(speed, value, text, err));
  }
  return *text ? GG_OK : GG_REFUSE(err, "%s: the table has no row", path);
}

gg_status gg_scene_file_beside(const char *file, const char *beside, char path[PATH_MAX], gg_error *err)
{
  struct stat about;
  const char *slash = beside && *file != '/' ? strrchr(beside, '/') : NULL;
  if (snprintf(path, PATH_MAX, "%.*s%s", slash ? (int)(slash - beside) + 1 : 0, slash ? beside : "", file) >= PATH_MAX)
    return gg_base_fail(err, GG_BAD_FILE, "the path of the file is too long");
  return stat(path, &about) == 0 && !S_ISREG(about.st_mode)
             ? gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: it is no file", path)
             : GG_OK;
}

gg_status gg_scene_speed_table_read(const char *file, const char *beside, char text[GG_LAWS_TEXT], gg_error *err)
{
  char path[PATH_MAX];
  GG_TRY(gg_scene_file_beside(file, beside, path, err));
  GG_CLOSED FILE *in = fopen(path, "r");
  return in ? read_rows(in, path, text, err)
            : gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
}
