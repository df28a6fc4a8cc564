/* FFTW plans with one planner for the whole process: only execution is free of locks. */
#ifndef GG_PLANNER_H
#define GG_PLANNER_H

void gg_planner_lock(void);
void gg_planner_unlock(void);

#endif
