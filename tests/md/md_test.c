#include "md_test.h"

#include <stdlib.h>
#include <string.h>

gg_scene md_scene(md_case c)
{
  gg_scene s = gg_scene_defaults();
  s.flow = c.flow;
  s.particles = c.n;
  s.phi = c.phi;
  for (int p = 0; p < GG_PAIRS; p++) {
    s.collision.e[p] = c.e;
    s.collision.beta[p] = c.beta;
    s.collision.mu[p] = c.mu;
  }
  for (int a = 0; a < 3; a++) s.aspect[a] = c.aspect[a] > 0 ? c.aspect[a] : 1;
  return s;
}

gg_model md_model(md_case c)
{
  gg_scene s = md_scene(c);
  gg_model m;
  gg_error err = {0};
  if (gg_model_make(&s, GG_MD, &m, &err) != GG_OK) fail_msg("%s", err.message);
  return m;
}

gg_md *md_create(const gg_model *model, uint64_t seed)
{
  gg_engine *engine = NULL;
  gg_error err = {0};
  if (gg_md_ops.create(model, seed, 0, &engine, &err) != GG_OK) fail_msg("%s", err.message);
  return (gg_md *)engine;
}

void md_destroy(gg_md *e)
{
  gg_md_ops.destroy(&e->base);
}

double md_collide(gg_md *e, uint64_t collisions)
{
  double elapsed;
  gg_error err = {0};
  if (gg_md_ops.advance(&e->base, INFINITY, collisions, &elapsed, &err) != GG_OK) fail_msg("%s", err.message);
  return elapsed;
}

/* FNV-1a. */
static uint64_t mix(uint64_t h, const void *data, size_t bytes)
{
  const uint8_t *p = data;
  for (size_t k = 0; k < bytes; k++) h = (h ^ p[k]) * 0x100000001b3u;
  return h;
}

uint64_t md_hash(const gg_md *e)
{
  uint64_t h = 0xcbf29ce484222325u;
  for (uint32_t i = 0; i < e->n; i++) {
    const gg_grain *g = &e->grain[i];
    h = mix(h, &g->r, sizeof g->r + sizeof g->v + sizeof g->t + sizeof g->stamp);
    h = mix(h, &e->node[i].time, 2 * sizeof(double));
    if (e->spin) h = mix(h, &e->spin[i], sizeof e->spin[i]);
  }
  h = mix(h, &e->k.now, sizeof e->k.now);
  return mix(h, &e->k.collisions, sizeof e->k.collisions);
}

typedef struct separation {
  long double r[3], v[3]; /* of j from i, nearest box, and how images above move */
  long double offset, slide;
} separation;

static separation separate(const gg_md *e, uint32_t i, uint32_t j)
{
  const gg_grain *a = &e->grain[i], *b = &e->grain[j];
  separation s = {.slide = e->box.slide, .offset = e->box.offset0 + (long double)e->box.slide * e->k.now};
  for (int k = 0; k < 3; k++) {
    s.v[k] = (long double)gg_along(&b->v, k) - gg_along(&a->v, k);
    s.r[k] = ((long double)gg_along(&b->r, k) + gg_along(&b->v, k) * ((long double)e->k.now - b->t)) -
             ((long double)gg_along(&a->r, k) + gg_along(&a->v, k) * ((long double)e->k.now - a->t));
  }
  return s;
}

static long double contact(const long double r[3], const long double v[3], long double sigma)
{
  long double a = 0, b = 0, c = -sigma * sigma;
  for (int k = 0; k < 3; k++) a += v[k] * v[k], b += r[k] * v[k], c += r[k] * r[k];
  long double q = b * b - a * c;
  if (b >= 0 || q < 0) return INFINITY;
  long double t = (-b - sqrtl(q)) / a;
  return t > 0 ? t : 0;
}

long double md_oracle_pair(const gg_md *e, uint32_t i, uint32_t j, double horizon)
{
  separation s = separate(e, i, j);
  int o = 2 * gg_species_of(&e->grain[i]) + gg_species_of(&e->grain[j]);
  long double first = INFINITY, sigma = e->model.sigma[o], L[3];
  for (int k = 0; k < 3; k++) L[k] = e->box.edge[k];
  int ny = 2 + (int)(fabsl(s.v[1]) * horizon / L[1]), nz = 2 + (int)(fabsl(s.v[2]) * horizon / L[2]);
  for (int y = -ny; y <= ny; y++)
    for (int z = -nz; z <= nz; z++) {
      long double v[3] = {s.v[0] + y * s.slide, s.v[1], s.v[2]}, x0 = s.r[0] + y * s.offset;
      /* Images along x that pass within reach before the horizon. */
      long double span = fabsl(v[0]) * horizon + sigma + L[0];
      for (long long x = (long long)((-span - x0) / L[0]) - 1; x <= (long long)((span - x0) / L[0]) + 1; x++) {
        long double r[3] = {x0 + x * L[0], s.r[1] + y * L[1], s.r[2] + z * L[2]}, t = contact(r, v, sigma);
        if (t < first) first = t;
      }
    }
  return first <= horizon ? first : INFINITY;
}

md_forecast md_oracle(const gg_md *e, double horizon)
{
  md_forecast f = {.time = INFINITY};
  for (uint32_t i = 0; i < e->n; i++)
    for (uint32_t j = 0; j < i; j++) {
      long double t = md_oracle_pair(e, i, j, horizon);
      if (t < f.time) f = (md_forecast){t, {j, i}};
    }
  return f;
}

long double md_closest(const gg_md *e)
{
  long double closest = INFINITY;
  for (uint32_t i = 0; i < e->n; i++)
    for (uint32_t j = 0; j < i; j++) {
      separation s = separate(e, i, j);
      int o = 2 * gg_species_of(&e->grain[i]) + gg_species_of(&e->grain[j]);
      long double y = rintl(s.r[1] / e->box.edge[1]),
                  r[3] = {s.r[0] - y * s.offset, s.r[1] - y * e->box.edge[1], s.r[2]};
      r[0] -= e->box.edge[0] * rintl(r[0] / e->box.edge[0]);
      r[2] -= e->box.edge[2] * rintl(r[2] / e->box.edge[2]);
      long double d = sqrtl(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / e->model.sigma[o];
      if (d < closest) closest = d;
    }
  return closest;
}

gg_vec md_momentum(const gg_md *e)
{
  gg_vec sum = {0, 0, 0};
  for (uint32_t i = 0; i < e->n; i++) {
    gg_vec r = gg_position(&e->grain[i], e->k.now), c = e->grain[i].v;
    c.x -= e->model.shear_rate * (r.y - 0.5 * e->box.edge[1]);
    sum = gg_axpy(e->model.mass[gg_species_of(&e->grain[i])], c, sum);
  }
  return sum;
}

double md_energy(const gg_md *e)
{
  double sum = 0;
  for (uint32_t i = 0; i < e->n; i++) {
    int s = gg_species_of(&e->grain[i]);
    double m = e->model.mass[s], K = e->model.inertia[s];
    sum += 0.5 * m * gg_dot(e->grain[i].v, e->grain[i].v);
    if (e->spin) sum += 0.5 * K * m * gg_dot(e->spin[i], e->spin[i]);
  }
  return sum;
}
