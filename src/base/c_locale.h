/* Numbers are read and written with a decimal point whatever locale the calling program has chosen. */
#ifndef GG_C_LOCALE_H
#define GG_C_LOCALE_H

#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

/* Switch this thread to the C locale; hand the returned value to gg_base_c_locale_leave. */
locale_t gg_base_c_locale_enter(void);
void gg_base_c_locale_leave(locale_t before);

/* A declaration: the rest of the block runs in the C locale. */
#define GG_C_LOCALE __attribute__((cleanup(gg_base_locale_leave))) locale_t locale_before = gg_base_c_locale_enter()
static inline void gg_base_locale_leave(locale_t *before)
{
  gg_base_c_locale_leave(*before);
}

#endif
