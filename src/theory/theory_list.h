/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of all theories, in the order of tables. Each is a constant gg_<name>, alone in a file or with its
 * variants, that describes itself there; all code that lists or names theories reads these constants. */
#ifndef GG_THEORY_LIST_H
#define GG_THEORY_LIST_H

#include "theory/theory.h"

#define GG_THEORIES(X)                                                                                                 \
  X(lun1991)                                                                                                           \
  X(lun1991_lun_savage)                                                                                                \
  X(enskog_hermite)                                                                                                    \
  X(gaussian_closure)                                                                                                  \
  X(saha_alam2016)                                                                                                     \
  X(jenkins_zhang2002)                                                                                                 \
  X(vescovi2014)                                                                                                       \
  X(chialvo_sundaresan2013)                                                                                            \
  X(grad)                                                                                                              \
  X(sela_goldhirsch1998)                                                                                               \
  X(huthmann_zippelius1997)                                                                                            \
  X(kremer_santos_garzo2014)                                                                                           \
  X(haff1983)                                                                                                          \
  X(goldhirsch_zanetti1993)                                                                                            \
  X(garzo_dufty1999)                                                                                                   \
  X(montanero_santos2000)                                                                                              \
  X(garzo_santos_montanero2007)                                                                                        \
  X(chamorro_vega_garzo2013)                                                                                           \
  X(garzo_montanero2003)                                                                                               \
  X(garzo_montanero2003_ms)                                                                                            \
  X(garzo_dufty2002)                                                                                                   \
  X(garzo_dufty_hrenya2007)                                                                                            \
  X(enskog)                                                                                                            \
  X(navier_stokes)                                                                                                     \
  X(navier_stokes_hermite)                                                                                             \
  X(moments)                                                                                                           \
  X(carnahan_starling1969)                                                                                             \
  X(kolafa2004)                                                                                                        \
  X(pieprzyk2019)

#define GG_THEORY_CONSTANT(name) extern const gg_theory gg_theory_##name;
GG_THEORIES(GG_THEORY_CONSTANT)
#undef GG_THEORY_CONSTANT

#define GG_THEORY_COUNT(name) +1
enum { GG_N_THEORIES = 0 GG_THEORIES(GG_THEORY_COUNT) };
#undef GG_THEORY_COUNT

/* Seconds of processor time for all theories of a model, right within a factor of three; longest where the program was
 * built without the machine's own instructions. */
double gg_theory_seconds(const gg_model *model);

#endif
