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
    for (int a = 0; a < 3; a++) of_mean += n * f->mean[k][a] * f->mean[k][a];
    f->stretch[k] = n > 1 ? sqrt(n / (n - 1)) : 1;
    f->temperature[k] = n > 1 ? (f->temperature[k] - of_mean) / (3 * (n - 1)) : 0;
  }
}

static void add_chunk(void *context, const gg_chunk *chunk)
{
  for (size_t i = 0; i < chunk->n; i++)
    add(context, chunk->r[1][i], (gg_vec){chunk->c[0][i], chunk->c[1][i], chunk->c[2][i]},
        chunk->species ? chunk->species[i] : 0);
}

void gg_local_frame_take(gg_local_frame *f, const gg_model *model, gg_engine *engine)
{
  start(f, model);
  engine->ops->snapshot(engine, true, add_chunk, f);
  finish(f);
}

void gg_local_frame_of_snapshot(gg_local_frame *f, const gg_snapshot *s)
{
  start(f, s->model);
  for (size_t i = 0; i < s->n; i++)
    add(f, s->r[1][i], (gg_vec){s->c[0][i], s->c[1][i], s->c[2][i]}, gg_snapshot_species(s, i));
  finish(f);
}

gg_vec gg_local_frame_velocity(const gg_local_frame *f, double y, gg_vec c)
{
  int k = slab_of(f, y);
  gg_vec mean = {f->mean[k][0], f->mean[k][1], f->mean[k][2]};
  return gg_scale(f->stretch[k], gg_sub(c, mean));
}

typedef struct shifting {
  const gg_local_frame *frame;
  gg_visit *visit;
  void *context;
} shifting;

static void shift_chunk(void *context, const gg_chunk *chunk)
{
  const shifting *s = context;
  double c[3][GG_CHUNK];
  for (size_t i = 0; i < chunk->n; i++) {
    gg_vec v = {chunk->c[0][i], chunk->c[1][i], chunk->c[2][i]};
    v = gg_local_frame_velocity(s->frame, chunk->r[1][i], v);
    c[0][i] = v.x, c[1][i] = v.y, c[2][i] = v.z;
  }
  gg_chunk local = *chunk;
  for (int a = 0; a < 3; a++) local.c[a] = c[a];
  s->visit(s->context, &local);
}

void gg_local_frame_snapshot(const gg_local_frame *frame, gg_engine *engine, gg_visit *visit, void *context)
{
  shifting s = {frame, visit, context};
  engine->ops->snapshot(engine, true, shift_chunk, &s);
}
