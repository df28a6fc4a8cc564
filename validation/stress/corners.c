/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of corners: scenes at the ends of what keys allow. A row with a subject begins a section. Some rows change
 * the fresh simulation first (`start`): grains that touch, grains at rest, NaN. */
#include <math.h>

#include "corner.h"
#include "dsmc/dsmc.h"
#include "md/start/start.h"

/* Move a grain, with its peculiar velocity. */
static void put(gg_md *e, uint32_t i, gg_vec r)
{
  gg_md_grain *g = &e->grain[i];
  g->v.x += e->model.shear_rate * (r.y - g->r.y);
  g->r = r;
}

/* Pack all grains into a cube in which neighbours touch; the rest of the box is empty. */
static void touch(gg_md *e)
{
  const uint32_t side = (uint32_t)ceil(cbrt(e->n));
  for (uint32_t i = 0; i < e->n; i++) put(e, i, (gg_vec){1 + i % side, 1 + i / side % side, 1 + i / (side * side)});
}

/* Place grains as touching pairs in random directions; pairs do not touch each other. */
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

/* Newton's cradle: two grains hit the rows of touching grains from both sides. */
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

#define USF(phi, collision) "{flow: usf, phi: " phi ", particles: 300, collision: {" collision "}}"
#define HCS(phi, collision) "{flow: hcs, phi: " phi ", particles: 300, collision: {" collision "}}"
#define SOLID(phi, K, collision)                                                                                       \
  "{flow: usf, phi: " phi ", particles: 300, species: [{fraction: 1, inertia: " K "}], collision: {" collision "}}"
/* Run length for comparisons of means: all of them together take a minute. */
#define MEANS(flow, phi, collision)                                                                                    \
  "{flow: " flow ", phi: " phi ", particles: 1000, collision: {" collision "}, run: {collisions: 600, warmup: 100}}"
#define MD_NEEDS_ROOM "a grain would meet two images of another"
#define TWO(flow, phi, n, collision, two)                                                                              \
  "{flow: " flow ", phi: " phi ", particles: " n ", collision: {" collision                                            \
  "}, species: [{fraction: 0.5}, {fraction: 0.5, " two "}]}"
#define HEAVY "mass: 1e6"
#define LARGE "diameter: 10, mass: 1000"

