/* One picture for each observable that left curves. */
#include <stdlib.h>
#include <string.h>

#include "io/c_locale.h"
#include "io/curves.h"
#include "io/plot/plot.h"

enum { MOST_GROUPS = 16 };

static gg_status draw_page(const gg_stored_result *stored, const json_t *document, const char *group,
                           const char *picture, bool png, gg_error *err)
{
  char *script = NULL;
  size_t length;
  int size[2];
  FILE *s = open_memstream(&script, &length);
  if (!s) return gg_fail(err, GG_FAILED, "out of memory");
  locale_t before = gg_c_locale_enter();
  gg_plot_curves_size(document, group, size);
  gg_plot_start_page(s, stored, png, size[0], size[1]);
  gg_plot_curves(s, document, group);
  fprintf(s, "unset multiplot\n");
  gg_c_locale_leave(before);
  gg_status status = fclose(s) == 0 ? GG_OK : gg_fail(err, GG_FAILED, "out of memory");
  if (status == GG_OK) status = gg_gnuplot_run(script, NULL, picture, err);
  free(script);
  return status;
}

/* "usf.svg" -> "usf_md_velocity_distributions.svg" */
static char *page_name(const char *picture, const char *engine, const char *group, bool png)
{
  char *name = NULL;
  size_t stem = strlen(picture);
  if (stem > 4 && (strcmp(picture + stem - 4, ".svg") == 0 || strcmp(picture + stem - 4, ".png") == 0)) stem -= 4;
  int written =
      asprintf(&name, "%.*s_%s%s%s.%s", (int)stem, picture, engine, *engine ? "_" : "", group, png ? "png" : "svg");
  return written < 0 ? NULL : name;
}

static gg_status draw_snapshot(const gg_stored_result *stored, const char *picture, bool png,
                               void (*drawn)(void *context, const char *picture), void *context, gg_error *err)
{
  bool there;
  char *name = page_name(picture, "", "snapshot", png);
  if (!name) return gg_fail(err, GG_FAILED, "out of memory");
  gg_status status = gg_plot_snapshot(stored, name, png, &there, err);
  if (status == GG_OK && there && drawn) drawn(context, name);
  free(name);
  return status;
}

gg_status gg_plot_result_curves(const gg_stored_result *stored, const char *picture, const char *format,
                                void (*drawn)(void *context, const char *picture), void *context, gg_error *err)
{
  bool png;
  GG_TRY(gg_plot_format(picture, format, &png, err));
  /* A page that fails keeps none of the others from being drawn; what is told is the first failure. */
  gg_status status = draw_snapshot(stored, picture, png, drawn, context, err);
  for (int k = 0; k < 2; k++) {
    const gg_stored_engine *e = &stored->engine[k];
    const char *groups[MOST_GROUPS];
    int n = e->name ? gg_curve_groups(e->document, groups, MOST_GROUPS) : 0;
    for (int i = 0; i < n; i++) {
      gg_error unheard, *told = status == GG_OK ? err : &unheard;
      char *name = page_name(picture, stored->comparison ? e->name : "", groups[i], png);
      gg_status page =
          name ? draw_page(stored, e->document, groups[i], name, png, told) : gg_fail(told, GG_FAILED, "out of memory");
      if (page == GG_OK && drawn) drawn(context, name);
      if (status == GG_OK) status = page;
      free(name);
    }
  }
  return status;
}
