/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Starts that no scene asks for: grains that touch, grains at rest, and what is no number. A new one is a function that
 * changes a fresh simulation, and its row. */
#include <math.h>

#include "corner.h"
#include "dsmc/dsmc.h"
#include "md/start/start.h"

/* To another place, with its peculiar velocity. */
static void put(gg_md *e, uint32_t i, gg_vec r)
{
  gg_md_grain *g = &e->grain[i];
  g->v.x += e->model.shear_rate * (r.y - g->r.y);
  g->r = r;
}

/* A cube of grains that touch their neighbours, the box around it empty. */
static void touch(gg_md *e)
{
  const uint32_t side = (uint32_t)ceil(cbrt(e->n));
  for (uint32_t i = 0; i < e->n; i++) put(e, i, (gg_vec){1 + i % side, 1 + i / side % side, 1 + i / (side * side)});
}

/* Pairs that touch, in any direction; the pairs stand apart. */
static void pair_up(gg_md *e)
{
  const uint32_t side = (uint32_t)ceil(cbrt(0.5 * e->n));
  const double apart = e->box.edge[0] / side;
  gg_rng rng = gg_common_rng_seed(1, 0);
  for (uint32_t i = 0; i < e->n; i++) {
    const uint32_t at = i / 2;
    const gg_vec site = {at % side * apart, at / side % side * apart, at / (side * side) * apart};
    put(e, i, i % 2 ? gg_add(e->grain[i - 1].r, gg_rng_direction(&rng)) : gg_axpy(1, (gg_vec){1, 1, 1}, site));
  }
}

static void rest(gg_md *e)
{
  for (uint32_t i = 0; i < e->n; i++) {
    e->grain[i].v = (gg_vec){e->model.shear_rate * (e->grain[i].r.y - 0.5 * e->box.edge[1]), 0, 0};
    if (e->spin) e->spin[i] = (gg_vec){0, 0, 0};
  }
}

static void rest_in_dsmc(gg_dsmc *d)
{
  gg_dsmc_ensemble_scale(&d->ensemble, 0);
  gg_dsmc_synchronise(d);
}

static void at_rest(gg_simulation *g)
{
  if (g->model.ensemble) {
    rest_in_dsmc((gg_dsmc *)g->engine);
    return;
  }
  rest((gg_md *)g->engine);
  (void)gg_md_begin((gg_md *)g->engine, NULL);
}

static void touching(gg_simulation *g)
{
  touch((gg_md *)g->engine);
  (void)gg_md_begin((gg_md *)g->engine, NULL);
}

static void touching_at_rest(gg_simulation *g)
{
  touch((gg_md *)g->engine);
  at_rest(g);
}

static void pairs_at_rest(gg_simulation *g)
{
  pair_up((gg_md *)g->engine);
  at_rest(g);
}

/* Two grains come in on the others, along rows of them, from both sides. */
static void cradle(gg_simulation *g)
{
  gg_md *e = (gg_md *)g->engine;
  touch(e);
  rest(e);
  const uint32_t last = e->n - 1;
  e->grain[0].r.x -= 0.5, e->grain[last].r.x += 0.5;
  e->grain[0].v.x = 1, e->grain[last].v.x = -1;
  (void)gg_md_begin(e, NULL);
}

static void nan_velocity(gg_simulation *g)
{
  gg_dsmc *d = (gg_dsmc *)g->engine;
  if (!g->model.ensemble)
    ((gg_md *)g->engine)->grain[1].v.y = NAN;
  else
    gg_dsmc_block_set(&d->ensemble.of[0], d->ensemble.of[0].c, 1, (gg_vec){0, NAN, 0});
}

static void nan_spin(gg_simulation *g)
{
  gg_dsmc *d = (gg_dsmc *)g->engine;
  if (!g->model.ensemble)
    ((gg_md *)g->engine)->spin[1].y = NAN;
  else
    gg_dsmc_block_set(&d->ensemble.of[0], d->ensemble.of[0].s, 1, (gg_vec){0, NAN, 0});
}

static void nan_place(gg_simulation *g)
{
  ((gg_md *)g->engine)->grain[1].r.x = NAN;
}

