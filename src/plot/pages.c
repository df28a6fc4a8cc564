/* The pictures beside a picture: a snapshot, and one for each observable that left curves. */
#include <stdlib.h>
#include <string.h>

#include "base/atomic_file.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "files/curve_table.h"
#include "plot/plot.h"

enum { MOST_GROUPS = 16 };

typedef struct page {
  char *path;
  const char *group; /* of curves; NULL: the snapshot */
  const json_t *document;
} page;

typedef struct page_list {
  int n;
  page page[1 + 2 * MOST_GROUPS];
} page_list;

static gg_status draw_page(const gg_stored_result *stored, const page *p, const json_t *theories, bool png,
                           gg_error *err)
{
  char *script = NULL;
  int size[2];
  FILE *s = gg_base_memory_stream_open(&script);
  if (!s) return gg_base_out_of_memory(err);
  locale_t before = gg_base_c_locale_enter();
  gg_plot_curves_size(p->document, p->group, size);
  gg_plot_start_page(s, stored, png, size[0], size[1]);
  gg_plot_curves(s, p->document, theories, p->group);
  fprintf(s, "unset multiplot\n");
  gg_base_c_locale_leave(before);
  gg_status status = gg_base_memory_stream_close(s, &script) ? GG_OK : gg_base_out_of_memory(err);
  if (status == GG_OK) status = gg_plot_gnuplot_run(script, NULL, p->path, err);
  free(script);
  return status;
}

char *gg_plot_page_name(const char *picture, const char *engine, const char *group, bool png)
{
  char *name = NULL;
  size_t stem = strlen(picture);
  if (stem > 4 && (strcmp(picture + stem - 4, ".svg") == 0 || strcmp(picture + stem - 4, ".png") == 0)) stem -= 4;
  int written =
      asprintf(&name, "%.*s_%s%s%s.%s", (int)stem, picture, engine, *engine ? "_" : "", group, png ? "png" : "svg");
  return written < 0 ? NULL : name;
}

static void clear(page_list *pages)
{
  for (int i = 0; i < pages->n; i++) free(pages->page[i].path);
  pages->n = 0;
}

/* To be cleared, also on failure. */
static gg_status list(page_list *pages, const gg_stored_result *stored, const char *picture, bool png, gg_error *err)
{
  bool whole = true;
  pages->n = 0;
  if (gg_plot_has_snapshot(stored))
    pages->page[pages->n++] = (page){.path = gg_plot_page_name(picture, "", GG_SNAPSHOT_PAGE, png)};
  for (int k = 0; k < 2; k++) {
    const gg_stored_engine *e = &stored->engine[k];
    const char *groups[MOST_GROUPS], *engine = stored->comparison ? e->name : "";
    int n = e->name ? gg_plot_curve_groups(e->document, groups, MOST_GROUPS) : 0;
    for (int i = 0; i < n; i++)
      pages->page[pages->n++] = (page){gg_plot_page_name(picture, engine, groups[i], png), groups[i], e->document};
  }
  for (int i = 0; i < pages->n; i++) whole &= pages->page[i].path != NULL;
  return whole ? GG_OK : gg_base_out_of_memory(err);
}

static gg_status check_page(const char *path, const char *picture, const char *file, gg_error *err)
{
  if (gg_base_path_is_same_file(path, file))
    return gg_base_fail(err, GG_BAD_INPUT,
                        "%s: would be both the result and " GG_PAGE_BESIDE "; choose another picture", path, picture);
  return gg_base_atomic_check_writable(path, GG_PICTURES_ARE, err);
}

gg_status gg_plot_check_pages(const gg_stored_result *stored, const char *file, const char *picture, const char *format,
                              gg_error *err)
{
  bool png;
  page_list pages;
  GG_TRY(gg_plot_format(picture, format, &png, err));
  gg_status status = list(&pages, stored, picture, png, err);
  for (int i = 0; status == GG_OK && i < pages.n; i++) status = check_page(pages.page[i].path, picture, file, err);
  clear(&pages);
  return status;
}

gg_status gg_plot_pages(const gg_stored_result *stored, const char *picture, const char *format,
                        void (*drawn)(void *context, const char *picture), void *context, gg_error *err)
{
  bool png, there;
  page_list pages;
  GG_TRY(gg_plot_format(picture, format, &png, err));
  gg_status status = list(&pages, stored, picture, png, err);
  if (status != GG_OK) clear(&pages);
  json_t *theories = NULL;
  /* A page that fails keeps none of the others from being drawn; what is told is the first failure. */
  for (int i = 0; i < pages.n; i++) {
    const page *p = &pages.page[i];
    gg_error unheard, *told = status == GG_OK ? err : &unheard;
    if (p->group && !theories) theories = gg_plot_theory_curves(stored);
    gg_status done =
        p->group ? draw_page(stored, p, theories, png, told) : gg_plot_snapshot(stored, p->path, png, &there, told);
    if (done == GG_OK && drawn) drawn(context, p->path);
    if (status == GG_OK) status = done;
  }
  json_decref(theories);
  clear(&pages);
  return status;
}
