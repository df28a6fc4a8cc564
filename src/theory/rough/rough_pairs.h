/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The collision operator as a quadratic form in the coefficients of f = weight x sum_q a_q Ho_q,
 *   d<psi_r>/dt = sum_pairs B_r(q,q') a_q a_q',   q <= q', a_0 = 1,
 * of degree N, from that of the relative motion, of degree N or more: products of a larger total degree are omitted
 * (about a Gaussian of the right second moments these have two coefficients of degree N/2 and more), and tests
 *   psi_r = Ho_r exp(-decay |c|^2/2 - spin_decay |o|^2/2)
 * are sums of polynomials up to that degree. Tests of degree 2 and less do not decay. */
#ifndef GG_ROUGH_PAIRS_H
#define GG_ROUGH_PAIRS_H

#include "theory/rough/relative.h"

typedef struct gg_rough_pair {
  int one, two; /* one <= two, indices among the unknowns */
} gg_rough_pair;

typedef struct gg_rough_part {
  int test;
  double amount;
} gg_rough_part;

typedef struct gg_rough_form {
  int n; /* number of functions that a shear flow (an isotropic state) can have, up to N; the first is the constant */
  int *function; /* their indices in `relative.f` */
  int *unknown;  /* the inverse map; -1: no unknown */
  int n_tests;   /* the same up to the degree of the relative motion */
  int *test;
  int *from; /* a test psi_r as a sum of these: its parts from[r] .. from[r + 1] */
  gg_rough_part *part;
  int n_pairs;
  gg_rough_pair *pair;
  double *B; /* n_pairs rows of n */
} gg_rough_form;

typedef struct gg_rough_choice {
  double width, spin_width; /* of the weight, over that of f */
  double decay, spin_decay; /* of tests */
  int extra;                /* degree of the relative motion, beyond N */
} gg_rough_choice;

gg_status gg_rough_form_make(gg_rough_form *form, const gg_rough_relative *relative, int degree, bool isotropic,
                             const gg_rough_choice *choice, gg_error *err);
void gg_rough_form_clear(gg_rough_form *form);

/* Sum up the tests psi_r from `all`. */
void gg_rough_test(const gg_rough_form *form, const double *all, double *tested);

/* R_r += factor x sum B_r a a, and its derivatives (n x n by rows) where `jacobian` is not NULL. */
void gg_rough_form_add(const gg_rough_form *form, double factor, const double *a, double *R, double *jacobian);

/* sum_S functional_S < Ho_S(d, p) > over pairs of grains: collisional transfer. */
double gg_rough_pair_mean(const gg_rough_form *form, const gg_rough_relative *relative, const double *functional,
                          const double *a);

#endif
