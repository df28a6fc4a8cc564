/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/rough_pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "theory/hermite/overlap.h"

enum { N1 = GG_ROUGH_MOST_DEGREE + 1 };

/* Ho_n(x1) Ho_m(x2) = sum_k half[n][m][k] Ho_k(y) Ho_(n+m-k)(z),   y = (x1 - x2)/sqrt 2, z = (x1 + x2)/sqrt 2: in
 * creation operators (z + y)^n (z - y)^m. */
typedef struct gg_halves {
  double of[N1][N1][2 * N1];
} gg_halves;

static double factorial(int n)
{
  return tgamma(n + 1.);
}

static double binomial(int n, int k)
{
  return k < 0 || k > n ? 0 : factorial(n) / (factorial(k) * factorial(n - k));
}

static void make_halves(gg_halves *h, int degree)
{
  for (int n = 0; n <= degree; n++)
    for (int m = 0; n + m <= degree; m++)
      for (int k = 0; k <= n + m; k++) {
        double sum = 0;
        for (int j = 0; j <= k; j++) sum += binomial(n, k - j) * binomial(m, j) * (j % 2 ? -1 : 1);
        h->of[n][m][k] =
            sum * sqrt(factorial(k) * factorial(n + m - k) / (factorial(n) * factorial(m))) * pow(0.5, (n + m) / 2.);
      }
}

/* The relative part of velocities is the difference, that of spins the sum. */
static double share(const gg_halves *h, int axis, int one, int two, int relative)
{
  return h->of[one][two][axis < 3 ? relative : one + two - relative];
}

/* Tests whose part in (v, m), which collisions do not change, is V: r with its relative part R = r - V. */
typedef struct gg_cover {
  int r, R;
  double amount;
} gg_cover;

typedef struct gg_covers {
  int *from;
  gg_cover *cover;
} gg_covers;

static bool cover(const gg_rough_form *form, const gg_rough_functions *f, const gg_halves *h, int r, int V,
                  gg_cover *out)
{
  gg_rough_index rest;
  const int *test = f->function[form->test[r]].r, *left = f->function[V].r;
  double amount = 1;
  for (int x = 0; x < GG_ROUGH_AXES; x++) {
    rest.r[x] = test[x] - left[x];
    if (rest.r[x] < 0) return false;
    amount *= share(h, x, test[x], 0, rest.r[x]);
  }
  *out = (gg_cover){r, gg_rough_place(f, rest.r), amount};
  return out->R > 0; /* the constant is no test */
}

static bool make_covers(gg_covers *c, const gg_rough_form *form, const gg_rough_functions *f, const gg_halves *h)
{
  int n = 0;
  gg_cover one;
  c->from = malloc((size_t)(f->n + 1) * sizeof *c->from);
  if (!c->from) return false;
  for (int V = 0; V < f->n; V++)
    for (int r = 0; r < form->n_tests; r++) n += cover(form, f, h, r, V, &one);
  c->cover = malloc((size_t)n * sizeof *c->cover);
  n = 0;
  for (int V = 0; V < f->n && c->cover; V++) {
    c->from[V] = n;
    for (int r = 0; r < form->n_tests; r++)
      if (cover(form, f, h, r, V, &one)) c->cover[n++] = one;
  }
  c->from[f->n] = n;
  return c->cover != NULL;
}

typedef struct gg_spread {
  const gg_rough_form *form;
  const gg_rough_relative *relative;
  const gg_halves *halves;
  const gg_covers *covers;
  double *row; /* of B */
} gg_spread;

/* All entries of B from one term Ho_S(d, p) Ho_V(v, m). */
static void add_term(const gg_spread *s, int S, int V, double amount)
{
  const gg_rough_relative *relative = s->relative;
  for (int c = s->covers->from[V]; c < s->covers->from[V + 1]; c++) {
    const gg_cover *test = s->covers->cover + c;
    s->row[test->r] += amount * test->amount * gg_rough_relative_at(relative, test->R, S);
  }
}

/* Expand a product Ho_one(1) Ho_two(2), axis by axis, in terms Ho_S Ho_V. */
static void spread(const gg_spread *s, const int *one, const int *two, int axis, gg_rough_index S, gg_rough_index V,
                   double amount)
{
  const gg_rough_functions *f = &s->relative->f;
  if (axis == GG_ROUGH_AXES) {
    add_term(s, gg_rough_place(f, S.r), gg_rough_place(f, V.r), amount);
    return;
  }
  for (int k = 0; k <= one[axis] + two[axis]; k++) {
    double part = share(s->halves, axis, one[axis], two[axis], k);
    if (part == 0) continue;
    S.r[axis] = k, V.r[axis] = one[axis] + two[axis] - k;
    spread(s, one, two, axis + 1, S, V, amount * part);
  }
}