static const corner corners[] = {
    {.name = "touching, hot",
     .scene = "{flow: hcs, phi: 0.1, particles: 343, collision: {e: 0.9}}",
     .start = touching,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "touching, hot, e 0, beta 0",
     .scene = "{flow: hcs, phi: 0.1, particles: 343, collision: {e: 0, beta: 0}}",
     .start = touching,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "touching, sheared",
     .scene = "{flow: usf, phi: 0.1, particles: 343, collision: {e: 0.9, beta: 0}}",
     .start = touching,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "pairs touching and at rest, sheared",
     .scene = "{flow: usf, phi: 0.03, particles: 400, collision: {e: 0.9}}",
     .start = pairs_at_rest,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "pairs touching and at rest, sheared, e 0, friction",
     .scene = "{flow: usf, phi: 0.03, particles: 400, collision: {e: 0, beta: 0, mu: 0.3}}",
     .start = pairs_at_rest,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "touching, hot, e 1",
     .scene = "{flow: equilibrium, phi: 0.1, particles: 343}",
     .start = touching,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "touching and at rest, falls on a floor, elastic",
     .scene = "{flow: chute, phi: 0.2, particles: 343, gravity: [0, -1, 0], walls: {top: open, e: 1}, collision: {e: "
              "1}}",
     .start = touching_at_rest,
     .dsmc = NOT_RUN,
     .collisions = 300,
     .quick = true},
    {.name = "touching and at rest, falls on a floor",
     .scene = "{flow: chute, phi: 0.2, particles: 343, gravity: [0, -1, 0], walls: {top: open}, collision: {e: 0.5}}",
     .collisions = 300,
     .start = touching_at_rest,
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "a row of touching grains is hit, e 1",
     .scene = "{flow: equilibrium, phi: 0.1, particles: 343}",
     .start = cradle,
     .dsmc = NOT_RUN,
     .collisions = 20,
     .quick = true},
    {.name = "a row of touching grains is hit, e 0.9",
     .scene = "{flow: hcs, phi: 0.1, particles: 343, collision: {e: 0.9}}",
     .start = cradle,
     .dsmc = NOT_RUN,
     .collisions = 20,
     .quick = true},
    {.name = "all at rest",
     .scene = "{flow: hcs, phi: 0.1, particles: 300}",
     .start = at_rest,
     .md = "do not meet",
     .dsmc = "the temperature left the range of double precision",
     .quick = true},
    {.name = "all at rest, sheared",
     .scene = "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.8}}",
     .start = at_rest,
     .dsmc = "the temperature left the range of double precision",
     .quick = true},
    {.name = "a velocity that is no number",
     .scene = "{flow: usf, phi: 0.1, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision",
     .quick = true},
    {.name = "a velocity that is no number, dense",
     .scene = "{flow: usf, phi: 0.49, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision",
     .quick = true},
    {.name = "a velocity that is no number, dilute, cooling",
     .scene = "{flow: hcs, phi: 0.01, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision",
     .quick = true},
    {.name = "a velocity that is no number, heated",
     .scene = "{flow: hss, phi: 0.1, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision",
     .quick = true},
    {.name = "a spin that is no number",
     .scene = "{flow: usf, phi: 0.1, particles: 300, collision: {beta: 0}}",
     .start = nan_spin,
     .md = "NaN or infinite",
     .dsmc = "range of double precision",
     .quick = true},
    {.name = "a spin that is no number, cooling",
     .scene = "{flow: hcs, phi: 0.1, particles: 300, collision: {beta: -0.9}}",
     .start = nan_spin,
     .md = "NaN or infinite",
     .dsmc = "range of double precision",
     .quick = true},
    {.name = "a place that is no number",
     .scene = "{flow: usf, phi: 0.1, particles: 300}",
     .start = nan_place,
     .md = "NaN or infinite",
     .dsmc = NOT_RUN,
     .quick = true},
    {.name = "a place that is no number, Couette",
     .scene = "{flow: couette, phi: 0.1, particles: 300}",
     .start = nan_place,
     .md = "NaN or infinite",
     .dsmc = NOT_RUN,
     .quick = true},
};

const corner_table corners_of_starts = {"starts", corners, sizeof corners / sizeof *corners};
