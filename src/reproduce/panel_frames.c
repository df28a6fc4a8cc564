/* The flow across a sheared box, from the frames that were stored: means over slabs, errors from block to block, since
 * waves of the flow outlast the time between two frames. */
#include <math.h>
#include <stdlib.h>

#include "files/h5/hdf5_reader.h"
#include "reproduce/panel.h"

enum { SLABS = 20, BLOCKS = 10 };
static const char *const engines[] = {"md", "dsmc"};

typedef struct slabs {
  double sum[BLOCKS][SLABS];
  size_t grains[BLOCKS][SLABS];
} slabs;

/* Laboratory velocity over rate times height, which is 0 at mid-height. */
static void add_frame(slabs *s, int block, const double *place, const double *velocity, size_t n, double edge)
{
  for (size_t i = 0; i < n; i++) {
    double height = place[3 * i + 1] / edge - floor(place[3 * i + 1] / edge);
    if (!(height >= 0 && height <= 1)) continue; /* no number, of a file that is not ours */
    int k = (int)(height * SLABS) % SLABS;
    s->sum[block][k] += velocity[3 * i] / edge + height - 0.5;
    s->grains[block][k]++;
  }
}

static double *row(gg_h5_in *h, const char *path, size_t k, size_t items)
{
  return gg_h5_read_row(h, path, k, GG_ITEM_F64, items);
}

static gg_status read_frames(slabs *s, const gg_figure_point *point, gg_error *err)
{
  gg_h5_in h;
  const gg_stored_result *r = &point->stored;
  gg_h5_open(&h, point->path);
  for (size_t k = 0; k < r->n_frames && !h.failed; k++) {
    double *place = row(&h, "/particles/grains/position/value", k, 3 * r->n_grains);
    double *velocity = row(&h, "/particles/grains/velocity/value", k, 3 * r->n_grains);
    int block = (int)(k * BLOCKS / r->n_frames);
    if (place && velocity) add_frame(s, block, place, velocity, r->n_grains, r->edge[1]);
    free(place);
    free(velocity);
  }
  gg_h5_in_close(&h);
  return gg_h5_in_status(&h, point->path, err);
}

/* Mean of the blocks' means, and the standard error from their scatter. */
static gg_told slab_mean(const slabs *s, int k)
{
  double sum = 0, square = 0, n = 0;
  for (int block = 0; block < BLOCKS; block++) {
    if (!s->grains[block][k]) continue;
    double mean = s->sum[block][k] / (double)s->grains[block][k];
    sum += mean, square += mean * mean, n++;
  }
  if (n < 1) return GG_NO_VALUE;
  double mean = sum / n;
  return (gg_told){mean, n > 1 ? sqrt(fmax(square / n - mean * mean, 0) / (n - 1)) : NAN, NULL};
}

static gg_status frames_of(gg_drawn_panel *p, const gg_figure_point *point, int engine, gg_error *err)
{
  char group[128];
  slabs s = {0};
  if (!(point->stored.edge[1] > 0)) return GG_OK;
  GG_TRY(read_frames(&s, point, err));
  gg_reproduce_panel_group(p->of, point, "", group, sizeof group);
  gg_drawn *d = gg_reproduce_panel_add(p, engines[engine], group, GG_CHART_POINTS);
  for (int k = 0; k < SLABS; k++) {
    gg_told u = slab_mean(&s, k);
    if (isfinite(u.mean)) GG_TRY(gg_reproduce_drawn_put(d, (k + 0.5) / SLABS - 0.5, NAN, u.mean, u.error, err));
  }
  return GG_OK;
}

gg_status gg_reproduce_panel_frames(gg_drawn_panel *p, const gg_figure_points *all, gg_error *err)
{
  for (int engine = 0; engine < 2; engine++)
    for (size_t i = 0; i < all->n; i++)
      if (gg_reproduce_panel_takes(p->of, &all->point[i]) && gg_reproduce_panel_engine(p->of, &all->point[i], engine))
        GG_TRY(frames_of(p, &all->point[i], engine, err));
  return GG_OK;
}