static void add_product(const gg_spread *s, int one, int two)
{
  const gg_rough_functions *f = &s->relative->f;
  spread(s, f->function[s->form->function[one]].r, f->function[s->form->function[two]].r, 0, (gg_rough_index){{0}},
         (gg_rough_index){{0}}, 1);
}

static int degree_of(const gg_rough_form *form, const gg_rough_functions *f, int q)
{
  return gg_rough_degree(f->function[form->function[q]]);
}

/* True if a function is even by the parities of a shear flow, in an isotropic state also under reflection of any axis.
 */
static bool belongs(gg_rough_index index, bool isotropic)
{
  if (gg_rough_class(index) != 0) return false;
  for (int x = 0; x < 3 && isotropic; x++)
    if ((index.r[x] + index.r[x + 3]) % 2) return false;
  return true;
}

static gg_status list(gg_rough_form *form, const gg_rough_functions *f, int degree, bool isotropic, gg_error *err)
{
  form->function = malloc((size_t)f->n * sizeof *form->function);
  form->unknown = malloc((size_t)f->n * sizeof *form->unknown);
  form->test = malloc((size_t)f->n * sizeof *form->test);
  if (!form->function || !form->unknown || !form->test) return gg_base_out_of_memory(err);
  for (int q = 0; q < f->n; q++) {
    bool test = belongs(f->function[q], isotropic), kept = test && gg_rough_degree(f->function[q]) <= degree;
    if (test) form->test[form->n_tests++] = q;
    form->unknown[q] = kept ? form->n : -1;
    if (kept) form->function[form->n++] = q;
  }
  for (int pass = 0; pass < 2; pass++) {
    int n = 0;
    for (int one = 0; one < form->n; one++)
      for (int two = one; two < form->n; two++) {
        if (degree_of(form, f, one) + degree_of(form, f, two) > f->degree) continue;
        if (pass) form->pair[n] = (gg_rough_pair){one, two};
        n++;
      }
    if (pass == 0) form->pair = malloc((size_t)n * sizeof *form->pair);
    if (!form->pair) return gg_base_out_of_memory(err);
    form->n_pairs = n;
  }
  form->B = calloc((size_t)form->n_pairs * (size_t)form->n, sizeof *form->B);
  return form->B ? GG_OK : gg_base_out_of_memory(err);
}

/* <psi_m Ho_q> of one axis, for velocities and for spins. */
static gg_status make_overlaps(int side, const gg_rough_choice *choice, double *overlap, gg_error *err)
{
  for (int k = 0; k < 2; k++) {
    gg_hermite_overlap o;
    gg_status status = gg_hermite_overlap_make(&o, side, side, k ? choice->spin_decay : choice->decay, err);
    if (status == GG_OK) gg_hermite_overlap_at(&o, 0, overlap + k * side * side);
    gg_hermite_overlap_clear(&o);
    GG_TRY(status);
  }
  return GG_OK;
}

static double part_of(const int *test, const int *part, bool decays, int side, const double *overlap)
{
  double product = 1;
  for (int x = 0; x < GG_ROUGH_AXES; x++) {
    const double *matrix = overlap + (x < 3 ? 0 : side * side);
    if ((test[x] - part[x]) % 2) return 0;
    product *= decays ? matrix[test[x] * side + part[x]] : test[x] == part[x];
  }
  return product;
}

static int find_parts(gg_rough_form *form, const gg_rough_functions *f, int side, const double *overlap, bool store)
{
  int n = 0;
  for (int r = 0; r < form->n; r++) {
    bool decays = degree_of(form, f, r) > 2;
    form->from[r] = n;
    for (int q = 0; q < form->n_tests; q++) {
      double amount = part_of(f->function[form->function[r]].r, f->function[form->test[q]].r, decays, side, overlap);
      if (amount == 0) continue;
      if (store) form->part[n] = (gg_rough_part){q, amount};
      n++;
    }
  }
  form->from[form->n] = n;
  return n;
}

