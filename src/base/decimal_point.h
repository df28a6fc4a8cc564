/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers have a decimal point in every text that the library reads or writes, whatever locale the calling program has
 * chosen, and on every thread. meson.build includes this before the first line of each file of the library: these calls
 * of the C library then run in the C locale, and none can be forgotten. They call nobody else, so callbacks keep the
 * locale of the program. JSON: io/checked_json.h. */
#ifndef GG_DECIMAL_POINT_H
#define GG_DECIMAL_POINT_H

#include <locale.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

/* A declaration: the rest of the block runs in the C locale, on this thread. For calls of other libraries that read or
 * write numbers; those below have it already. No callback may be called there. */
#define GG_C_LOCALE                                                                                                    \
  __attribute__((cleanup(gg_base_c_locale_leave), unused)) const locale_t locale_before = gg_base_c_locale_enter()
locale_t gg_base_c_locale_enter(void);
void gg_base_c_locale_leave(const locale_t *before);

#define GG_FORMATS(of, first) __attribute__((format(printf, of, first)))
int gg_base_snprintf(char *text, size_t size, const char *format, ...) GG_FORMATS(3, 4);
int gg_base_vsnprintf(char *text, size_t size, const char *format, va_list args) GG_FORMATS(3, 0);
int gg_base_fprintf(FILE *out, const char *format, ...) GG_FORMATS(2, 3);
int gg_base_vfprintf(FILE *out, const char *format, va_list args) GG_FORMATS(2, 0);
int gg_base_asprintf(char **text, const char *format, ...) GG_FORMATS(2, 3);
int gg_base_vasprintf(char **text, const char *format, va_list args) GG_FORMATS(2, 0);
int gg_base_sscanf(const char *text, const char *format, ...) __attribute__((format(scanf, 2, 3)));
double gg_base_strtod(const char *text, char **end);

#undef snprintf /* glibc has macros of these where the compiler is clang and _FORTIFY_SOURCE is set */
#undef fprintf
#undef asprintf
#define snprintf gg_base_snprintf
#define vsnprintf gg_base_vsnprintf
#define fprintf gg_base_fprintf
#define vfprintf gg_base_vfprintf
#define asprintf gg_base_asprintf
#define vasprintf gg_base_vasprintf
#define sscanf gg_base_sscanf
#define strtod gg_base_strtod

#endif
