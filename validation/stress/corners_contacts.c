/* The ends of what a collision may be: e, beta, mu, K. */
#include "corner.h"

#define USF(phi, collision) "{flow: usf, phi: " phi ", particles: 300, collision: {" collision "}}"
#define HCS(phi, collision) "{flow: hcs, phi: " phi ", particles: 300, collision: {" collision "}}"
#define SOLID(phi, K, collision)                                                                                       \
  "{flow: usf, phi: " phi ", particles: 300, species: [{fraction: 1, inertia: " K "}], collision: {" collision "}}"
/* Long enough for means, short enough for a minute of all of them. */
#define MEANS(flow, phi, collision)                                                                                    \
  "{flow: " flow ", phi: " phi ", particles: 1000, collision: {" collision "}, run: {collisions: 600, warmup: 100}}"

static const corner corners[] = {
    {.name = "e 0, sheared", .scene = USF("0.1", "e: 0"), .quick = true},
    {.name = "e 0, cooling", .scene = HCS("0.1", "e: 0"), .collisions = 200, .quick = true},
    {.name = "e 0, beta -1, sheared at phi 0.49", .scene = USF("0.49", "e: 0, beta: -1"), .quick = true},
    {.name = "e 0, beta 0, sheared at phi 0.49", .scene = USF("0.49", "e: 0, beta: 0"), .quick = true},
    {.name = "e 0, beta 1, cooling", .scene = HCS("0.1", "e: 0, beta: 1"), .quick = true},
    {.name = "e 0.01, sheared", .scene = USF("0.1", "e: 0.01"), .quick = true},
    {.name = "e 0.01, cooling at phi 0.49", .scene = HCS("0.49", "e: 0.01"), .quick = true},
    {.name = "e 0.01, rough, Boltzmann limit", .scene = USF("0", "e: 0.01, beta: 0"), .md = "phi > 0"},
    {.name = "e 1, sheared: heats without end", .scene = USF("0.1", "e: 1"), .collisions = 300, .quick = true},
    {.name = "e 1, beta 1, sheared", .scene = USF("0.1", "e: 1, beta: 1"), .collisions = 300, .quick = true},
    {.name = "e 1, beta 1, at rest", .scene = HCS("0.2", "e: 1, beta: 1"), .quick = true},
    {.name = "e 1, beta 0, sheared", .scene = USF("0.1", "e: 1, beta: 0"), .quick = true},
    {.name = "e -0.1", .scene = USF("0.1", "e: -0.1"), .refused = "a number from 0 to 1"},
    {.name = "beta -0.999999, sheared", .scene = USF("0.1", "beta: -0.999999"), .quick = true},
    {.name = "beta -0.999999, cooling", .scene = HCS("0.1", "beta: -0.999999"), .collisions = 300, .quick = true},
    {.name = "beta 0, sheared at phi 0.49", .scene = USF("0.49", "e: 0.9, beta: 0"), .quick = true},
    {.name = "beta 1, sheared at phi 0.49", .scene = USF("0.49", "e: 0.9, beta: 1"), .quick = true},
    {.name = "beta -1.1", .scene = USF("0.1", "beta: -1.1"), .refused = "a number from -1 to 1"},
    {.name = "mu 0", .scene = USF("0.1", "beta: 0, mu: 0"), .quick = true},
    {.name = "mu 1e-6, sheared", .scene = USF("0.1", "beta: 0, mu: 1e-6"), .quick = true},
    {.name = "mu 1e-6, beta 1, cooling", .scene = HCS("0.1", "beta: 1, mu: 1e-6"), .quick = true},
    {.name = "mu 1e6, sheared", .scene = USF("0.1", "beta: 0, mu: 1e6"), .quick = true},
    {.name = "mu 1e6, beta 1, e 0, phi 0.49", .scene = USF("0.49", "e: 0, beta: 1, mu: 1e6"), .quick = true},
    {.name = "mu -1", .scene = USF("0.1", "beta: 0, mu: -1"), .refused = "a number of at least 0"},
    {.name = "K 0", .scene = SOLID("0.1", "0", "beta: 0"), .refused = "a number from 1e-06 to 1"},
    {.name = "K 1e-6, sheared", .scene = SOLID("0.1", "1e-6", "beta: 0"), .quick = true},
    {.name = "K 1e-6, beta 1, e 0", .scene = SOLID("0.1", "1e-6", "e: 0, beta: 1"), .quick = true},
    {.name = "K 1e-6, friction", .scene = SOLID("0.1", "1e-6", "beta: 0.5, mu: 0.1"), .quick = true},
    {.name = "K 2/3, sheared at phi 0.49", .scene = SOLID("0.49", "0.6666666666666666", "beta: 0"), .quick = true},
    {.name = "K 2/3, beta 1, e 1", .scene = SOLID("0.1", "0.6666666666666666", "e: 1, beta: 1"), .quick = true},
    {.name = "e 0: means",
     .scene = MEANS("usf", "0.01", "e: 0"),
     .agrees = "temperature",
     .apart = "pairs meet again",
     .collisions = 5},
    {.name = "e 0, phi 3e-4: means", .scene = MEANS("usf", "3e-4", "e: 0"), .agrees = "temperature", .collisions = 5},
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
};

const corner_table corners_of_contacts = {"contacts", corners, sizeof corners / sizeof *corners};
