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

static void add_chunk(void *context, const gg_chunk *chunk)
{
  gg_local_frame *f = context;
  for (size_t i = 0; i < chunk->n; i++) {
    int k = slab_of(f, chunk->r[1][i]);
    f->count[k]++;
    for (int a = 0; a < 3; a++) f->mean[k][a] += chunk->c[a][i];
  }
}

void gg_local_frame_take(gg_local_frame *f, const gg_model *model, gg_engine *engine)
{
  *f = (gg_local_frame){.n_slabs = slabs_of(model)};
  f->inverse_width = f->n_slabs / model->box[1];
  engine->ops->snapshot(engine, true, add_chunk, f);
  for (int k = 0; k < f->n_slabs; k++) {
    double n = f->count[k];
    for (int a = 0; a < 3; a++) f->mean[k][a] = n > 0 ? f->mean[k][a] / n : 0;
    f->stretch[k] = n > 1 ? sqrt(n / (n - 1)) : 1;
  }
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
    int k = slab_of(s->frame, chunk->r[1][i]);
    for (int a = 0; a < 3; a++) c[a][i] = (chunk->c[a][i] - s->frame->mean[k][a]) * s->frame->stretch[k];
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
