/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoint of the engine: everything that a run needs to continue bit for bit. The records are stored as bytes. Cells
 * and event queue are filled again, since the order of their contents never matters. */
#include "md/md_operations.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "md/event_loops.h"
#include "md/grid.h"
#include "md/images.h"
#include "md/kicks.h"
#include "md/md_allocate.h"
#include "md/row_motion.h"
#include "md/select_search.h"
#include "md/start/all_grains.h"
#include "md/verify.h"

/* Plain data beside the arrays. */
typedef struct block {
  gg_md_counts counts;
  double offset0, bucket_width, skin_radius; /* skin_radius 0: no lists */
  uint32_t current_bucket;
  int32_t cells[3];
  uint32_t overlapping, comoving;
} block;

static gg_status put(gg_archive *a, const char *name, const void *data, size_t bytes, gg_error *err)
{
  return gg_base_archive_put(a, name, GG_ITEM_U8, data, bytes, err);
}

static gg_status put_lists(const gg_md *e, gg_archive *a, gg_error *err)
{
  const gg_md_lists *lists = &e->search.lists;
  GG_TRY(put(a, "md/skins", lists->skin, e->n * sizeof *lists->skin, err));
  return put(a, "md/neighbours", lists->neighbour, e->n * GG_MD_LIST * sizeof *lists->neighbour, err);
}

gg_status gg_md_save(const gg_engine *engine, gg_archive *a, gg_error *err)
{
  const gg_md *e = (const gg_md *)engine;
  block b;
  memset(&b, 0, sizeof b);
  b.counts = e->k;
  b.offset0 = e->box.offset0;
  b.bucket_width = e->queue.width;
  b.current_bucket = e->queue.current;
  b.skin_radius = e->search.kind == GG_MD_NEIGHBOUR_LISTS ? e->search.lists.radius : 0;
  b.overlapping = gg_md_search_overlaps(e->search.kind);
  b.comoving = gg_md_search_has_rows(e->search.kind);
  memcpy(b.cells, e->cells.n, sizeof b.cells);
  GG_TRY(put(a, "md/state", &b, sizeof b, err));
  GG_TRY(put(a, "md/grains", e->grain, e->n * sizeof *e->grain, err));
  GG_TRY(put(a, "md/events", e->node, e->n * sizeof *e->node, err));
  GG_TRY(put(a, "md/id", e->id, e->n * sizeof *e->id, err));
  if (e->spin) GG_TRY(put(a, "md/spins", e->spin, e->n * sizeof *e->spin, err));
  if (e->image) GG_TRY(put(a, "md/images", e->image, e->n * sizeof *e->image, err));
  if (e->last) GG_TRY(put(a, "md/last_collisions", e->last, e->n * sizeof *e->last, err));
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS) GG_TRY(put_lists(e, a, err));
  return GG_OK;
}

static gg_status get(const gg_archive *a, const char *name, void *data, size_t bytes, gg_error *err)
{
  return gg_base_archive_get(a, name, GG_ITEM_U8, data, bytes, err);
}

static gg_status reject(const char *what, gg_error *err)
{
  return gg_base_fail(err, GG_BAD_FILE, "the checkpoint of md is damaged: %s", what);
}

static gg_status get_block(const gg_md *e, const gg_archive *a, block *b, gg_error *err)
{
  GG_TRY(get(a, "md/state", b, sizeof *b, err));
  if (!gg_md_is_search_of(&e->model, b->cells, b->skin_radius, b->overlapping, b->comoving))
    return reject("its cells are not those of this scene", err);
  const bool good = gg_md_are_counts(&b->counts, b->cells) && fabs(b->offset0) <= 2 * e->box.edge[0] &&
                    b->bucket_width > 1e-300 && b->bucket_width < 1e300 && b->current_bucket <= e->queue.n_buckets &&
                    b->overlapping <= 1 && b->comoving <= 1;
  return good ? GG_OK : reject("its counts", err);
}

