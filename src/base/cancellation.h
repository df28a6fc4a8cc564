/* A word to those who do long work: look here now and then, and end early if you are asked to. Engines look several
 * times a second, at their start too. */
#ifndef GG_STOP_H
#define GG_STOP_H

#include <stdbool.h>
#include <stddef.h>

typedef struct gg_stop {
  bool (*asked)(void *context); /* from any thread that works */
  void *context;
} gg_stop;

/* `stop` may be NULL: nobody will ask. */
static inline bool gg_stop_asked(const gg_stop *stop)
{
  return stop && stop->asked(stop->context);
}

#endif
