#include "base/c_locale.h"

locale_t gg_base_c_locale_enter(void)
{
  locale_t copy = duplocale(uselocale((locale_t)0));
  locale_t c = copy ? newlocale(LC_NUMERIC_MASK, "C", copy) : (locale_t)0; /* which becomes the copy */
  if (!c && copy) freelocale(copy);
  if (!c) c = newlocale(LC_ALL_MASK, "C", (locale_t)0); /* takes no memory */
  return c ? uselocale(c) : (locale_t)0;
}

void gg_base_c_locale_leave(locale_t before)
{
  if (!before) return;
  locale_t c = uselocale(before);
  if (c != LC_GLOBAL_LOCALE) freelocale(c);
}
