/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Format and width of a picture. */
#include <stdlib.h>
#include <string.h>

#include "io/atomic_file.h"
#include "plot/plot.h"

static const char *const formats[] = {
    [GG_PLOT_SVG] = "svg", [GG_PLOT_PNG] = "png", [GG_PLOT_PDF] = "pdf", [GG_PLOT_GP] = "gp"};
enum { N_FORMATS = sizeof formats / sizeof *formats };

static int find(const char *name)
{
  int i = 0;
  while (i < N_FORMATS && strcmp(formats[i], name) != 0) i++;
  return i;
}

static gg_status choose_format(gg_plot_paper *paper, const char *picture, const char *format, gg_error *err)
{
  const char *slash = strrchr(picture, '/'), *name = slash ? slash + 1 : picture, *dot = strrchr(name, '.');
  const char *ending = dot && dot > name ? dot + 1 : NULL;
  if (!*name) return GG_REFUSE(err, "'%s': a picture needs a name, .svg, .png, .pdf or .gp", picture);
  if (format && find(format) == N_FORMATS)
    return GG_REFUSE(err, "pictures are svg, png, pdf or gp, not '%.20s'", format);
  if (!ending && !format) return GG_REFUSE(err, "%s: a picture's name ends with .svg, .png, .pdf or .gp", picture);
  if (ending && find(ending) == N_FORMATS)
    return GG_REFUSE(err, "%s: pictures are .svg, .png, .pdf or .gp, not .%.20s", picture, ending);
  if (ending && format && strcmp(ending, format) != 0)
    return GG_REFUSE(err, "%s: is to be %s, and its name says %s", picture, format, ending);
  paper->format = (gg_plot_format)find(ending ? ending : format);
  return GG_OK;
}

/* Letters of 12 pixels in the layout are 8 points on paper. */
static gg_status choose_width(gg_plot_paper *paper, const char *width, gg_error *err)
{
  static const struct {
    const char *name;
    double points;
  } units[] = {{"mm", 72 / 25.4}, {"cm", 72 / 2.54}, {"in", 72}, {"pt", 1}};
  static const double least = 40 * 72 / 25.4, most = 1000 * 72 / 25.4;
  char *end;
  double points = 0, number = strtod(width, &end);
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (end > width && strcmp(end, units[i].name) == 0) points = number * units[i].points;
  if (!(points >= least * 0.999 && points <= most * 1.001))
    return GG_REFUSE(
        err, "'%.40s' is no width of a picture: a number with mm, cm, in or pt, from 40mm to 1000mm, e.g. 86mm", width);
  paper->width = points * 12 / 8;
  return GG_OK;
}

gg_status gg_plot_paper_choose(gg_plot_paper *paper, const char *picture, const char *format, const char *width,
                               gg_error *err)
{
  *paper = (gg_plot_paper){.format = GG_PLOT_SVG};
  GG_TRY(choose_format(paper, picture, format, err));
  return width ? choose_width(paper, width, err) : GG_OK;
}

gg_status gg_plot_paper_check(const char *picture, const char *width, gg_error *err)
{
  gg_plot_paper paper;
  GG_TRY(gg_plot_paper_choose(&paper, picture, NULL, width, err));
  GG_TRY(gg_io_atomic_check_writable(picture, GG_PICTURES_ARE, err));
  return paper.format == GG_PLOT_GP ? GG_OK : gg_plot_gnuplot_is_there(err);
}

char *gg_plot_page_name(const char *picture, const char *engine, const char *group, const gg_plot_paper *paper)
{
  char *name = NULL;
  const char *dot = strrchr(picture, '.'), *format = formats[paper->format];
  size_t stem = dot && dot > picture && find(dot + 1) < N_FORMATS ? (size_t)(dot - picture) : strlen(picture);
  int written = asprintf(&name, "%.*s_%s%s%s.%s", (int)stem, picture, engine, *engine ? "_" : "", group, format);
  return written < 0 ? NULL : name;
}
