/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The C side of graingas._c: functions that run without Python's lock. Comments that begin with `cffi:` are
 * declarations for binding.py. */
#include <stdlib.h>
#include <string.h>

#include "graingas.h"

/* cffi:
typedef struct ggpy_call { int stop; void *self; } ggpy_call;
int ggpy_stop(void *context);
extern "Python" int ggpy_progress(void *context, const gg_progress *progress);
extern "Python" void ggpy_warn(void *context, const char *message);
extern "Python" void ggpy_line(void *context, const char *text);
extern "Python" void ggpy_sweep_progress(void *context, const gg_sweep_progress *progress);
extern "Python" void ggpy_sweep_ended(void *context, size_t i, gg_status status, const char *file, const char *message);
*/

/* One call into the library, the context of its callbacks. */
typedef struct ggpy_call {
  int stop;   /* not 0: the call ends soon */
  void *self; /* the object of Python */
} ggpy_call;

static int ggpy_stop(void *context)
{
  return __atomic_load_n(&((ggpy_call *)context)->stop, __ATOMIC_RELAXED);
}

/* cffi:
typedef struct ggpy_watch { int watching; void *self; size_t n; gg_collision_event *events; int lost; ...; } ggpy_watch;
void ggpy_show(void *context, const gg_collision_event *event);
void ggpy_record(void *context, const gg_collision_event *event);
void ggpy_forget(ggpy_watch *watch);
extern "Python" void ggpy_collision(void *context, const gg_collision_event *event);
*/

/* Receiver of the collisions of a simulation: a function of Python, or a buffer that grows. */
typedef struct ggpy_watch {
  int watching;
  void *self;
  size_t n, capacity;
  gg_collision_event *events; /* from malloc */
  int lost;                   /* there was no memory for all */
} ggpy_watch;

static void ggpy_collision(void *context, const gg_collision_event *event);

/* A receiver that is switched off costs no more than this test. */
static void ggpy_show(void *context, const gg_collision_event *event)
{
  if (((ggpy_watch *)context)->watching) ggpy_collision(((ggpy_watch *)context)->self, event);
}

static void ggpy_forget(ggpy_watch *watch)
{
  free(watch->events);
  watch->events = NULL;
  watch->n = watch->capacity = 0;
  watch->lost = 0;
}

static void ggpy_record(void *context, const gg_collision_event *event)
{
  ggpy_watch *watch = context;
  if (watch->n == watch->capacity) {
    size_t more = watch->capacity ? 2 * watch->capacity : 1024;
    void *grown = realloc(watch->events, more * sizeof *event);
    watch->lost |= !grown;
    if (!grown) return;
    watch->events = grown;
    watch->capacity = more;
  }
  watch->events[watch->n++] = *event;
}

/* cffi:
const double *ggpy_sample_position(const gg_sample *sample);
const double *ggpy_sample_velocity(const gg_sample *sample);
const double *ggpy_sample_spin(const gg_sample *sample);
extern "Python" void ggpy_sample(void *context, void *state, const gg_sample *sample, double *values);
extern "Python" void ggpy_view(void *context, void *state, const gg_collision_view *collision);
extern "Python" const char *ggpy_evaluate(void *context, const gg_facts *facts, double *values);
extern "Python" double ggpy_law(void *context, double normal_speed, int species_1, int species_2);
*/

static const double *ggpy_sample_position(const gg_sample *sample)
{
  return (const double *)sample->position;
}

static const double *ggpy_sample_velocity(const gg_sample *sample)
{
  return (const double *)sample->velocity;
}

static const double *ggpy_sample_spin(const gg_sample *sample)
{
  return (const double *)sample->spin;
}

/* cffi: void free(void *block); */
