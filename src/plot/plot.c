#include "plot/plot.h"

#include <stdlib.h>
#include <string.h>

#include "base/atomic_file.h"
#include "base/c_locale.h"
#include "base/memory.h"
#include "base/memory_stream.h"

gg_status gg_plot_format(const char *picture, const char *format, bool *png, gg_error *err)
{
  const char *slash = strrchr(picture, '/'), *name = slash ? slash + 1 : picture, *dot = strrchr(name, '.');
  const char *ending = dot && dot > name ? dot + 1 : NULL;
  if (!*name) return gg_base_fail(err, GG_BAD_INPUT, "'%s': a picture needs a name, .svg or .png", picture);
  if (format && strcmp(format, "svg") != 0 && strcmp(format, "png") != 0)
    return gg_base_fail(err, GG_BAD_INPUT, "pictures are svg or png, not '%.20s'", format);
  if (!ending && !format)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: a picture's name ends with .svg or .png", picture);
  if (ending && strcmp(ending, "svg") != 0 && strcmp(ending, "png") != 0)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: pictures are .svg or .png, not .%.20s", picture, ending);
  if (ending && format && strcmp(ending, format) != 0)
    return gg_base_fail(err, GG_BAD_INPUT, "%s: is to be %s, and its name says %s", picture, format, ending);
  *png = strcmp(ending ? ending : format, "png") == 0;
  return GG_OK;
}

gg_status gg_plot_could(const char *picture, const char *format, bool *png, gg_error *err)
{
  GG_TRY(gg_plot_format(picture, format, png, err));
  GG_TRY(gg_base_atomic_check_writable(picture, GG_PICTURES_ARE, err));
  return gg_plot_gnuplot_is_there(err);
}

static void draw_run(FILE *s, const gg_stored_result *stored, const gg_stored_engine *e, bool png)
{
  bool stresses = gg_plot_has_stresses(e);
  gg_plot_start_page(s, stored, png, stresses ? 1000 : 560, 440);
  gg_plot_relaxation(s, e, (gg_panel){stresses ? 0.085 : 0.15, stresses ? 0.455 : 0.88, 0.15, 0.80});
  if (stresses) gg_plot_stresses(s, e, (gg_panel){0.585, 0.94, 0.15, 0.80});
  fprintf(s, "unset multiplot\n");
}

/* The engines' relaxation side by side, between two heights of the page. */
static void draw_both(FILE *s, const gg_stored_result *stored, double bottom, double top)
{
  const gg_stored_engine *md = &stored->engine[GG_MD], *dsmc = &stored->engine[GG_DSMC];
  if (md->name) gg_plot_relaxation(s, md, (gg_panel){0.075, dsmc->name ? 0.475 : 0.965, bottom, top});
  if (dsmc->name) gg_plot_relaxation(s, dsmc, (gg_panel){md->name ? 0.575 : 0.075, 0.965, bottom, top});
}

static void draw_comparison(FILE *s, const gg_stored_result *stored, bool png)
{
  bool ratios = gg_plot_has(stored, true), differences = gg_plot_has(stored, false), either = ratios || differences;
  gg_plot_start_page(s, stored, png, 1100, either ? 820 : 440);
  double from = ratios ? 0.73 : 0.075, to = differences ? 0.64 : 0.98;
  if (ratios) gg_plot_ratios(s, stored, (gg_panel){0.075, to, 0.53, 0.85});
  if (differences) gg_plot_differences(s, stored, (gg_panel){from, 0.98, 0.53, 0.85});
  draw_both(s, stored, either ? 0.085 : 0.15, either ? 0.38 : 0.80);
  fprintf(s, "unset multiplot\n");
}

static gg_status draw(const gg_stored_result *stored, const char *picture, bool png, gg_error *err)
{
  char *script = NULL;
  FILE *s = gg_base_memory_stream_open(&script);
  if (!s) return gg_base_out_of_memory(err);
  locale_t before = gg_base_c_locale_enter();
  if (stored->comparison)
    draw_comparison(s, stored, png);
  else
    draw_run(s, stored, &stored->engine[stored->engine[GG_MD].name ? GG_MD : GG_DSMC], png);
  gg_base_c_locale_leave(before);
  gg_status status = GG_OK;
  if (!gg_base_memory_stream_close(s, &script)) status = gg_base_out_of_memory(err);
  if (status == GG_OK) status = gg_plot_gnuplot_run(script, NULL, picture, err);
  free(script);
  return status;
}

gg_status gg_plot_result(const gg_stored_result *stored, const char *picture, const char *format, gg_error *err)
{
  bool png;
  GG_TRY(gg_plot_format(picture, format, &png, err));
  return draw(stored, picture, png, err);
}
