#include "theory/root.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

double gg_theory_root_between(double (*f)(double x, void *params), void *params, double low, double high)
{
  gsl_function function = {f, params};
  gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  double root = NAN;
  if (!solver) return root;
  int status = gsl_root_fsolver_set(solver, &function, low, high);
  for (int i = 0; i < 200 && status == GSL_SUCCESS; i++) {
    status = gsl_root_fsolver_iterate(solver);
    root = gsl_root_fsolver_root(solver);
    double a = gsl_root_fsolver_x_lower(solver), b = gsl_root_fsolver_x_upper(solver);
    if (gsl_root_test_interval(a, b, 0, 1e-14) == GSL_SUCCESS) break;
  }
  gsl_root_fsolver_free(solver);
  return root;
}
