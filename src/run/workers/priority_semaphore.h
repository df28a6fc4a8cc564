/* So many jobs at a time; of those that wait, the most urgent goes next. */
#ifndef GG_GATE_H
#define GG_GATE_H

#include <pthread.h>

typedef struct gg_gate {
  pthread_mutex_t lock;
  int free; /* processors */
  struct gg_waiting *first;
} gg_gate;

void gg_run_gate_init(gg_gate *gate, int processors);
void gg_run_gate_clear(gg_gate *gate);
void gg_run_gate_enter(gg_gate *gate, double urgency);
void gg_run_gate_leave(gg_gate *gate);

#endif
