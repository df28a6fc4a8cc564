/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Select the mutant of this process before main; write the mutants that it reached when it ends. */
#include <stdio.h>
#include <stdlib.h>

int gg_mutant_now;
unsigned char gg_mutant_reached[1024];

static void write_reached(void)
{
  const char *path = getenv("GG_MUTANT_REACHED");
  FILE *file = path ? fopen(path, "a") : NULL;
  if (!file) return;
  for (int i = 1; i < 1024; i++)
    if (gg_mutant_reached[i]) fprintf(file, "%d\n", i);
  fclose(file);
}

__attribute__((constructor)) static void choose(void)
{
  const char *word = getenv("GG_MUTANT");
  if (word) gg_mutant_now = atoi(word);
  atexit(write_reached);
}