static gg_md_search_kind kind_of(const block *b)
{
  if (b->skin_radius > 0) return GG_MD_NEIGHBOUR_LISTS;
  if (b->overlapping) return b->comoving ? GG_MD_OVERLAPPING_ROWS : GG_MD_OVERLAPPING_CELLS;
  return b->comoving ? GG_MD_COMOVING_ROWS : GG_MD_PLAIN_CELLS;
}

static gg_status get_lists(gg_md *e, const gg_archive *a, double radius, gg_error *err)
{
  const gg_md_lists *lists = &e->search.lists;
  GG_TRY(gg_md_allocate_lists(e, err));
  gg_md_set_skins(e, radius);
  GG_TRY(get(a, "md/skins", lists->skin, e->n * sizeof *lists->skin, err));
  return get(a, "md/neighbours", lists->neighbour, e->n * GG_MD_LIST * sizeof *lists->neighbour, err);
}

static gg_status load(gg_md *e, const gg_archive *a, gg_error *err)
{
  block b;
  GG_TRY(get_block(e, a, &b, err));
  GG_TRY(get(a, "md/grains", e->grain, e->n * sizeof *e->grain, err));
  GG_TRY(get(a, "md/events", e->node, e->n * sizeof *e->node, err));
  GG_TRY(get(a, "md/id", e->id, e->n * sizeof *e->id, err));
  if (e->spin) GG_TRY(get(a, "md/spins", e->spin, e->n * sizeof *e->spin, err));
  if (gg_base_archive_find(a, "md/images")) GG_TRY(gg_md_keep_images(&e->base, err));
  if (e->image) GG_TRY(get(a, "md/images", e->image, e->n * sizeof *e->image, err));
  if (!e->last && gg_base_archive_find(a, "md/last_collisions"))
    GG_TRY(gg_md_allocate_last(e, err)); /* the stored engine had a callback */
  if (e->last) GG_TRY(get(a, "md/last_collisions", e->last, e->n * sizeof *e->last, err));
  e->search.kind = kind_of(&b);
  if (e->search.kind == GG_MD_NEIGHBOUR_LISTS) GG_TRY(get_lists(e, a, b.skin_radius, err));
  e->k = b.counts;
  e->box.offset0 = b.offset0;
  GG_TRY(gg_md_make_cells(e, b.cells, gg_md_reach(&e->model) + 2 * b.skin_radius, err));
  GG_TRY(gg_md_find_near_surfaces(e, err));
  if (gg_md_search_has_rows(e->search.kind)) GG_TRY(gg_md_make_rows(e, err));
  gg_md_queue_reset(&e->queue, b.bucket_width);
  const unsigned before = gg_base_memory_failures();
  GG_TRY(gg_md_poll_stop(e, err));
  const char *wrong = gg_md_wrong_grains(e);
  if (gg_base_memory_failures() != before) return gg_base_out_of_memory_for(err, "reading the checkpoint of md");
  if (wrong) return reject(wrong, err);
  GG_TRY(gg_md_poll_stop(e, err));
  if (!gg_md_fill_grid(e)) return gg_base_out_of_memory_for(err, "the grid of cells");
  GG_TRY(gg_md_poll_stop(e, err));
  GG_TRY(gg_md_kicks_make(e, err));
  e->queue.current = b.current_bucket;
  for (uint32_t i = 0; i < e->n; i++) gg_md_queue_insert(&e->queue, e->node, i);
  gg_md_select(e);
  return GG_OK;
}

/* Polls the `stop` of the archive, not of the run: the run stops its replicas for a checkpoint, and a replica that
 * comes back from another process then has to be complete. */
gg_status gg_md_restore(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err)
{
  gg_md *e;
  GG_TRY(gg_md_allocate(model, &e, err));
  e->model.stop = archive->stop;
  gg_status status = load(e, archive, err);
  e->model.stop = model->stop;
  if (status == GG_OK)
    *engine = &e->base;
  else
    gg_md_free(e);
  return status;
}
