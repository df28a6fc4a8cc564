/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The picture of a result, and the pages beside it: a snapshot, and one page for each observable with curves. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "files/curve_table.h"
#include "io/atomic_file.h"
#include "plot/result_panels.h"

enum { MOST_GROUPS = 16 };

static bool has_open_symbols(const gg_chart *c)
{
  bool any = false;
  for (size_t p = 0; p < c->n; p++)
    for (size_t k = 0; k < c->panel[p]->n; k++)
      for (size_t i = 0; i < c->panel[p]->series[k]->n && c->panel[p]->series[k]->look.style == GG_CHART_POINTS; i++)
        any |= c->panel[p]->series[k]->point[i].open;
  return any;
}

/* Title and note of a chart with all its panels; then it is drawn and freed. */
static gg_status finish(gg_chart *c, const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                        gg_error *err)
{
  char title[240];
  const bool md = gg_plot_is_unsteady(&stored->engine[GG_MD]), dsmc = gg_plot_is_unsteady(&stored->engine[GG_DSMC]);
  gg_plot_scene_title(stored, title, sizeof title);
  c->title = title;
  if (has_open_symbols(c))
    c->note = md && dsmc ? "Open symbols: not steady (md, dsmc)"
              : md       ? "Open symbols: not steady (md)"
                         : "Open symbols: not steady (dsmc)";
  return gg_plot_chart_finish(c, paper, picture, err);
}

gg_status gg_plot_result_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                              gg_error *err)
{
  gg_chart *c = gg_plot_chart_new();
  if (!c) return gg_base_out_of_memory(err);
  c->columns = 2;
  if (stored->comparison) gg_plot_add_comparison(c, stored);
  const double share = stored->comparison && stored->engine[GG_MD].name && stored->engine[GG_DSMC].name ? 0.5 : 0;
  for (const gg_stored_engine *e = stored->engine; e < stored->engine + 2; e++)
    if (e->name) gg_plot_add_relaxation(c, e, !stored->comparison && gg_plot_has_stresses(e), share);
  return finish(c, stored, paper, picture, err);
}

typedef struct page {
  char *path;
  const char *group;                      /* of curves; NULL: the snapshot */
  const gg_stored_engine *engine, *other; /* NULL: one engine alone */
} page;

typedef struct page_list {
  int n;
  page page[1 + 2 * MOST_GROUPS];
} page_list;

static gg_status draw_curves(const gg_stored_result *stored, const page *p, const json_t *theories,
                             const gg_plot_paper *paper, gg_error *err)
{
  gg_chart *c = gg_plot_chart_new();
  if (!c) return gg_base_out_of_memory(err);
  gg_plot_add_curves(c, p->engine, p->other, theories, p->group);
  return finish(c, stored, paper, p->path, err);
}

static void clear(page_list *pages)
{
  for (int i = 0; i < pages->n; i++) free(pages->page[i].path);
  pages->n = 0;
}

static bool has_group(const gg_stored_engine *e, const char *group)
{
  const char *groups[MOST_GROUPS];
  int n = e->name ? gg_plot_curve_groups(e->document, groups, MOST_GROUPS) : 0;
  while (n > 0 && strcmp(groups[n - 1], group) != 0) n--;
  return n > 0;
}

/* List the pages of a result; to be cleared, also on failure. */
static gg_status list(page_list *pages, const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                      gg_error *err)
{
  bool whole = true;
  pages->n = 0;
  if (gg_plot_snapshot_has(stored))
    pages->page[pages->n++] = (page){.path = gg_plot_page_name(picture, "", GG_SNAPSHOT_PAGE, paper)};
  for (int k = 0; k < GG_N_ENGINES; k++) { /* a page that both share has one curve beside the other */
    const gg_stored_engine *e = &stored->engine[k], *other = &stored->engine[!k];
    const char *groups[MOST_GROUPS], *engine = stored->comparison ? e->name : "";
    int n = e->name ? gg_plot_curve_groups(e->document, groups, MOST_GROUPS) : 0;
    for (int i = 0; i < n; i++) {
      const bool both = stored->comparison && has_group(other, groups[i]);
      if (both && k) continue;
      pages->page[pages->n++] =
          (page){gg_plot_page_name(picture, both ? "" : engine, groups[i], paper), groups[i], e, both ? other : NULL};
    }
  }
  for (int i = 0; i < pages->n; i++) whole &= pages->page[i].path != NULL;
  return whole ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status check_page(const char *path, const char *picture, const char *file, gg_error *err)
{
  if (gg_io_path_is_same_file(path, file))
    return GG_REFUSE(err, "%s: would be both the result and " GG_PAGE_BESIDE "; choose another picture", path, picture);
  return gg_io_atomic_check_writable(path, GG_PICTURES_ARE, err);
}

gg_status gg_plot_pages_check(const gg_stored_result *stored, const gg_plot_paper *paper, const char *file,
                              const char *picture, gg_error *err)
{
  page_list pages;
  gg_status status = list(&pages, stored, paper, picture, err);
  for (int i = 0; status == GG_OK && i < pages.n; i++) status = check_page(pages.page[i].path, picture, file, err);
  clear(&pages);
  return status;
}

gg_status gg_plot_pages_draw(const gg_stored_result *stored, const gg_plot_paper *paper, const char *picture,
                             void (*drawn)(void *context, const char *picture), void *context, const gg_stop *stop,
                             gg_error *err)
{
  bool there;
  page_list pages;
  gg_status status = list(&pages, stored, paper, picture, err);
  if (status != GG_OK) clear(&pages);
  json_auto_t *theories = NULL;
  /* If a page fails, the others are still drawn; the first failure is reported. */
  for (int i = 0; i < pages.n; i++) {
    const page *p = &pages.page[i];
    gg_error later, *reported = status == GG_OK ? err : &later;
    if (p->group && !theories) theories = gg_plot_theory_curves(stored, stop);
    gg_status done = gg_stop_check(stop, reported);
    if (done == GG_OK)
      done = p->group ? draw_curves(stored, p, theories, paper, reported)
                      : gg_plot_snapshot_draw(stored, paper, p->path, &there, reported);
    if (done == GG_OK && drawn) drawn(context, p->path);
    if (status == GG_OK) status = done;
  }
  clear(&pages);
  return status;
}
