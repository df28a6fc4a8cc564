/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog's equation in steady uniform shear over phi and e, without random numbers: T, P_xy, N1 and N2 of smooth
 * grains, each with its numerical error (theory enskog_hermite). shear_table [--phi N] [--e N] FILE.csv FILE.h5 writes
 * the whole table, some minutes, or its first N rows and columns. Exit code 0; 1 where a state does not converge, 2
 * where the command line is wrong, 3 where a file cannot be written. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/h5/hdf5_writer.h"
#include "scene/model_of_scene.h"
#include "theory/theory_list.h"

enum { MOST_PHI = 28, MOST_E = 36, QUANTITIES = 4 };

static const double phis[MOST_PHI] = {0,    0.0025, 0.005, 0.01,  0.02, 0.03,  0.04, 0.05,  0.06, 0.075,
                                      0.1,  0.125,  0.15,  0.175, 0.2,  0.225, 0.25, 0.275, 0.3,  0.325,
                                      0.35, 0.375,  0.4,   0.425, 0.45, 0.475, 0.49, 0.5};
static const gg_quantity quantities[QUANTITIES] = {GG_Q_TEMPERATURE, GG_Q_P_XY, GG_Q_N1, GG_Q_N2};

typedef struct table {
  int n_phi, n_e;
  double e[MOST_E], value[QUANTITIES][MOST_PHI][MOST_E], error[QUANTITIES][MOST_PHI][MOST_E];
} table;

static gg_model model_at(double phi, double e)
{
  gg_scene s = gg_scene_defaults();
  gg_model m;
  gg_error err;
  s.flow = GG_USF, s.phi = phi;
  s.collision.e[0] = e, s.collision.beta[0] = -1;
  if (gg_scene_model_make(&s, GG_DSMC, &m, &err) == GG_OK) return m;
  fprintf(stderr, "%s\n", err.message);
  exit(1);
}

static bool fill(table *t)
{
  for (int phi = 0; phi < t->n_phi; phi++)
    for (int e = 0; e < t->n_e; e++) {
      gg_model m = model_at(phis[phi], t->e[e]);
      gg_theory_answer a;
      gg_error err;
      if (gg_theory_evaluate(&gg_theory_enskog_hermite, &m, &a, &err) != GG_OK) {
        fprintf(stderr, "phi %g e %g: %s\n", phis[phi], t->e[e], err.message);
        return false;
      }
      for (int q = 0; q < QUANTITIES; q++) {
        t->value[q][phi][e] = a.value[quantities[q]];
        t->error[q][phi][e] = a.error[quantities[q]];
      }
    }
  return true;
}

static bool write_csv(const table *t, const char *path)
{
  FILE *f = fopen(path, "w");
  if (!f) return false;
  fprintf(f, "phi,e");
  for (int q = 0; q < QUANTITIES; q++)
    fprintf(f, ",%s,%s_error", gg_common_quantity_name(quantities[q]), gg_common_quantity_name(quantities[q]));
  for (int p = 0; p < t->n_phi; p++)
    for (int e = 0; e < t->n_e; e++) {
      fprintf(f, "\n%g,%g", phis[p], t->e[e]);
      for (int q = 0; q < QUANTITIES; q++) fprintf(f, ",%.7g,%.1e", t->value[q][p][e], t->error[q][p][e]);
    }
  fprintf(f, "\n");
  return fclose(f) == 0;
}

static void put(gg_h5 *h, const char *path, const table *t, const double of[MOST_PHI][MOST_E], const char *unit)
{
  static double rows[MOST_PHI * MOST_E];
  hsize_t dims[2] = {(hsize_t)t->n_phi, (hsize_t)t->n_e};
  for (int p = 0; p < t->n_phi; p++) memcpy(rows + p * t->n_e, of[p], (size_t)t->n_e * sizeof *rows);
  gg_h5_array(h, path, H5T_NATIVE_DOUBLE, 2, dims, rows);
  gg_h5_text_attribute(h, path, "unit", unit);
}

static bool write_h5(const table *t, const char *path)
{
  static const char *const units[QUANTITIES] = {"d^2 gamma^2; phi = 0: (gamma/(n d^2))^2",
                                                "rho_p d^2 gamma^2; phi = 0: n m (gamma/(n d^2))^2", "1", "1"};
  gg_h5 h;
  gg_error err;
  hsize_t n_phi = (hsize_t)t->n_phi, n_e = (hsize_t)t->n_e;
  gg_h5_create(&h, path);
  gg_h5_array(&h, "/phi", H5T_NATIVE_DOUBLE, 1, &n_phi, phis);
  gg_h5_array(&h, "/e", H5T_NATIVE_DOUBLE, 1, &n_e, t->e);
  for (int q = 0; q < QUANTITIES; q++) {
    char name[32];
    snprintf(name, sizeof name, "/%s", gg_common_quantity_name(quantities[q]));
    put(&h, name, t, t->value[q], units[q]);
    snprintf(name, sizeof name, "/%s_error", gg_common_quantity_name(quantities[q]));
    put(&h, name, t, t->error[q], units[q]);
  }
  gg_h5_close(&h);
  return gg_h5_status(&h, path, "write", &err) == GG_OK;
}

int main(int argc, char **argv)
{
  static table t = {.n_phi = MOST_PHI, .n_e = MOST_E};
  int at = 1;
  for (; at + 1 < argc && strncmp(argv[at], "--", 2) == 0; at += 2) {
    int n = atoi(argv[at + 1]);
    if (n < 1) break;
    if (strcmp(argv[at], "--phi") == 0 && n < MOST_PHI) t.n_phi = n;
    if (strcmp(argv[at], "--e") == 0 && n < MOST_E) t.n_e = n;
  }
  if (argc - at != 2) {
    fprintf(stderr, "shear_table [--phi N] [--e N] FILE.csv FILE.h5\n");
    return 2;
  }
  for (int e = 0; e < t.n_e; e++) t.e[e] = e == 0 ? 0.99 : (100 - 2 * e) / 100.;
  if (!fill(&t)) return 1;
  if (write_csv(&t, argv[at]) && write_h5(&t, argv[at + 1])) return 0;
  fprintf(stderr, "a table could not be written\n");
  return 3;
}
