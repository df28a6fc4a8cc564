/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/local_frame.h"

#include <math.h>

#include "measure/gap_slabs.h"

/* A slab has at least so many grains on average, and is at least a diameter thick. */
enum { GRAINS_PER_SLAB = 10 };

static int slabs_of(const gg_model *model)
{
  double n = fmin(floor(model->box[1]), floor((double)model->n / GRAINS_PER_SLAB));
  return n < 1 ? 1 : n > GG_MAX_SLABS ? GG_MAX_SLABS : (int)n;
}

/* The slab at height y, and the height in it: from its middle, in its thickness. */
static int slab_at(double inverse_thickness, int n, double y, double *height)
{
  int k = (int)(y * inverse_thickness);
  k = k < 0 ? 0 : k >= n ? n - 1 : k;
  *height = y * inverse_thickness - k - 0.5;
  return k;
}

void gg_measure_slabs_init(gg_slabs *slabs, const gg_model *model)
{
  *slabs = (gg_slabs){.n = slabs_of(model)};
  slabs->inverse_thickness = (double)slabs->n / model->box[1];
  for (int i = 0; i < model->n_species; i++) slabs->radius[i] = model->diameter[i] / 2;
}

static void add_vector(double sum[3], double weight, gg_vec v)
{
  sum[0] += weight * v.x, sum[1] += weight * v.y, sum[2] += weight * v.z;
}

static void add_grain(gg_slabs *slabs, double y, gg_vec c, const gg_vec *spin, int species)
{
  double height;
  gg_slab *slab = &slabs->slab[slab_at(slabs->inverse_thickness, slabs->n, y, &height)];
  slab->grains++, slab->first += species == 0;
  slab->height += height, slab->height_square += height * height;
  add_vector(slab->velocity, 1, c);
  add_vector(slab->moment, height, c);
  slab->square += gg_dot(c, c);
  if (!spin) return;
  add_vector(slab->spin, 1 / slabs->radius[species], *spin);
  add_vector(slab->spin_moment, height / slabs->radius[species], *spin);
}

static gg_vec at(const double *const x[3], size_t i)
{
  return (gg_vec){x[0][i], x[1][i], x[2][i]};
}

static int species_of(const gg_chunk *chunk, size_t i)
{
  return chunk->species ? chunk->species[i] : 0;
}

static void add_chunk(void *context, const gg_chunk *chunk)
{
  for (size_t i = 0; i < chunk->n; i++) {
    gg_vec spin = chunk->s[0] ? at(chunk->s, i) : (gg_vec){0, 0, 0};
    add_grain(context, chunk->r[1][i], at(chunk->c, i), chunk->s[0] ? &spin : NULL, species_of(chunk, i));
  }
}

void gg_measure_slabs_take(gg_slabs *slabs, const gg_model *model, gg_engine *engine)
{
  gg_measure_slabs_init(slabs, model);
  engine->ops->snapshot(engine, true, add_chunk, slabs);
}

void gg_measure_slabs_of_snapshot(gg_slabs *slabs, const gg_snapshot *s)
{
  gg_chunk all = {.n = s->n, .species = s->species};
  for (int a = 0; a < 3; a++) all.r[a] = s->r[a], all.c[a] = s->c[a], all.s[a] = s->s[a];
  gg_measure_slabs_init(slabs, s->model);
  add_chunk(slabs, &all);
}

bool gg_measure_slabs_are_empty(const gg_slabs *slabs)
{
  double grains = 0;
  for (int k = 0; k < slabs->n; k++) grains += slabs->slab[k].grains;
  return grains == 0;
}

void gg_measure_slabs_add(gg_slabs *slabs, const gg_slabs *more)
{
  double *to = (double *)slabs->slab;
  const double *from = (const double *)more->slab;
  for (size_t i = 0; i < (size_t)slabs->n * sizeof(gg_slab) / sizeof(double); i++) to[i] += from[i];
}

/* Sum of squares of heights about their mean; 0 for too few grains for a line: then the line is their mean alone. */
static double spread_of(const gg_slab *slab)
{
  double spread = slab->grains > 0 ? slab->height_square - slab->height * slab->height / slab->grains : 0;
  return slab->grains < 3 || spread < 1e-6 * slab->grains ? 0 : spread;
}

static gg_line fit_line(const gg_slab *slab, const double sum[3], const double moment[3])
{
  gg_line line = {{0}, {0}};
  double spread = spread_of(slab);
  for (int a = 0; a < 3 && slab->grains > 0; a++) {
    line.mean[a] = sum[a] / slab->grains;
    if (spread > 0) line.slope[a] = (moment[a] - slab->height * line.mean[a]) / spread;
  }
  return line;
}

/* Number of grains minus the parameters of the fit. */
static double freedom_of(const gg_slab *slab)
{
  return slab->grains - (spread_of(slab) > 0 ? 2 : 1);
}

