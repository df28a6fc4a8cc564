#ifndef GG_ROOT_H
#define GG_ROOT_H

/* Root of f between low and high, where f changes sign, to rounding; NaN if it cannot be had. */
double gg_theory_root_between(double (*f)(double x, void *params), void *params, double low, double high);

#endif
