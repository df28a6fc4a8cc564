/* The values that a varied key takes, as they are written: a list, "first:last:step", or for random draws "low..high".
 */
#ifndef GG_SWEEP_VALUES_H
#define GG_SWEEP_VALUES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "common/rng.h"

typedef struct gg_values {
  size_t n, room, characters; /* characters of all of them */
  char **text;                /* YAML */
  bool range;                 /* not listed, but anything from low to high */
  double low, high;
} gg_values;

/* Of all values of a key together, and of all that are drawn. */
enum { GG_MOST_VALUE_CHARACTERS = 1 << 22, GG_MOST_DRAWN_CHARACTERS = 1 << 26 };

void gg_sweep_values_clear(gg_values *values);
/* One value, copied; GG_BAD_INPUT where there are more than a sweep can have, or longer ones than anybody writes. */
gg_status gg_sweep_values_add(gg_values *values, const char *text, gg_error *err);
/* What a plain word says: "0.5", "0.1:0.5:0.1", "0.3..1", or several with commas, as on the command line. Messages
 * begin with the key. */
gg_status gg_sweep_values_parse(gg_values *values, const char *key, const char *text, gg_error *err);
/* One of them, or a number of the range (whole, where the key takes whole numbers); to be freed, NULL: out of memory.
 */
char *gg_sweep_values_draw(const gg_values *values, const char *key, gg_rng *rng);

#endif
