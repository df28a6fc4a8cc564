/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The snapshot page: grains are drawn at their positions, in both projections, to scale and in the colour of their
 * species. In a box without a top the page ends above the highest grain. A result without positions has no page. If
 * there are many grains, only a layer is drawn, so that no picture is large. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../files/planted.h"
#include "common/rng.h"
#include "graingas.h"
#include "plot/plot.h"
#include "scene/model_of_scene.h"

enum { GRAINS = 5, MOST = 64 };

static char folder[] = "/tmp/graingas-snapshot-XXXXXX";

static int enter(void **state)
{
  (void)state;
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
  (void)state;
  unlink("r.h5");
  unlink("r.svg");
  unlink("r.png");
  unlink("r.pdf");
  return chdir("/") == 0 ? rmdir(folder) : -1;
}

/* A disc or a frame of the page: its sides in pixels, y downwards. */
typedef struct shape {
  double left, right, top, bottom;
  int points, colour; /* red, 0 to 255 */
} shape;

typedef struct page {
  shape disc[MOST], frame[MOST];
  int discs, frames;
} page;

static shape shape_of(const char *points, char end)
{
  shape s = {.left = INFINITY, .right = -INFINITY, .top = INFINITY, .bottom = -INFINITY};
  double x, y;
  int used;
  while (*points != end && sscanf(points, " %*[ML]%n", &used) >= 0) {
    if (sscanf(points, " %lf,%lf%n", &x, &y, &used) != 2 && sscanf(points, " %*1[ML]%lf,%lf%n", &x, &y, &used) != 2)
      break;
    s.left = fmin(s.left, x), s.right = fmax(s.right, x);
    s.top = fmin(s.top, y), s.bottom = fmax(s.bottom, y);
    s.points++;
    points += used;
  }
  return s;
}

static char *read_text(const char *path)
{
  FILE *f = fopen(path, "r");
  assert_non_null(f);
  static char text[1 << 22];
  text[fread(text, 1, sizeof text - 1, f)] = 0;
  fclose(f);
  return text;
}

static double number(const char *element, const char *attribute)
{
  const char *at = strstr(element, attribute);
  double x = NAN;
  if (!at || at > strchr(element, '>') || sscanf(at + strlen(attribute), "%lf", &x) != 1)
    fail_msg("no %s in %.60s", attribute, element);
  return x;
}

/* A panel is an <svg> in diameters, y upwards, that lies over gnuplot's page; its discs are uses of circles g0, g1. */
static void read_discs(page *p, const char *text, const char *panel)
{
  double x0 = number(panel, " x='"), y0 = number(panel, " y='"), wide = number(panel, "width='");
  double edge, top;
  assert_int_equal(sscanf(strstr(panel, "viewBox='"), "viewBox='0 0 %lf %lf'", &edge, &top), 2);
  double scale = wide / edge;
  assert_true(fabs(number(panel, "height='") / top / scale - 1) < 1e-3);
  const char *end = strstr(panel + 1, "</svg>");
  for (const char *at = panel; (at = strstr(at, "<use xlink:href='#g")) && at < end; at++) {
    char mark[32];
    snprintf(mark, sizeof mark, "<circle id='g%c'", at[19]);
    const char *circle = strstr(text, mark);
    assert_non_null(circle);
    double r = number(circle, "r='") * scale, x = x0 + number(at, "x='") * scale;
    double y = y0 + (top - number(at, "y='")) * scale;
    unsigned colour;
    assert_int_equal(sscanf(strstr(circle, "fill='#"), "fill='#%6x", &colour), 1);
    assert_true(p->discs < MOST);
    p->disc[p->discs++] = (shape){x - r, x + r, y - r, y + r, 0, (int)(colour >> 16)};
  }
}

/* Frames are gnuplot's closed paths of five points. */
static void read_page(page *p)
{
  *p = (page){.discs = 0};
  const char *text = read_text("r.svg");
  for (const char *at = text; (at = strstr(at, "\n<svg x='")); at++) read_discs(p, text, at + 1);
  for (const char *at = text; (at = strstr(at, "d='M")); at++) {
    shape s = shape_of(at + 3, '\'');
    if (s.points == 5 && s.right - s.left > 50 && s.bottom - s.top > 50 && p->frames < MOST) p->frame[p->frames++] = s;
  }
}

