#include "measure/local_frame.h"

#include <math.h>

/* A slab holds at least so many grains on average, and is at least a diameter thick. */
enum { GRAINS_PER_SLAB = 30 };

static int slabs_of(const gg_model *model)
{
  double n = fmin(floor(model->box[1]), floor((double)model->n / GRAINS_PER_SLAB));
  return n < 1 ? 1 : n > GG_MAX_SLABS ? GG_MAX_SLABS : (int)n;
}

static int slab_of(const gg_local_frame *f, double y)
{
  int k = (int)((y - f->bottom) * f->inverse_width);
  return k < 0 ? 0 : k >= f->n_slabs ? f->n_slabs - 1 : k;
}

static void start(gg_local_frame *f, const gg_model *model)
{
  *f = (gg_local_frame){.n_slabs = slabs_of(model)};
  f->inverse_width = f->n_slabs / model->box[1];
  for (int i = 0; i < model->n_species; i++) f->radius[i] = model->diameter[i] / 2;
}

static void add_spin(gg_local_frame *f, double y, gg_vec s, int species)
{
  double *sum = f->spin[slab_of(f, y)], radius = f->radius[species];
  sum[0] += s.x / radius, sum[1] += s.y / radius, sum[2] += s.z / radius;
}

static void add(gg_local_frame *f, double y, gg_vec c, int species)
{
  int k = slab_of(f, y);
  f->count[k]++;
  f->first[k] += species == 0;
  f->mean[k][0] += c.x, f->mean[k][1] += c.y, f->mean[k][2] += c.z;
  f->temperature[k] += gg_dot(c, c);
}

static void finish(gg_local_frame *f)
{
  for (int k = 0; k < f->n_slabs; k++) {
    double n = f->count[k], of_mean = 0;
    for (int a = 0; a < 3; a++) f->mean[k][a] = n > 0 ? f->mean[k][a] / n : 0;
    for (int a = 0; a < 3; a++) f->spin[k][a] = n > 0 ? f->spin[k][a] / n : 0;
    for (int a = 0; a < 3; a++) of_mean += n * f->mean[k][a] * f->mean[k][a];
    f->stretch[k] = n > 1 ? sqrt(n / (n - 1)) : 1;
    f->temperature[k] = n > 1 ? (f->temperature[k] - of_mean) / (3 * (n - 1)) : 0;
  }
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
    add(context, chunk->r[1][i], at(chunk->c, i), species_of(chunk, i));
    if (chunk->s[0]) add_spin(context, chunk->r[1][i], at(chunk->s, i), species_of(chunk, i));
  }
}

void gg_measure_local_frame_take(gg_local_frame *f, const gg_model *model, gg_engine *engine)
{
  start(f, model);
  engine->ops->snapshot(engine, true, add_chunk, f);
  finish(f);
}

void gg_measure_local_frame_of_snapshot(gg_local_frame *f, const gg_snapshot *s)
{
  start(f, s->model);
  for (size_t i = 0; i < s->n; i++) {
    int species = gg_snapshot_species(s, i);
    add(f, s->r[1][i], (gg_vec){s->c[0][i], s->c[1][i], s->c[2][i]}, species);
    if (s->s[0]) add_spin(f, s->r[1][i], (gg_vec){s->s[0][i], s->s[1][i], s->s[2][i]}, species);
  }
  finish(f);
}

gg_vec gg_measure_local_frame_velocity(const gg_local_frame *f, double y, gg_vec c)
{
  int k = slab_of(f, y);
  gg_vec mean = {f->mean[k][0], f->mean[k][1], f->mean[k][2]};
  return gg_scale(f->stretch[k], gg_sub(c, mean));
}

gg_vec gg_measure_local_frame_spin(const gg_local_frame *f, double y, gg_vec s, int species)
{
  int k = slab_of(f, y);
  gg_vec mean = {f->spin[k][0], f->spin[k][1], f->spin[k][2]};
  return gg_scale(f->stretch[k], gg_sub(s, gg_scale(f->radius[species], mean)));
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
    local.c[a] = c[a], local.whole_s[a] = chunk->s[a];
    if (chunk->s[a]) local.s[a] = w[a];
  }
  s->visit(s->context, &local);
}

void gg_measure_local_frame_snapshot(const gg_local_frame *frame, gg_engine *engine, gg_visit *visit, void *context)
{
  shifting s = {frame, visit, context};
  engine->ops->snapshot(engine, true, shift_chunk, &s);
}
