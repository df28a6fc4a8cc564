/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/machine.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

void gg_base_machine_processor(char *text, size_t size)
{
  char line[256], model[200] = "unknown processor";
  FILE *in = fopen("/proc/cpuinfo", "r");
  while (in && fgets(line, sizeof line, in))
    if (sscanf(line, "model name : %199[^\n]", model) == 1) break;
  if (in) fclose(in);
  snprintf(text, size, "%s", model);
}

long gg_base_machine_cores(void)
{
  return sysconf(_SC_NPROCESSORS_ONLN);
}

void gg_base_machine_date(char *text, size_t size)
{
  time_t now = time(NULL);
  struct tm utc;
  strftime(text, size, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
}