static gg_result *result_with(gg_flow flow, const double place[GRAINS][3])
{
  gg_result *r = planted_result(GG_MD);
  gg_scene *s = r->scene;
  s->flow = flow, s->phi = 0.02, s->particles = GRAINS, s->n_species = 2;
  s->species[0] = (gg_species){0.6, 1, 1, 0.4, 1, 0}, s->species[1] = (gg_species){0.4, 1.5, 2, 0.4, 1, 0};
  s->aspect[0] = 1, s->aspect[1] = 2, s->aspect[2] = 1.5;
  if (flow == GG_CHUTE) s->walls.top = GG_OPEN_TOP, s->gravity[1] = -1;
  gg_error err = {0};
  if (gg_scene_model_make(s, GG_MD, &r->model, &err) != GG_OK) fail_msg("%s", err.message);
  gg_frame *f = &r->final;
  f->n = GRAINS;
  f->species = calloc(GRAINS, 1);
  for (size_t i = 0; i < GRAINS; i++) {
    f->id[i] = (int64_t)i;
    f->species[i] = i % 2; /* in no order */
    for (int a = 0; a < 3; a++) f->position[3 * i + (size_t)a] = place[i][a];
  }
  return r;
}

static bool draw_as(gg_result *r, gg_plot_format format)
{
  gg_error err = {0};
  gg_stored_result stored;
  bool drawn = false;
  if (gg_result_write(r, "r.h5", NULL, NULL, &err) != GG_OK) fail_msg("%s", err.message);
  if (gg_files_stored_result_read(&stored, "r.h5", &err) != GG_OK) fail_msg("%s", err.message);
  const char *picture = format == GG_PLOT_PNG ? "r.png" : format == GG_PLOT_PDF ? "r.pdf" : "r.svg";
  const gg_plot_paper paper = {.format = format};
  if (gg_plot_snapshot_draw(&stored, &paper, picture, &drawn, &err) != GG_OK) fail_msg("%s", err.message);
  gg_files_stored_result_clear(&stored);
  return drawn;
}

static bool draw(gg_result *r)
{
  return draw_as(r, GG_PLOT_SVG);
}

/* Every grain's disc in the panel whose frame is `f` and whose horizontal axis is `along`. */
static void expect_grains(const page *p, shape f, const double place[GRAINS][3], int along, double edge, double top)
{
  double scale = (f.right - f.left) / edge;
  assert_true(fabs((f.bottom - f.top) / top / scale - 1) < 0.01); /* circles stay circles */
  for (int i = 0; i < GRAINS; i++) {
    double x = f.left + scale * place[i][along], y = f.bottom - scale * place[i][1], radius = i % 2 ? 0.75 : 0.5;
    int found = 0;
    for (int k = 0; k < p->discs; k++) {
      const shape *d = &p->disc[k];
      found +=
          fabs(0.5 * (d->left + d->right) - x) < 0.01 * scale && fabs(0.5 * (d->top + d->bottom) - y) < 0.01 * scale &&
          fabs(d->right - d->left - 2 * radius * scale) < 0.02 * scale &&
          fabs(d->bottom - d->top - 2 * radius * scale) < 0.02 * scale && d->colour == (i % 2 ? 128 + 213 / 2 : 128);
    }
    if (found != 1) fail_msg("grain %d: %d discs at (%.1f, %.1f)", i, found, x, y);
  }
}

/* The leftmost and rightmost of the frames, which may be drawn more than once. */
static void panels(const page *p, shape *left, shape *right)
{
  assert_true(p->frames >= 2);
  *left = *right = p->frame[0];
  for (int k = 0; k < p->frames; k++) {
    if (p->frame[k].left < left->left) *left = p->frame[k];
    if (p->frame[k].left > right->left) *right = p->frame[k];
  }
  assert_true(left->right < right->left);
}

static void grains_where_they_are(void **state)
{
  (void)state;
  const double place[GRAINS][3] = {{1, 2, 1.5}, {3, 1.2, 2}, {2.2, 5, 4.1}, {1.3, 6.5, 3}, {3.1, 7.9, 5}};
  gg_result *r = result_with(GG_USF, place);
  const double *L = r->model.box;
  assert_true(L[0] > 4 && L[1] > 8.1 && L[2] > 6);
  assert_true(draw(r));
  page p;
  shape left, right;
  read_page(&p);
  panels(&p, &left, &right);
  assert_int_equal(p.discs, 2 * GRAINS);
  expect_grains(&p, left, place, 0, L[0], L[1]);
  expect_grains(&p, right, place, 2, L[2], L[1]);
  const char *text = read_text("r.svg"); /* the legend of the mixture */
  assert_non_null(strstr(text, "species 1: σ = 1, m = 1"));
  assert_non_null(strstr(text, "species 2: σ = 1.5, m = 2"));
  gg_result_free(r);
}

