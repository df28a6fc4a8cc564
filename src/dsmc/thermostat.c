#include "dsmc/thermostat.h"

#include "dsmc/kernel/kernels.h"
#include "dsmc/parallel/segments.h"

enum { RUN = 64 }; /* blocks looked at together */

static void add_squares(const gg_block *c, size_t n, double drift, double lane[GG_LANES])
{
  for (size_t b = 0; b < n; b++)
    for (int l = 0; l < GG_LANES; l++) {
      double x = c[b].x[l] - drift * c[b].y[l];
      lane[l] += x * x + c[b].y[l] * c[b].y[l] + c[b].z[l] * c[b].z[l];
    }
}

typedef struct looking {
  const gg_ensemble *e;
  double drift;
  double lane[GG_MOST_SEGMENTS][GG_MAX_SPECIES][GG_LANES]; /* sums of C^2 */
} looking;

static void look_at_segment(void *context, int part)
{
  looking *w = context;
  const int segment = gg_segment_in(w->e->segments, w->e->halves, part);
  for (int i = 0; i < w->e->n_species; i++) {
    const gg_population *p = &w->e->of[i];
    gg_range r = gg_segment(p, w->e->segments, segment);
    double lane[GG_LANES] = {0};
    for (size_t done = 0; done < r.n; done += RUN) {
      const size_t n = r.n - done < RUN ? r.n - done : RUN;
      gg_block room[RUN];
      add_squares(gg_blocks_in_double(p, p->c, r.first + done, n, room), n, w->drift, lane);
    }
    for (int l = 0; l < GG_LANES; l++) w->lane[segment][i][l] = lane[l];
  }
}

/* Twice the kinetic energy. */
static double vis_viva(const gg_ensemble *e, double drift)
{
  looking w = {.e = e, .drift = drift};
  gg_crew_share(e->crew, e->segments, look_at_segment, &w);
  double sum = 0;
  for (int i = 0; i < e->n_species; i++) {
    double all = 0;
    for (int segment = 0; segment < e->segments; segment++)
      for (int l = 0; l < GG_LANES; l++) all += w.lane[segment][i][l];
    sum += e->of[i].mass * all;
  }
  return sum;
}

double gg_thermostat_return(gg_ensemble *e, double drift, double missing, double half)
{
  double energy = 0.5 * vis_viva(e, drift);
  /* The loss goes as T^(3/2), and the second half is hotter than the first by what it destroyed. */
  double advance = half * (1 + 1.5 * half / energy);
  double gain = (missing + advance) / energy, factor = gain > -1 ? sqrt(1 + gain) : 0;
  gg_ensemble_heat(e, factor);
  return advance;
}

typedef struct kicking {
  gg_ensemble *e;
  double drift, size;
  gg_rng_lanes *lanes;
} kicking;

static void kick_segment(void *context, int part)
{
  const kicking *w = context;
  const int segment = gg_segment_in(w->e->segments, w->e->halves, part);
  for (int i = 0; i < w->e->n_species; i++) {
    gg_population *p = &w->e->of[i];
    gg_range r = gg_segment(p, w->e->segments, segment);
    w->e->kernels->kicks(gg_blocks_at(p, p->c, r.first), p->single, p->top + r.first, r.n, w->drift, w->size,
                         w->e->top_unit, &w->lanes[segment]);
    if (segment < w->e->segments - 1) continue;
    for (size_t a = (size_t)p->n; a < p->n_blocks * GG_LANES; a++)
      gg_block_set(p, p->c, (uint32_t)a, (gg_vec){0, 0, 0});
  }
}

void gg_thermostat_kick(gg_ensemble *e, double drift, double variance, gg_rng_lanes *lanes)
{
  gg_crew_share(e->crew, e->segments, kick_segment, &(kicking){e, drift, sqrt(variance), lanes});
  e->top_drift = drift;
}
