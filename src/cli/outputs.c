#include "cli/outputs.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ".h5" is an ending, the ".1" of "phi_0.1" none. */
char *gg_cli_path_with_suffix(const char *path, const char *suffix)
{
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
  bool ends = dot && dot > name && isalpha((unsigned char)dot[1]);
  char *result = NULL;
  return asprintf(&result, "%.*s%s", (int)(ends ? dot - path : (long)strlen(path)), path, suffix) < 0 ? NULL : result;
}

char *gg_cli_options_beside(const gg_options *o, const char *suffix)
{
  const char *slash = strrchr(o->input, '/');
  return gg_cli_path_with_suffix(strcmp(o->input, "-") == 0 ? "stdin" : slash ? slash + 1 : o->input, suffix);
}

static bool same_file(const char *a, const char *b)
{
  struct stat one, two;
  return stat(a, &one) == 0 && stat(b, &two) == 0 && one.st_dev == two.st_dev && one.st_ino == two.st_ino;
}

char *gg_cli_options_output(const gg_options *o, const char *suffix, gg_error *err)
{
  char *output = o->output ? strdup(o->output) : gg_cli_options_beside(o, suffix);
  if (!output) gg_cli_refuse(err, GG_FAILED, "out of memory");
  if (!output || !same_file(output, o->input)) return output;
  gg_cli_refuse(err, GG_BAD_INPUT, "%s: would be overwritten by its own result; choose another --output", o->input);
  free(output);
  return NULL;
}

bool gg_cli_file_exists(const char *path)
{
  struct stat about;
  return stat(path, &about) == 0;
}

bool gg_cli_file_is_device(const char *path)
{
  struct stat about;
  return stat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}

void gg_cli_report_written(const gg_options *o, const char *what, const char *path, bool replaced)
{
  fflush(stdout);
  if (!o->quiet) fprintf(stderr, "%s: %s%s\n", what, path, replaced ? " (in place of an older one)" : "");
}