const corner corners[] = {
    {.subject = "contacts"}, /* e, beta, mu, K at the ends of their ranges */
    {.name = "e 0, sheared", .scene = USF("0.1", "e: 0")},
    {.name = "e 0, cooling", .scene = HCS("0.1", "e: 0"), .collisions = 200},
    {.name = "e 0, beta -1, sheared at phi 0.49", .scene = USF("0.49", "e: 0, beta: -1")},
    {.name = "e 0, beta 0, sheared at phi 0.49", .scene = USF("0.49", "e: 0, beta: 0")},
    {.name = "e 0, beta 1, cooling", .scene = HCS("0.1", "e: 0, beta: 1")},
    {.name = "e 0.01, sheared", .scene = USF("0.1", "e: 0.01")},
    {.name = "e 0.01, cooling at phi 0.49", .scene = HCS("0.49", "e: 0.01")},
    {.name = "e 0.01, rough, Boltzmann limit", .scene = USF("0", "e: 0.01, beta: 0"), .md = "phi > 0"},
    {.name = "e 1, sheared: heats without end", .scene = USF("0.1", "e: 1"), .collisions = 300},
    {.name = "e 1, beta 1, sheared", .scene = USF("0.1", "e: 1, beta: 1"), .collisions = 300},
    {.name = "e 1, beta 1, at rest", .scene = HCS("0.2", "e: 1, beta: 1")},
    {.name = "e 1, beta 0, sheared", .scene = USF("0.1", "e: 1, beta: 0")},
    {.name = "e -0.1", .scene = USF("0.1", "e: -0.1"), .refused = "a number from 0 to 1"},
    {.name = "beta -0.999999, sheared", .scene = USF("0.1", "beta: -0.999999")},
    {.name = "beta -0.999999, cooling", .scene = HCS("0.1", "beta: -0.999999"), .collisions = 300},
    {.name = "beta 0, sheared at phi 0.49", .scene = USF("0.49", "e: 0.9, beta: 0")},
    {.name = "beta 1, sheared at phi 0.49", .scene = USF("0.49", "e: 0.9, beta: 1")},
    {.name = "beta -1.1", .scene = USF("0.1", "beta: -1.1"), .refused = "a number from -1 to 1"},
    {.name = "mu 0", .scene = USF("0.1", "beta: 0, mu: 0")},
    {.name = "mu 1e-6, sheared", .scene = USF("0.1", "beta: 0, mu: 1e-6")},
    {.name = "mu 1e-6, beta 1, cooling", .scene = HCS("0.1", "beta: 1, mu: 1e-6")},
    {.name = "mu 1e6, sheared", .scene = USF("0.1", "beta: 0, mu: 1e6")},
    {.name = "mu 1e6, beta 1, e 0, phi 0.49", .scene = USF("0.49", "e: 0, beta: 1, mu: 1e6")},
    {.name = "mu -1", .scene = USF("0.1", "beta: 0, mu: -1"), .refused = "a number of at least 0"},
    {.name = "K 0", .scene = SOLID("0.1", "0", "beta: 0"), .refused = "a number from 1e-06 to 1"},
    {.name = "K 1e-6, sheared", .scene = SOLID("0.1", "1e-6", "beta: 0")},
    {.name = "K 1e-6, beta 1, e 0", .scene = SOLID("0.1", "1e-6", "e: 0, beta: 1")},
    {.name = "K 1e-6, friction", .scene = SOLID("0.1", "1e-6", "beta: 0.5, mu: 0.1")},
    {.name = "K 2/3, sheared at phi 0.49", .scene = SOLID("0.49", "0.6666666666666666", "beta: 0")},
    {.name = "K 2/3, beta 1, e 1", .scene = SOLID("0.1", "0.6666666666666666", "e: 1, beta: 1")},
    {.name = "e 0: means",
     .scene = MEANS("usf", "0.01", "e: 0"),
     .agrees = "temperature",
     .apart = "pairs meet again",
     .collisions = 5,
     .when = NIGHTLY},
    {.name = "e 0, phi 3e-4: means",
     .scene = MEANS("usf", "3e-4", "e: 0"),
     .agrees = "temperature",
     .collisions = 5,
     .when = NIGHTLY},
    {.name = "e 0.01: means", .scene = MEANS("usf", "0.01", "e: 0.01"), .agrees = "P_xy", .collisions = 5},
    {.name = "e 0, cooling: means",
     .scene = MEANS("hcs", "0.01", "e: 0"),
     .agrees = "cooling_rate",
     .apart = "clusters",
     .collisions = 5},
    {.name = "beta -0.999999: means",
     .scene = MEANS("usf", "0.01", "beta: -0.999999"),
     .agrees = "temperature",
     .collisions = 5},
    {.name = "beta 1: means", .scene = MEANS("usf", "0.01", "beta: 1"), .agrees = "temperature_ratio", .collisions = 5},
    {.name = "mu 1e-6: means",
     .scene = MEANS("usf", "0.01", "beta: 0, mu: 1e-6"),
     .agrees = "temperature",
     .collisions = 5},
    {.name = "mu 1e6: means",
     .scene = MEANS("usf", "0.01", "beta: 0, mu: 1e6"),
     .agrees = "temperature_ratio",
     .collisions = 5},
    {.name = "viscoelastic, e 0.001", .scene = USF("0.1", "law: viscoelastic, e: 0.001"), .refused = "allowed: from"},
    {.subject = "densities, sizes and boxes"},
    {.name = "phi 1e-12, sheared",
     .scene = "{flow: usf, phi: 1e-12, particles: 300}",
     .md = "cells between two collisions"},
    {.name = "phi 1e-12, cooling, rough",
     .scene = "{flow: hcs, phi: 1e-12, particles: 300, collision: {beta: 0}}",
     .md = "cells between two collisions"},
    {.name = "phi 1e-6, sheared", .scene = "{flow: usf, phi: 1e-6, particles: 300}", .collisions = 3},
    {.name = "phi 1e-6, cooling, rough",
     .scene = "{flow: hcs, phi: 1e-6, particles: 300, collision: {beta: 0}}",
     .collisions = 20,
     .when = NIGHTLY},
    {.name = "phi 1e-6, e 0, N 2",
     .scene = "{flow: usf, phi: 1e-6, particles: 2, collision: {e: 0}}",
     .collisions = 20,
     .when = NIGHTLY},
    {.name = "phi 0.49, at rest", .scene = "{flow: equilibrium, phi: 0.49, particles: 500}"},
    {.name = "phi 0.49, rough, sheared", .scene = "{flow: usf, phi: 0.49, particles: 500, collision: {beta: 0.5}}"},
    {.name = "phi 0.6, at rest", .scene = "{flow: equilibrium, phi: 0.6, particles: 500}"},
    {.name = "phi 0.6, sheared", .scene = "{flow: usf, phi: 0.6, particles: 500, collision: {e: 0.9}}"},
    {.name = "phi 0.6, e 0, beta 0, sheared",
     .scene = "{flow: usf, phi: 0.6, particles: 500, collision: {e: 0, beta: 0}}"},
    {.name = "phi 0.6, cooling", .scene = "{flow: hcs, phi: 0.6, particles: 500, collision: {e: 0.5}}"},
    {.name = "phi 0.61", .scene = "{flow: usf, phi: 0.61}", .refused = "from 0 to 0.6"},
    {.name = "phi -0.1", .scene = "{flow: usf, phi: -0.1}", .refused = "from 0 to 0.6"},
    {.name = "phi 1e-21", .scene = "{flow: usf, phi: 1e-21}", .refused = "too small a solid fraction"},
    {.name = "N 1", .scene = "{flow: usf, phi: 0.1, particles: 1}", .refused = "from 2 to 100000000"},
    {.name = "N 2, sheared", .scene = "{flow: usf, phi: 0.01, particles: 2}", .collisions = 500},
    {.name = "N 2, sheared, rough, friction",
     .scene = "{flow: usf, phi: 0.01, particles: 2, collision: {e: 0.5, beta: 0.5, mu: 0.3}}",
     .collisions = 500},
    {.name = "N 2, at rest", .scene = "{flow: equilibrium, phi: 0.01, particles: 2}", .collisions = 500},
    {.name = "N 2, cooling", .scene = "{flow: hcs, phi: 0.01, particles: 2, collision: {e: 0.5}}", .collisions = 500},
    {.name = "N 2, heated", .scene = "{flow: hss, phi: 0.01, particles: 2}", .collisions = 500},
    {.name = "N 2, white noise",
     .scene = "{flow: hss, thermostat: white_noise, phi: 0.01, particles: 2}",
     .collisions = 500},
    {.name = "N 2 at phi 0.49", .scene = "{flow: usf, phi: 0.49, particles: 2}", .md = MD_NEEDS_ROOM},
    {.name = "N 3, sheared", .scene = "{flow: usf, phi: 0.05, particles: 3, collision: {e: 0}}", .collisions = 500},
    {.name = "N 3, cooling, e 0.01",
     .scene = "{flow: hcs, phi: 0.05, particles: 3, collision: {e: 0.01}}",
     .collisions = 500},
    {.name = "N 3, rough, at rest",
     .scene = "{flow: hcs, phi: 0.05, particles: 3, collision: {e: 1, beta: 1}}",
     .collisions = 500},
    {.name = "N 1e6, sheared at phi 0.1",
     .scene = "{flow: usf, phi: 0.1, particles: 1000000}",
     .collisions = 3,
     .when = NIGHTLY},
    {.name = "N 1e6, rough, sheared at phi 0.49",
     .scene = "{flow: usf, phi: 0.49, particles: 1000000, collision: {beta: 0}}",
     .collisions = 3,
     .when = NIGHTLY},
    {.name = "N 1e6, cooling at phi 0.01",
     .scene = "{flow: hcs, phi: 0.01, particles: 1000000}",
     .collisions = 3,
     .when = NIGHTLY},
    {.name = "N 1e6, single precision",
     .scene = "{flow: usf, phi: 0.1, particles: 2, dsmc: {particles: 1000000, precision: single}}",
     .md = NOT_RUN,
     .collisions = 3,
     .when = NIGHTLY},
    {.name = "box 100 : 1 : 1, sheared", .scene = "{flow: usf, phi: 0.1, particles: 1000, aspect: [100, 1, 1]}"},
    {.name = "box 1 : 100 : 1, sheared", .scene = "{flow: usf, phi: 0.1, particles: 1000, aspect: [1, 100, 1]}"},
    {.name = "box 1 : 1 : 100, sheared", .scene = "{flow: usf, phi: 0.1, particles: 1000, aspect: [1, 1, 100]}"},
    {.name = "box 1 : 100 : 100, cooling",
     .scene = "{flow: hcs, phi: 0.1, particles: 20000, aspect: [0.01, 1, 1]}",
     .collisions = 10,
     .when = NIGHTLY},
    {.name = "box 100 : 1 : 1 at phi 0.49, rough",
     .scene = "{flow: usf, phi: 0.49, particles: 5000, aspect: [100, 1, 1], collision: {beta: 0}}",
     .collisions = 10,
     .when = NIGHTLY},
    {.name = "box 100 : 1 : 1 of 100 grains",
     .scene = "{flow: usf, phi: 0.1, particles: 100, aspect: [100, 1, 1]}",
     .md = MD_NEEDS_ROOM},
    {.name = "box 101 : 1 : 1", .scene = "{flow: usf, phi: 0.1, aspect: [101, 1, 1]}", .refused = "from 0.01 to 100"},
    {.name = "dilute: means",
     .scene = "{flow: usf, phi: 1e-4, particles: 500, run: {collisions: 400, warmup: 100}}",
     .agrees = "temperature",
     .collisions = 5,
     .when = NIGHTLY},
    {.name = "phi 0.49, at rest: means",
     .scene = "{flow: equilibrium, phi: 0.49, particles: 500, contact_value: kolafa, run: {collisions: 600}}",
     .agrees = "pressure",
     .collisions = 5},
    {.name = "phi 1e-12: means",
     .scene = "{flow: usf, phi: 1e-12, run: {collisions: 600, warmup: 100}}",
     .md = NOT_RUN,
     .agrees = "temperature",
     .collisions = 5},
    {.subject = "drives"}, /* shear rates, cooling and heating over decades, thermostats, walls, gravity */
    {.name = "shear rate 1e-12", .scene = "{flow: usf, phi: 0.1, particles: 300, shear_rate: 1e-12}"},
    {.name = "shear rate 1e12", .scene = "{flow: usf, phi: 0.1, particles: 300, shear_rate: 1e12}"},
    {.name = "shear rate 1e12 from T 1",
     .scene = "{flow: usf, phi: 0.1, particles: 300, shear_rate: 1e12, temperature: 1}",
     .refused = "allowed in sheared flows"},
    {.name = "shear rate 1e-12 from T 1, grains of 1e3",
     .scene = "{flow: usf, phi: 0.1, particles: 300, shear_rate: 1e-12, temperature: 1, species: [{fraction: 1, "
              "diameter: 1e3, mass: 1e9}]}"},
    {.name = "shear rate 0", .scene = "{flow: usf, phi: 0.1, shear_rate: 0}", .refused = "allowed: above 0"},
    {.name = "shear from the cold", .scene = "{flow: usf, phi: 0.1, particles: 300, temperature: 1e-6}"},
    {.name = "shear from far above", .scene = "{flow: usf, phi: 0.1, particles: 300, temperature: 1e12}"},
    {.name = "shear from 1e-7",
     .scene = "{flow: usf, phi: 0.1, particles: 300, temperature: 1e-7}",
     .refused = "allowed in sheared flows"},
    {.name = "sheared clusters, e 0.5, beta 0 at phi 0.5: no collapse",
     .scene = "{flow: usf, phi: 0.5, particles: 1000, collision: {e: 0.5, beta: 0}}",
     .collisions = 600},
    {.name = "cooling by 12 decades",
     .scene = "{flow: hcs, phi: 0.05, particles: 300, collision: {e: 0.8}}",
     .collisions = 400,
     .cools = 1e-12},
    {.name = "cooling by 12 decades, beta -0.9",
     .scene = "{flow: hcs, phi: 0.05, particles: 300, collision: {e: 0.9, beta: -0.9}}",
     .collisions = 1500,
     .cools = 1e-12},
    {.name = "cooling by 12 decades, rough, friction",
     .scene = "{flow: hcs, phi: 0.05, particles: 300, collision: {e: 0.7, beta: 0, mu: 0.5}}",
     .collisions = 150,
     .cools = 1e-12},
    {.name = "cooling by 12 decades, mixture",
     .scene = "{flow: hcs, phi: 0.05, particles: 400, collision: {e: 0.7}, species: [{fraction: 0.5}, {fraction: 0.5, "
              "mass: 8, diameter: 2}]}",
     .collisions = 600,
     .cools = 1e-12},
    {.name = "cooling by 3 decades, viscoelastic",
     .scene = "{flow: hcs, phi: 0.05, particles: 300, collision: {law: viscoelastic, e: 0.3}}",
     .collisions = 6000,
     .cools = 1e-3},
    {.name = "cooling by 9 decades, dense, e 0.3",
     .scene = "{flow: hcs, phi: 0.45, particles: 500, collision: {e: 0.3}}",
     .collisions = 900,
     .cools = 2e-9,
     .when = NIGHTLY},
    {.name = "heating by 9 decades, elastic, sheared",
     .scene = "{flow: usf, phi: 0.3, particles: 100, collision: {e: 1}, temperature: 1e-6}",
     .collisions = 40000,
     .cools = 1e9,
     .when = NIGHTLY},
    {.name = "heating by 12 decades from the cold",
     .scene = "{flow: usf, phi: 1e-6, particles: 300, temperature: 1e-6}",
     .collisions = 100,
     .cools = 1e12,
     .when = NIGHTLY},
    {.name = "1e9 collisions of md",
     .scene = "{flow: usf, phi: 0.3, particles: 1000, collision: {e: 0.9, beta: 0}}",
     .collisions = 2e6,
     .dsmc = NOT_RUN,
     .when = ONLY_BY_NAME},
    {.name = "1e8 collisions of md",
     .scene = "{flow: usf, phi: 0.3, particles: 1000, collision: {e: 0.9, beta: 0}}",
     .collisions = 2e5,
     .dsmc = NOT_RUN,
     .when = ONLY_BY_NAME},
    {.name = "1e9 collisions of dsmc, sheared",
     .scene = "{flow: usf, phi: 0.3, particles: 5000, collision: {e: 0.9, beta: 0}}",
     .collisions = 4e5,
     .md = NOT_RUN,
     .when = ONLY_BY_NAME},
    {.name = "1e9 collisions of dsmc, elastic",
     .scene = "{flow: equilibrium, phi: 0.3, particles: 5000}",
     .collisions = 4e5,
     .md = NOT_RUN,
     .when = ONLY_BY_NAME},
    {.name = "Gaussian thermostat, e 0", .scene = "{flow: hss, phi: 0.1, particles: 300, collision: {e: 0}}"},
    {.name = "Gaussian thermostat, rough, phi 0.49",
     .scene = "{flow: hss, phi: 0.49, particles: 300, collision: {e: 0.5, beta: 0}}"},
    {.name = "white noise, e 0",
     .scene = "{flow: hss, thermostat: white_noise, phi: 0.1, particles: 300, collision: {e: 0}}"},
    {.name = "white noise, e 1: heats without end",
     .scene = "{flow: hss, thermostat: white_noise, phi: 0.1, particles: 300, collision: {e: 1}}"},
    {.name = "white noise, mixture 1 : 1e6 in mass",
     .scene =
         "{flow: hss, thermostat: white_noise, phi: 0.1, particles: 300, species: [{fraction: 0.5}, {fraction: 0.5, "
         "mass: 1e6}]}"},
    {.name = "heated and sheared", .scene = "{flow: heated_shear, phi: 0.1, particles: 300, collision: {e: 0.5}}"},
    {.name = "shear that goes to 0, cooling", .scene = "{flow: small_shear, phi: 0.1, particles: 300}"},
    {.name = "Couette, e 0 at walls and grains",
     .scene = "{flow: couette, phi: 0.1, particles: 400, collision: {e: 0}, walls: {e: 0}}"},
    {.name = "Couette, rough walls and grains, friction",
     .scene = "{flow: couette, phi: 0.3, particles: 400, collision: {e: 0.8, beta: 0.5, mu: 0.3}, walls: {mu: 0.5}}"},
    {.name = "Couette, 1e-12", .scene = "{flow: couette, phi: 0.1, particles: 400, walls: {speed: 1e-12}}"},
    {.name = "Couette, gap of 100 widths",
     .scene = "{flow: couette, phi: 0.1, particles: 1000, aspect: [1, 100, 1], walls: {e: 0.9}}",
     .collisions = 20},
    {.name = "Couette, masses 1 : 1e6, rough",
     .scene = "{flow: couette, phi: 0.1, particles: 400, collision: {beta: 0}, species: [{fraction: 0.5}, {fraction: "
              "0.5, mass: 1e6}]}"},
    {.name = "Poiseuille, e 0", .scene = "{flow: poiseuille, phi: 0.1, particles: 400, collision: {e: 0}}"},
    {.name = "chute, comes to rest",
     .scene = "{flow: chute, phi: 0.2, particles: 400, gravity: [0, -1, 0], collision: {e: 0.5, beta: 0}, walls: {top: "
              "open}}",
     .collisions = 300,
     .dsmc = NOT_RUN /* Enskog's equation has no packed beds */},
    {.name = "chute, e 0, friction, ridges",
     .scene = "{flow: chute, phi: 0.2, particles: 400, gravity: [0.5, -1, 0], collision: {e: 0, beta: 0, mu: 0.5}, "
              "walls: {top: open, ridges: 1, e: 0}}",
     .collisions = 300,
     .dsmc = "walls.ridges"},
    {.name = "chute, gravity 1e-9", .scene = "{flow: chute, phi: 0.1, particles: 300, gravity: [1e-9, -1e-9, 0]}"},
    {.name = "gravity in a periodic box", .scene = "{flow: usf, phi: 0.1, gravity: [0, -1, 0]}", .refused = "gravity"},
    {.name = "white noise, e 0: means",
     .scene =
         "{flow: hss, thermostat: white_noise, phi: 0.01, particles: 1000, collision: {e: 0}, run: {collisions: 600}}",
     .apart = "pairs meet again",
     .agrees = "cooling_rate",
     .collisions = 5,
     .when = NIGHTLY},
    {.name = "white noise, e 0, phi 3e-4: means",
     .scene =
         "{flow: hss, thermostat: white_noise, phi: 3e-4, particles: 1000, collision: {e: 0}, run: {collisions: 600}}",
     .agrees = "cooling_rate",
     .collisions = 5,
     .when = NIGHTLY},
    {.subject = "mixtures"}, /* ratios of masses and diameters up to the allowed ones */
    {.name = "masses 1 : 1e6, sheared", .scene = TWO("usf", "0.1", "300", "e: 0.9", HEAVY)},
    {.name = "masses 1 : 1e6, at rest", .scene = TWO("equilibrium", "0.1", "300", "e: 1", HEAVY)},
    {.name = "masses 1 : 1e6, cooling", .scene = TWO("hcs", "0.1", "300", "e: 0.9", HEAVY)},
    {.name = "masses 1 : 1e6, rough, friction, sheared",
     .scene = TWO("usf", "0.1", "300, temperature: 1", "e: 0.9, beta: 0.5, mu: 0.3", HEAVY)},
    {.name = "masses 1 : 1e6, rough, friction, sheared, from the temperature of theory",
     .scene = TWO("usf", "0.1", "300", "e: 0.9, beta: 0.5, mu: 0.3", HEAVY),
     .when = NIGHTLY},
    {.name = "masses 1e6 : 1, rough, friction, cooling",
     .scene = TWO("hcs", "0.1", "300", "e: 0.7, beta: 0, mu: 0.5", "mass: 1e-6"),
     .collisions = 200},
    {.name = "masses 1 : 1e6, e 0, beta 1", .scene = TWO("hcs", "0.1", "300", "e: 0, beta: 1", HEAVY)},
    {.name = "masses 1 : 1e6, e 0, sheared at phi 0.49", .scene = TWO("usf", "0.49", "300", "e: 0", HEAVY)},
    {.name = "masses 1 : 1e13", .scene = TWO("usf", "0.1", "300", "e: 0.9", "mass: 1e13"), .refused = "in a ratio of"},
    {.name = "diameters 1 : 10, sheared", .scene = TWO("usf", "0.1", "600", "e: 0.9", LARGE)},
    {.name = "diameters 1 : 10 at phi 0.49", .scene = TWO("equilibrium", "0.49", "600", "e: 1", LARGE)},
    {.name = "diameters 1 : 10, rough, cooling", .scene = TWO("hcs", "0.3", "600", "e: 0.8, beta: 0", LARGE)},
    {.name = "diameters 10 : 1, equal masses", .scene = TWO("usf", "0.2", "600", "e: 0.9", "diameter: 0.1")},
    {.name = "diameters 1 : 10 at phi 0.6", .scene = TWO("equilibrium", "0.6", "600", "e: 1", LARGE)},
    {.name = "diameters 1 : 10 of four grains",
     .scene = TWO("usf", "0.5", "4", "e: 0.9", LARGE),
     .md = "a grain would meet two images of another"},
    {.name = "one of a species",
     .scene = "{flow: usf, phi: 0.1, particles: 100, species: [{fraction: 0.99}, {fraction: "
              "0.01}]}",
     .refused = "each species needs two"},
    {.name = "two grains of two species",
     .scene = TWO("usf", "0.01", "2", "e: 0.9", "mass: 2"),
     .refused = "each species needs two"},
    {.name = "four grains of two species", .scene = TWO("usf", "0.01", "4", "e: 0.9", "mass: 2"), .collisions = 300},
    {.name = "16 species",
     .scene = "{flow: usf, phi: 0.2, particles: 640, temperature: 1, collision: {e: 0.8, beta: 0.2}, species: "
              "[{fraction: 0.0625}, "
              "{fraction: 0.0625, "
              "mass: 2}, "
              "{fraction: 0.0625, mass: 3}, {fraction: 0.0625, mass: 4}, {fraction: 0.0625, mass: 5}, {fraction: "
              "0.0625, mass: 6}, {fraction: 0.0625, "
              "mass: 7}, {fraction: 0.0625, mass: 8}, {fraction: 0.0625, diameter: 1.1}, {fraction: 0.0625, diameter: "
              "1.2}, {fraction: 0.0625, "
              "diameter: 1.3}, {fraction: 0.0625, diameter: 1.4}, {fraction: 0.0625, diameter: 1.5}, {fraction: "
              "0.0625, diameter: 1.6}, "
              "{fraction: 0.0625, diameter: 1.7}, {fraction: 0.0625, diameter: 1.8}]}",
     .collisions = 20},
    {.name = "smooth among rough",
     .scene = "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.8, beta: {11: -1, 12: 0, 22: 1}}, species: "
              "[{fraction: 0.5}, {fraction: 0.5, mass: 4}]}"},
    {.name = "e 0 among e 1",
     .scene = "{flow: hcs, phi: 0.2, particles: 300, collision: {e: {11: 1, 12: 0, 22: 1}}, species: [{fraction: 0.5}, "
              "{fraction: 0.5, mass: 4}]}"},
    {.name = "cooling mixture for long",
     .scene = TWO("hcs", "0.1", "2000", "e: 0.7", "mass: 4"),
     .collisions = 3000,
     .when = NIGHTLY},
    {.name = "cooling mixture of sizes for long",
     .scene = TWO("hcs", "0.1", "2000", "e: 0.7", "mass: 8, diameter: 2"),
     .collisions = 3000,
     .when = NIGHTLY},
    {.name = "masses 1 : 1e6: means",
     .scene =
         "{flow: hss, phi: 0.01, particles: 1000, species: [{fraction: 0.5}, {fraction: 0.5, mass: 1e6}], collision: "
         "{e: 0.9}, dsmc: {particles: 2000}, run: {collisions: 2000}}",
     .agrees = "partial_temperature_ratio",
     .collisions = 5,
     .when = NIGHTLY},
    {.name = "diameters 1 : 10: means",
     .scene = "{flow: hss, phi: 0.01, particles: 1000, species: [{fraction: 0.9}, {fraction: 0.1, diameter: 10, mass: "
              "1000}], collision: {e: 0.8}, dsmc: {particles: 2000}, run: {collisions: 1000}}",
     .agrees = "partial_temperature_ratio",
     .collisions = 5,
     .when = NIGHTLY},
    {.subject = "starts"}, /* initial states that no scene has */
    {.name = "touching, hot",
     .scene = "{flow: hcs, phi: 0.1, particles: 343, collision: {e: 0.9}}",
     .start = touching,
     .dsmc = NOT_RUN},
    {.name = "touching, hot, e 0, beta 0",
     .scene = "{flow: hcs, phi: 0.1, particles: 343, collision: {e: 0, beta: 0}}",
     .start = touching,
     .dsmc = NOT_RUN},
    {.name = "touching, sheared",
     .scene = "{flow: usf, phi: 0.1, particles: 343, collision: {e: 0.9, beta: 0}}",
     .start = touching,
     .dsmc = NOT_RUN},
    {.name = "pairs touching and at rest, sheared",
     .scene = "{flow: usf, phi: 0.03, particles: 400, collision: {e: 0.9}}",
     .start = pairs_at_rest,
     .dsmc = NOT_RUN},
    {.name = "pairs touching and at rest, sheared, e 0, friction",
     .scene = "{flow: usf, phi: 0.03, particles: 400, collision: {e: 0, beta: 0, mu: 0.3}}",
     .start = pairs_at_rest,
     .dsmc = NOT_RUN},
    {.name = "touching, hot, e 1",
     .scene = "{flow: equilibrium, phi: 0.1, particles: 343}",
     .start = touching,
     .dsmc = NOT_RUN},
    {.name = "touching and at rest, falls on a floor, elastic",
     .scene = "{flow: chute, phi: 0.2, particles: 343, gravity: [0, -1, 0], walls: {top: open, e: 1}, collision: {e: "
              "1}}",
     .start = touching_at_rest,
     .dsmc = NOT_RUN,
     .collisions = 300},
    {.name = "touching and at rest, falls on a floor",
     .scene = "{flow: chute, phi: 0.2, particles: 343, gravity: [0, -1, 0], walls: {top: open}, collision: {e: 0.5}}",
     .collisions = 300,
     .start = touching_at_rest,
     .dsmc = NOT_RUN},
    {.name = "a row of touching grains is hit, e 1",
     .scene = "{flow: equilibrium, phi: 0.1, particles: 343}",
     .start = cradle,
     .dsmc = NOT_RUN,
     .collisions = 20},
    {.name = "a row of touching grains is hit, e 0.9",
     .scene = "{flow: hcs, phi: 0.1, particles: 343, collision: {e: 0.9}}",
     .start = cradle,
     .dsmc = NOT_RUN,
     .collisions = 20},
    {.name = "all at rest",
     .scene = "{flow: hcs, phi: 0.1, particles: 300}",
     .start = at_rest,
     .md = "do not meet",
     .dsmc = "the temperature left the range of double precision"},
    {.name = "all at rest, sheared",
     .scene = "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.8}}",
     .start = at_rest,
     .dsmc = "the temperature left the range of double precision"},
    {.name = "a velocity that is no number",
     .scene = "{flow: usf, phi: 0.1, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision"},
    {.name = "a velocity that is no number, dense",
     .scene = "{flow: usf, phi: 0.49, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision"},
    {.name = "a velocity that is no number, dilute, cooling",
     .scene = "{flow: hcs, phi: 0.01, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision"},
    {.name = "a velocity that is no number, heated",
     .scene = "{flow: hss, phi: 0.1, particles: 300}",
     .start = nan_velocity,
     .md = "NaN or infinite",
     .dsmc = "range of double precision"},
    {.name = "a spin that is no number",
     .scene = "{flow: usf, phi: 0.1, particles: 300, collision: {beta: 0}}",
     .start = nan_spin,
     .md = "NaN or infinite",
     .dsmc = "range of double precision"},
    {.name = "a spin that is no number, cooling",
     .scene = "{flow: hcs, phi: 0.1, particles: 300, collision: {beta: -0.9}}",
     .start = nan_spin,
     .md = "NaN or infinite",
     .dsmc = "range of double precision"},
    {.name = "a place that is no number",
     .scene = "{flow: usf, phi: 0.1, particles: 300}",
     .start = nan_place,
     .md = "NaN or infinite",
     .dsmc = NOT_RUN},
    {.name = "a place that is no number, Couette",
     .scene = "{flow: couette, phi: 0.1, particles: 300}",
     .start = nan_place,
     .md = "NaN or infinite",
     .dsmc = NOT_RUN},
    {.name = NULL},
};
