/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grains as unlike as can be. */
#include "corner.h"

#define TWO(flow, phi, n, collision, two)                                                                              \
  "{flow: " flow ", phi: " phi ", particles: " n ", collision: {" collision                                            \
  "}, species: [{fraction: 0.5}, {fraction: 0.5, " two "}]}"
#define HEAVY "mass: 1e6"
#define LARGE "diameter: 10, mass: 1000"

static const corner corners[] = {
    {.name = "masses 1 : 1e6, sheared", .scene = TWO("usf", "0.1", "300", "e: 0.9", HEAVY), .quick = true},
    {.name = "masses 1 : 1e6, at rest", .scene = TWO("equilibrium", "0.1", "300", "e: 1", HEAVY), .quick = true},
    {.name = "masses 1 : 1e6, cooling", .scene = TWO("hcs", "0.1", "300", "e: 0.9", HEAVY), .quick = true},
    {.name = "masses 1 : 1e6, rough, friction, sheared",
     .scene = TWO("usf", "0.1", "300", "e: 0.9, beta: 0.5, mu: 0.3", HEAVY),
     .quick = true},
    {.name = "masses 1e6 : 1, rough, friction, cooling",
     .scene = TWO("hcs", "0.1", "300", "e: 0.7, beta: 0, mu: 0.5", "mass: 1e-6"),
     .collisions = 200,
     .quick = true},
    {.name = "masses 1 : 1e6, e 0, beta 1", .scene = TWO("hcs", "0.1", "300", "e: 0, beta: 1", HEAVY), .quick = true},
    {.name = "masses 1 : 1e6, e 0, sheared at phi 0.49",
     .scene = TWO("usf", "0.49", "300", "e: 0", HEAVY),
     .quick = true},
    {.name = "masses 1 : 1e13",
     .scene = TWO("usf", "0.1", "300", "e: 0.9", "mass: 1e13"),
     .refused = "in a ratio of",
     .quick = true},
    {.name = "diameters 1 : 10, sheared", .scene = TWO("usf", "0.1", "600", "e: 0.9", LARGE), .quick = true},
    {.name = "diameters 1 : 10 at phi 0.49", .scene = TWO("equilibrium", "0.49", "600", "e: 1", LARGE), .quick = true},
    {.name = "diameters 1 : 10, rough, cooling",
     .scene = TWO("hcs", "0.3", "600", "e: 0.8, beta: 0", LARGE),
     .quick = true},
    {.name = "diameters 10 : 1, equal masses",
     .scene = TWO("usf", "0.2", "600", "e: 0.9", "diameter: 0.1"),
     .quick = true},
    {.name = "diameters 1 : 10 at phi 0.6", .scene = TWO("equilibrium", "0.6", "600", "e: 1", LARGE), .quick = true},
    {.name = "diameters 1 : 10 of four grains",
     .scene = TWO("usf", "0.5", "4", "e: 0.9", LARGE),
     .md = "a grain would meet two images of another",
     .quick = true},
    {.name = "one of a species",
     .scene = "{flow: usf, phi: 0.1, particles: 100, species: [{fraction: 0.99}, {fraction: "
              "0.01}]}",
     .refused = "each species needs two",
     .quick = true},
    {.name = "two grains of two species",
     .scene = TWO("usf", "0.01", "2", "e: 0.9", "mass: 2"),
     .refused = "each species needs two",
     .quick = true},
    {.name = "four grains of two species",
     .scene = TWO("usf", "0.01", "4", "e: 0.9", "mass: 2"),
     .collisions = 300,
     .quick = true},
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
     .collisions = 20,
     .quick = true},
    {.name = "smooth among rough",
     .scene = "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.8, beta: {11: -1, 12: 0, 22: 1}}, species: "
              "[{fraction: 0.5}, {fraction: 0.5, mass: 4}]}",
     .quick = true},
    {.name = "e 0 among e 1",
     .scene = "{flow: hcs, phi: 0.2, particles: 300, collision: {e: {11: 1, 12: 0, 22: 1}}, species: [{fraction: 0.5}, "
              "{fraction: 0.5, mass: 4}]}",
     .quick = true},
    {.name = "cooling mixture for long", .scene = TWO("hcs", "0.1", "2000", "e: 0.7", "mass: 4"), .collisions = 3000},
    {.name = "cooling mixture of sizes for long",
     .scene = TWO("hcs", "0.1", "2000", "e: 0.7", "mass: 8, diameter: 2"),
     .collisions = 3000},
    {.name = "masses 1 : 1e6: means",
     .scene =
         "{flow: hss, phi: 0.01, particles: 1000, species: [{fraction: 0.5}, {fraction: 0.5, mass: 1e6}], collision: "
         "{e: 0.9}, dsmc: {particles: 2000}, run: {collisions: 2000}}",
     .agrees = "partial_temperature_ratio",
     .collisions = 5},
    {.name = "diameters 1 : 10: means",
     .scene = "{flow: hss, phi: 0.01, particles: 1000, species: [{fraction: 0.9}, {fraction: 0.1, diameter: 10, mass: "
              "1000}], collision: {e: 0.8}, dsmc: {particles: 2000}, run: {collisions: 1000}}",
     .agrees = "partial_temperature_ratio",
     .collisions = 5},
};

const corner_table corners_of_mixtures = {"mixtures", corners, sizeof corners / sizeof *corners};
