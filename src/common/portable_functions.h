/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions from sums, products, quotients and square roots alone, which every processor rounds alike: the
 * same bits from every C library. Relative errors are a few 10^-16, of powers that times |b ln a|. */
#ifndef GG_PORTABLE_FUNCTIONS_H
#define GG_PORTABLE_FUNCTIONS_H

double gg_common_portable_exp(double x);
double gg_common_portable_ln(double x);
double gg_common_portable_log10(double x);
double gg_common_portable_pow(double a, double b);
double gg_common_portable_sin(double x);
double gg_common_portable_cos(double x);
double gg_common_portable_atan(double x);
double gg_common_portable_tanh(double x);
double gg_common_portable_erf(double x);

#endif
