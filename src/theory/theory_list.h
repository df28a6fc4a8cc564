/* The theories by name: one a file. */
#ifndef GG_THEORY_LIST_H
#define GG_THEORY_LIST_H

#include "theory/theory.h"

extern const gg_theory gg_lun1991;
extern const gg_theory gg_sela_goldhirsch1998;
extern const gg_theory gg_enskog;
extern const gg_theory gg_gaussian_closure;

#endif