double gg_measure_slab_temperature(const gg_slab *slab)
{
  gg_line line = fit_line(slab, slab->velocity, slab->moment);
  double squares = slab->square, spread = spread_of(slab), left = freedom_of(slab);
  for (int a = 0; a < 3; a++)
    squares -= slab->grains * line.mean[a] * line.mean[a] + spread * line.slope[a] * line.slope[a];
  return left > 0 ? squares / (3 * left) : 0;
}

void gg_measure_local_frame_make(gg_local_frame *f, const gg_slabs *slabs)
{
  f->n = slabs->n, f->inverse_thickness = slabs->inverse_thickness;
  for (int i = 0; i < GG_MAX_SPECIES; i++) f->radius[i] = slabs->radius[i];
  for (int k = 0; k < f->n; k++) {
    const gg_slab *slab = &slabs->slab[k];
    double left = freedom_of(slab);
    f->centre[k] = slab->grains > 0 ? slab->height / slab->grains : 0;
    f->stretch[k] = left > 0 ? sqrt(slab->grains / left) : 1;
    f->flow[k] = fit_line(slab, slab->velocity, slab->moment);
    f->rolling[k] = fit_line(slab, slab->spin, slab->spin_moment);
  }
}

/* The sums of the image of a slab are added to another. */
static void add_image(gg_slab *to, const gg_slab *from, gg_wall_symmetry symmetry)
{
  to->grains += from->grains, to->first += from->first, to->square += from->square;
  to->height -= from->height, to->height_square += from->height_square;
  for (int a = 0; a < 3; a++) {
    const double velocity = gg_wall_image(symmetry, false, a), spin = gg_wall_image(symmetry, true, a);
    to->velocity[a] += velocity * from->velocity[a], to->moment[a] -= velocity * from->moment[a];
    to->spin[a] += spin * from->spin[a], to->spin_moment[a] -= spin * from->spin_moment[a];
  }
}

void gg_measure_local_frame_of_flow(gg_local_frame *f, const gg_model *model, const gg_slabs *slabs)
{
  const gg_wall_symmetry symmetry = gg_wall_symmetry_of(model);
  gg_slabs both = *slabs;
  for (int k = 0; symmetry != GG_NO_SYMMETRY && k < slabs->n; k++)
    add_image(&both.slab[k], &slabs->slab[slabs->n - 1 - k], symmetry);
  gg_measure_local_frame_make(f, &both);
}

static gg_vec on_line(const gg_line *line, double height)
{
  return (gg_vec){line->mean[0] + line->slope[0] * height, line->mean[1] + line->slope[1] * height,
                  line->mean[2] + line->slope[2] * height};
}

gg_vec gg_measure_local_frame_flow(const gg_local_frame *f, double y)
{
  double height;
  int k = slab_at(f->inverse_thickness, f->n, y, &height);
  return on_line(&f->flow[k], height - f->centre[k]);
}

gg_vec gg_measure_local_frame_velocity(const gg_local_frame *f, double y, gg_vec c)
{
  double height;
  int k = slab_at(f->inverse_thickness, f->n, y, &height);
  return gg_scale(f->stretch[k], gg_sub(c, on_line(&f->flow[k], height - f->centre[k])));
}

gg_vec gg_measure_local_frame_spin(const gg_local_frame *f, double y, gg_vec s, int species)
{
  double height;
  int k = slab_at(f->inverse_thickness, f->n, y, &height);
  gg_vec rolling = on_line(&f->rolling[k], height - f->centre[k]);
  return gg_scale(f->stretch[k], gg_sub(s, gg_scale(f->radius[species], rolling)));
}

typedef struct shifting {
  const gg_local_frame *frame;
  gg_visit *visit;
  void *context;
} shifting;

static void put(double *const x[3], size_t i, gg_vec v)
{
  x[0][i] = v.x, x[1][i] = v.y, x[2][i] = v.z;
}

static void shift_chunk(void *context, const gg_chunk *chunk)
{
  const shifting *s = context;
  double c[3][GG_CHUNK], w[3][GG_CHUNK];
  double *const to_c[3] = {c[0], c[1], c[2]}, *const to_w[3] = {w[0], w[1], w[2]};
  gg_chunk local = *chunk;
  for (size_t i = 0; i < chunk->n; i++) {
    double y = chunk->r[1][i];
    put(to_c, i, gg_measure_local_frame_velocity(s->frame, y, at(chunk->c, i)));
    if (chunk->s[0]) put(to_w, i, gg_measure_local_frame_spin(s->frame, y, at(chunk->s, i), species_of(chunk, i)));
  }
  for (int a = 0; a < 3; a++) {
    local.c[a] = c[a], local.whole_c[a] = chunk->c[a], local.whole_s[a] = chunk->s[a];
    if (chunk->s[a]) local.s[a] = w[a];
  }
  s->visit(s->context, &local);
}

void gg_measure_local_frame_snapshot(const gg_local_frame *frame, gg_engine *engine, gg_visit *visit, void *context)
{
  shifting s = {frame, visit, context};
  engine->ops->snapshot(engine, true, shift_chunk, &s);
}
