/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourier modes of fields carried by grains, F(k) = sum_i f_i exp(-i k.r_i), on a mesh laid along the edges of the
 * sheared box, (L_x,0,0), (D,L_y,0), (0,0,L_z): its wave vectors are exactly those of the sheared periodicity. Grains
 * are assigned by cubic splines; modes up to half the mesh's limit are given, where after division by the spline's own
 * transform the error is below a thousandth (Hockney & Eastwood, Computer Simulation Using Particles, 1988). */
#ifndef GG_MESH_H
#define GG_MESH_H

#include <fftw3.h>

#include "measure/pairs.h"

typedef struct gg_mesh {
  int n; /* along each edge, even */
  double *field;
  fftw_complex *modes;
  fftw_plan plan;
} gg_mesh;

/* Number of points along each edge for a model; and the largest number for each grain at which a transform is made
 * in every 32nd sample. */
enum { GG_MESH_POINTS_PER_GRAIN = 480 };
int gg_measure_mesh_points_along(const gg_model *model);
gg_status gg_measure_mesh_init(gg_mesh *m, int n, gg_error *err);
void gg_measure_mesh_clear(gg_mesh *m);

/* Transform f (1 for every grain if NULL). */
void gg_measure_mesh_transform(gg_mesh *m, const gg_snapshot *s, const gg_images *box, const double *f);

/* F of the mode (nx, ny, nz), |n_a| <= n/4, nx >= 0, by reference to `modes` of the same size. */
typedef struct gg_mode {
  double re, im;
} gg_mode;
gg_mode gg_measure_mesh_mode(const gg_mesh *m, int nx, int ny, int nz);

/* Wave vector of the mode. */
gg_vec gg_measure_mesh_wave_vector(const gg_images *box, int nx, int ny, int nz);

#endif
