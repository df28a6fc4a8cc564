/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/speed_table.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/fields.h"

bool gg_scene_speed_table_add(double speed, double value, char text[GG_LAWS_TEXT])
{
  char v[40], x[40];
  const size_t used = strlen(text);
  gg_scene_number_format(speed, v, sizeof v), gg_scene_number_format(value, x, sizeof x);
  return snprintf(text + used, GG_LAWS_TEXT - used, "%s%s %s;", used ? "" : "table ", v, x) <
         (int)(GG_LAWS_TEXT - used);
}

static bool parse_row(const char *line, double *speed, double *value)
{
  char *end;
  *speed = strtod(line, &end);
  if (end == line) return false;
  line = end + strspn(end, " \t");
  line += *line == ',';
  *value = strtod(line, &end);
  return end != line && !end[strspn(end, " \t\r\n")];
}

static gg_status read_rows(FILE *in, const char *path, char text[GG_LAWS_TEXT], gg_error *err)
{
  char line[512];
  double speed, value;
  for (int n = 1; fgets(line, sizeof line, in); n++) {
    const char *at = line + strspn(line, " \t\r\n");
    if (!*at || *at == '#' || (!*text && isalpha((unsigned char)*at))) continue;
    if (!parse_row(at, &speed, &value))
      return gg_base_fail(err, GG_BAD_INPUT, "%s:%d: two numbers are expected, a speed and the value there", path, n);
    if (!gg_scene_speed_table_add(speed, value, text))
      return gg_base_fail(err, GG_BAD_INPUT, "%s:%d: a table has at most %d rows, and %d characters", path, n,
                          GG_LAW_ROWS, GG_LAWS_TEXT);
  }
  if (!*text) return gg_base_fail(err, GG_BAD_INPUT, "%s: the table has no row", path);
  return GG_OK;
}

gg_status gg_scene_speed_table_read(const char *file, const char *beside, char text[GG_LAWS_TEXT], gg_error *err)
{
  char path[PATH_MAX];
  struct stat about;
  const char *slash = beside && *file != '/' ? strrchr(beside, '/') : NULL;
  const int folder = slash ? (int)(slash - beside) + 1 : 0;
  *text = '\0';
  if (snprintf(path, sizeof path, "%.*s%s", folder, folder ? beside : "", file) >= (int)sizeof path)
    return gg_base_fail(err, GG_BAD_FILE, "the path of the table is too long");
  const bool found = stat(path, &about) == 0; /* a pipe would block the reader */
  if (found && !S_ISREG(about.st_mode))
    return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: it is no file", path);
  FILE *in = found ? fopen(path, "r") : NULL;
  if (!in) return gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
  const gg_status status = read_rows(in, path, text, err);
  fclose(in);
  return status;
}
