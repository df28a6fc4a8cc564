/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/decimal_point.h"

#include <pthread.h>

#undef vsnprintf
#undef vfprintf
#undef vasprintf
#undef strtod

/* One for the whole process: a constant of the C library, which takes no memory and is not freed. */
static locale_t c_locale;
static pthread_once_t made = PTHREAD_ONCE_INIT;

static void make_c_locale(void)
{
  c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

locale_t gg_base_c_locale_enter(void)
{
  pthread_once(&made, make_c_locale);
  return c_locale ? uselocale(c_locale) : (locale_t)0;
}

void gg_base_c_locale_leave(const locale_t *before)
{
  if (*before) uselocale(*before);
}

int gg_base_vsnprintf(char *text, size_t size, const char *format, va_list args)
{
  GG_C_LOCALE;
  return vsnprintf(text, size, format, args);
}

int gg_base_snprintf(char *text, size_t size, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  const int n = gg_base_vsnprintf(text, size, format, args);
  va_end(args);
  return n;
}

int gg_base_vfprintf(FILE *out, const char *format, va_list args)
{
  GG_C_LOCALE;
  return vfprintf(out, format, args);
}

int gg_base_fprintf(FILE *out, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  const int n = gg_base_vfprintf(out, format, args);
  va_end(args);
  return n;
}

int gg_base_vasprintf(char **text, const char *format, va_list args)
{
  GG_C_LOCALE;
  return vasprintf(text, format, args);
}

int gg_base_asprintf(char **text, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  const int n = gg_base_vasprintf(text, format, args);
  va_end(args);
  return n;
}

int gg_base_sscanf(const char *text, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  GG_C_LOCALE;
  const int n = vsscanf(text, format, args);
  va_end(args);
  return n;
}

double gg_base_strtod(const char *text, char **end)
{
  GG_C_LOCALE;
  return strtod(text, end);
}
