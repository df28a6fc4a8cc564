#include "cli/number_format.h"

#include <math.h>
#include <stdio.h>

void gg_cli_format_count(double count, char *text, size_t size)
{
  static const char *const prefixes[] = {"", " k", " M", " G", " T"};
  int k = 0;
  while (count >= 999.5 && k < 4) count /= 1000, k++;
  if (k == 0 && count == floor(count))
    snprintf(text, size, "%.0f", count);
  else
    snprintf(text, size, "%.3g%s", count, prefixes[k]);
}

void gg_cli_format_duration(double seconds, char *text, size_t size)
{
  long whole = lround(seconds);
  if (seconds < 0.0995)
    snprintf(text, size, "%.0f ms", 1000 * seconds);
  else if (seconds < 9.95)
    snprintf(text, size, "%.1f s", seconds);
  else if (whole < 60)
    snprintf(text, size, "%ld s", whole);
  else if (whole < 3600)
    snprintf(text, size, "%ld:%02ld min", whole / 60, whole % 60);
  else
    snprintf(text, size, "%ld:%02ld:%02ld h", whole / 3600, whole / 60 % 60, whole % 60);
}
