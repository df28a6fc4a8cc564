/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stored.h"

#include <stdio.h>
#include <stdlib.h>

static FILE *open_one(const char *folder, const char *name, const char *end, const char *mode)
{
  char path[600];
  snprintf(path, sizeof path, "%.400s/%.100s.%s", folder, name, end);
  FILE *f = fopen(path, mode);
  if (!f) perror(path);
  return f;
}

bool stored_write(const char *folder, const char *name, const double *y, size_t n, double time, double truth)
{
  FILE *numbers = open_one(folder, name, "f64", "wb"), *about = open_one(folder, name, "txt", "w");
  bool good = numbers && about && fwrite(y, sizeof *y, n, numbers) == n;
  if (about) good &= fprintf(about, "%zu %.6g %.12g\n", n, time, truth) > 0 && fclose(about) == 0;
  if (numbers) good &= fclose(numbers) == 0;
  if (!good) fprintf(stderr, "%s/%s could not be written\n", folder, name);
  return good;
}

bool stored_read(const char *folder, const char *name, stored *s)
{
  FILE *numbers = open_one(folder, name, "f64", "rb"), *about = open_one(folder, name, "txt", "r");
  *s = (stored){0};
  bool good = numbers && about && fscanf(about, "%zu %lf %lf", &s->n, &s->time, &s->truth) == 3;
  if (good) s->y = malloc(s->n * sizeof *s->y);
  good = good && s->y && fread(s->y, sizeof *s->y, s->n, numbers) == s->n;
  if (about) fclose(about);
  if (numbers) fclose(numbers);
  if (!good) fprintf(stderr, "%s/%s could not be read\n", folder, name);
  return good;
}
