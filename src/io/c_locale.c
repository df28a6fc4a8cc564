#include "io/c_locale.h"

locale_t gg_c_locale_enter(void)
{
  locale_t c = newlocale(LC_NUMERIC_MASK, "C", duplocale(uselocale((locale_t)0)));
  return c ? uselocale(c) : (locale_t)0;
}

void gg_c_locale_leave(locale_t before)
{
  if (!before) return;
  locale_t c = uselocale(before);
  if (c != LC_GLOBAL_LOCALE) freelocale(c);
}