static gg_status make_tests(gg_rough_form *form, const gg_rough_functions *f, const gg_rough_choice *choice,
                            gg_error *err)
{
  int side = f->degree + 1;
  double *overlap = malloc((size_t)(2 * side * side) * sizeof *overlap);
  form->from = malloc((size_t)(form->n + 1) * sizeof *form->from);
  gg_status status = form->from && overlap ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) status = make_overlaps(side, choice, overlap, err);
  if (status == GG_OK) {
    form->part = malloc((size_t)find_parts(form, f, side, overlap, false) * sizeof *form->part);
    if (form->part)
      find_parts(form, f, side, overlap, true);
    else
      status = gg_base_out_of_memory(err);
  }
  free(overlap);
  return status;
}

void gg_rough_test(const gg_rough_form *form, const double *all, double *tested)
{
  for (int r = 0; r < form->n; r++) {
    double sum = tested[r];
    for (int p = form->from[r]; p < form->from[r + 1]; p++) sum += form->part[p].amount * all[form->part[p].test];
    tested[r] = sum;
  }
}

static gg_status make_form(gg_rough_form *form, const gg_rough_relative *relative, gg_error *err)
{
  gg_halves halves;
  gg_covers covers = {0};
  make_halves(&halves, relative->f.degree);
  gg_spread s = {form, relative, &halves, &covers, malloc((size_t)form->n_tests * sizeof(double))};
  const bool fine = s.row && make_covers(&covers, form, &relative->f, &halves);
  gg_status status = fine ? GG_OK : gg_base_out_of_memory(err);
  for (int p = 0; p < form->n_pairs && status == GG_OK; p++) {
    gg_rough_pair pair = form->pair[p];
    memset(s.row, 0, (size_t)form->n_tests * sizeof *s.row);
    add_product(&s, pair.one, pair.two);
    if (pair.one != pair.two) add_product(&s, pair.two, pair.one);
    gg_rough_test(form, s.row, form->B + (size_t)p * (size_t)form->n);
    status = gg_stop_check(relative->stop, err);
  }
  free(s.row);
  free(covers.from);
  free(covers.cover);
  return status;
}

gg_status gg_rough_form_make(gg_rough_form *form, const gg_rough_relative *relative, int degree, bool isotropic,
                             const gg_rough_choice *choice, gg_error *err)
{
  *form = (gg_rough_form){0};
  gg_status status = list(form, &relative->f, degree, isotropic, err);
  if (status == GG_OK) status = make_tests(form, &relative->f, choice, err);
  if (status == GG_OK) status = make_form(form, relative, err);
  if (status != GG_OK) gg_rough_form_clear(form);
  return status;
}

void gg_rough_form_clear(gg_rough_form *form)
{
  free(form->function);
  free(form->unknown);
  free(form->test);
  free(form->from);
  free(form->part);
  free(form->pair);
  free(form->B);
  *form = (gg_rough_form){0};
}

void gg_rough_form_add(const gg_rough_form *form, double factor, const double *a, double *R, double *jacobian)
{
  for (int p = 0; p < form->n_pairs; p++) {
    int one = form->pair[p].one, two = form->pair[p].two;
    const double *B = form->B + (size_t)p * (size_t)form->n;
    double both = factor * a[one] * a[two];
    for (int r = 0; r < form->n; r++) R[r] += both * B[r];
    if (!jacobian) continue;
    for (int r = 0; r < form->n; r++) {
      double *row = jacobian + (size_t)r * (size_t)form->n;
      row[one] += factor * a[two] * B[r];
      row[two] += factor * a[one] * B[r];
    }
  }
}

/* < Ho_S(d, p) > of a pair of functions: products without a part in (v, m). */
static double whole(const gg_halves *h, const int *one, const int *two, gg_rough_index *S)
{
  double amount = 1;
  for (int x = 0; x < GG_ROUGH_AXES; x++) {
    S->r[x] = one[x] + two[x];
    amount *= share(h, x, one[x], two[x], S->r[x]);
  }
  return amount;
}

double gg_rough_pair_mean(const gg_rough_form *form, const gg_rough_relative *relative, const double *functional,
                          const double *a)
{
  const gg_rough_functions *f = &relative->f;
  gg_halves halves;
  double sum = 0;
  make_halves(&halves, f->degree);
  for (int p = 0; p < form->n_pairs; p++) {
    int one = form->pair[p].one, two = form->pair[p].two;
    const int *r = f->function[form->function[one]].r, *q = f->function[form->function[two]].r;
    gg_rough_index S;
    double amount = whole(&halves, r, q, &S), other = whole(&halves, q, r, &S);
    if (one != two) amount += other;
    sum += amount * a[one] * a[two] * functional[gg_rough_place(f, S.r)];
  }
  return sum;
}