/* Grains on a floor are shown up to a diameter above the highest grain. */
static void below_an_open_top(void **state)
{
  (void)state;
  const double place[GRAINS][3] = {{1, 0.5, 1.5}, {3, 0.75, 2}, {2.2, 0.5, 4.1}, {1.3, 0.75, 3}, {3.1, 2, 5}};
  gg_result *r = result_with(GG_CHUTE, place);
  const double *L = r->model.box;
  assert_true(L[1] > 6);
  assert_true(draw(r));
  page p;
  shape left, right;
  read_page(&p);
  panels(&p, &left, &right);
  expect_grains(&p, left, place, 0, L[0], 3);
  expect_grains(&p, right, place, 2, L[2], 3);
  gg_result_free(r);
}

/* n grains at random in the box: a gas of solid fraction phi, with half of its volume in grains half as large if
 * `mixed`.
 */
static gg_result *gas_of(size_t n, double phi, bool mixed)
{
  gg_result *r = planted_result(GG_MD);
  gg_scene *s = r->scene;
  s->flow = GG_USF, s->phi = phi, s->particles = (int64_t)n;
  if (mixed)
    s->n_species = 2, s->species[0] = (gg_species){0.5, 1, 1, 0.4, 1, 0},
    s->species[1] = (gg_species){0.5, 0.5, 1, 0.4, 1, 0};
  gg_error err = {0};
  if (gg_scene_model_make(s, GG_MD, &r->model, &err) != GG_OK) fail_msg("%s", err.message);
  gg_frame *f = &r->final;
  gg_rng rng = gg_common_rng_seed(1, 0);
  gg_measure_frame_free(f);
  *f = (gg_frame){.time = 1,
                  .step = 100,
                  .n = n,
                  .position = calloc(3 * n, sizeof(double)),
                  .velocity = calloc(3 * n, sizeof(double)),
                  .spin = calloc(3 * n, sizeof(double)),
                  .id = calloc(n, sizeof(int64_t)),
                  .species = calloc(n, 1)};
  for (size_t i = 0; i < n; i++) {
    f->id[i] = (int64_t)i;
    f->species[i] = mixed && i % 2;
    for (size_t a = 0; a < 3; a++) f->position[3 * i + a] = gg_rng_uniform(&rng) * r->model.box[a];
  }
  return r;
}

static long size_of(const char *path)
{
  struct stat file;
  assert_int_equal(stat(path, &file), 0);
  return (long)file.st_size;
}

/* Pictures are below 500 kB for any number of grains, dilute or dense, large or small, and show enough grains. */
static void pictures_are_small(void **state)
{
  (void)state;
  static const struct {
    size_t n;
    double phi;
    bool mixed;
  } gas[] = {{1000, 0.01, false}, {1000, 0.5, false}, {1000, 0.3, true}, {100000, 0.01, false}, {100000, 0.5, true}};
  for (size_t k = 0; k < sizeof gas / sizeof *gas; k++) {
    gg_result *r = gas_of(gas[k].n, gas[k].phi, gas[k].mixed);
    assert_true(draw_as(r, GG_PLOT_SVG) && draw_as(r, GG_PLOT_PNG) && draw_as(r, GG_PLOT_PDF));
    if (size_of("r.svg") >= 500000 || size_of("r.png") >= 500000 || size_of("r.pdf") >= 500000)
      fail_msg("%zu grains at %g: %ld, %ld and %ld bytes", gas[k].n, gas[k].phi, size_of("r.svg"), size_of("r.png"),
               size_of("r.pdf"));
    const char *text = read_text("r.svg");
    size_t discs = 0;
    for (const char *at = text; (at = strstr(at, "<use xlink:href='#g")); at++) discs++;
    if (discs < 2 * 100) fail_msg("%zu grains at %g: only %zu drawn", gas[k].n, gas[k].phi, discs);
    gg_result_free(r);
  }
}

static void no_positions(void **state)
{
  (void)state;
  gg_result *r = planted_result(GG_DSMC);
  assert_false(draw(r));
  gg_result_free(r);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(grains_where_they_are),
      cmocka_unit_test(below_an_open_top),
      cmocka_unit_test(pictures_are_small),
      cmocka_unit_test(no_positions),
  };
  return cmocka_run_group_tests(tests, enter, leave);
}
