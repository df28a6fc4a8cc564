/* GSL ends the program on errors, out of memory among them, unless its handler says otherwise. From the first thread
 * that enters until the last one leaves errors are returned, and lack of memory is noted (memory.h); then the
 * handler is again what the calling program has set. */
#ifndef GG_GSL_QUIET_H
#define GG_GSL_QUIET_H

void gg_base_gsl_enter(void);
void gg_base_gsl_leave(void);

#endif
