/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "theory/rough/functions.h"

#include <stdlib.h>

#include "base/memory.h"

static int cell(int degree, const int r[3])
{
  return (r[0] * (degree + 1) + r[1]) * (degree + 1) + r[2];
}

static void number_three(gg_rough_functions *f)
{
  int n = 0;
  for (int k = 0; k <= f->degree; k++)
    for (int x = k; x >= 0; x--)
      for (int y = k - x; y >= 0; y--) {
        int r[3] = {x, y, k - x - y};
        f->place3[cell(f->degree, r)] = n;
        for (int i = 0; i < 3; i++) f->three[n][i] = r[i];
        n++;
      }
}

static void number_all(gg_rough_functions *f)
{
  for (int s = 0; s < f->n3; s++) {
    const int *spin = f->three[s];
    int remaining = f->degree - spin[0] - spin[1] - spin[2];
    f->from[s] = f->n;
    for (int v = 0; v < gg_rough_count3(remaining); v++) {
      const int *c = f->three[v];
      f->function[f->n++] = (gg_rough_index){{c[0], c[1], c[2], spin[0], spin[1], spin[2]}};
    }
  }
  f->from[f->n3] = f->n;
}

static void find_neighbours(gg_rough_functions *f)
{
  for (int q = 0; q < f->n; q++)
    for (int i = 0; i < GG_ROUGH_AXES; i++) {
      gg_rough_index more = f->function[q], less = more;
      more.r[i]++, less.r[i]--;
      f->up[q][i] = gg_rough_place(f, more.r);
      f->down[q][i] = gg_rough_place(f, less.r);
    }
}

static void order_by_degree(gg_rough_functions *f)
{
  int n = 0;
  for (int k = 0; k <= f->degree; k++) {
    f->upto[k] = n;
    for (int q = 0; q < f->n; q++)
      if (gg_rough_degree(f->function[q]) == k) f->by_degree[n++] = q;
  }
  f->upto[f->degree + 1] = n;
}

int gg_rough_place(const gg_rough_functions *f, const int r[GG_ROUGH_AXES])
{
  int total = 0;
  for (int i = 0; i < GG_ROUGH_AXES; i++) {
    if (r[i] < 0) return -1;
    total += r[i];
  }
  if (total > f->degree) return -1;
  return f->from[f->place3[cell(f->degree, r + 3)]] + f->place3[cell(f->degree, r)];
}

gg_status gg_rough_functions_make(gg_rough_functions *f, int degree, gg_error *err)
{
  size_t n = 1, side = (size_t)degree + 1;
  for (int i = 1; i <= GG_ROUGH_AXES; i++) n = n * (size_t)(degree + i) / (size_t)i;
  *f = (gg_rough_functions){.degree = degree, .n3 = gg_rough_count3(degree)};
  f->function = malloc(n * sizeof *f->function);
  f->by_degree = malloc(n * sizeof *f->by_degree);
  f->up = malloc(n * sizeof *f->up);
  f->down = malloc(n * sizeof *f->down);
  f->three = malloc((size_t)f->n3 * sizeof *f->three);
  f->from = malloc((size_t)(f->n3 + 1) * sizeof *f->from);
  f->place3 = malloc(side * side * side * sizeof *f->place3);
  if (!f->function || !f->by_degree || !f->up || !f->down || !f->three || !f->from || !f->place3) {
    gg_rough_functions_clear(f);
    return gg_base_out_of_memory(err);
  }
  number_three(f);
  number_all(f);
  find_neighbours(f);
  order_by_degree(f);
  return GG_OK;
}

void gg_rough_functions_clear(gg_rough_functions *f)
{
  free(f->function);
  free(f->by_degree);
  free(f->up);
  free(f->down);
  free(f->three);
  free(f->from);
  free(f->place3);
  *f = (gg_rough_functions){0};
}
