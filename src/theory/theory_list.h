/* The theories by name: one a file. */
#ifndef GG_THEORY_LIST_H
#define GG_THEORY_LIST_H

#include "theory/theory.h"

extern const gg_theory gg_lun1991;
extern const gg_theory gg_lun1991_lun_savage;
extern const gg_theory gg_enskog_hermite;
extern const gg_theory gg_gaussian_closure;
extern const gg_theory gg_grad;
extern const gg_theory gg_sela_goldhirsch1998;
extern const gg_theory gg_huthmann_zippelius1997;
extern const gg_theory gg_haff1983;
extern const gg_theory gg_goldhirsch_zanetti1993;
extern const gg_theory gg_garzo_dufty1999;
extern const gg_theory gg_montanero_santos2000;
extern const gg_theory gg_garzo_santos_montanero2007;
extern const gg_theory gg_garzo_montanero2003;
extern const gg_theory gg_garzo_montanero2003_ms;
extern const gg_theory gg_enskog;
extern const gg_theory gg_carnahan_starling1969;
extern const gg_theory gg_kolafa2004;
extern const gg_theory gg_pieprzyk2019;

#endif
