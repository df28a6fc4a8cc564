/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/flow.h"

#include "base/text.h"
#include "common/quantity.h"

enum { IN_MD = 1u << GG_MD, IN_DSMC = 1u << GG_DSMC };
enum {
  UNHEATED = 1u << GG_NO_THERMOSTAT,
  GAUSSIAN = 1u << GG_GAUSSIAN,
  WHITE_NOISE = 1u << GG_WHITE_NOISE,
  BATH = 1u << GG_BATH,
  INJECTION = 1u << GG_INJECTION
};

/* Headline quantities; a scene leaves out those that it lacks (gg_common_quantity_missing). */
#define KNOWN_BY(...) ((const int[]){__VA_ARGS__, GG_N_QUANTITIES})
#define BY_SHEAR KNOWN_BY(GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_SHEAR_VISCOSITY, GG_Q_TEMPERATURE_RATIO)
#define BY_LOSS KNOWN_BY(GG_Q_COOLING_RATE, GG_Q_TEMPERATURE_RATIO, GG_Q_PARTIAL_TEMPERATURE_RATIO)
#define BY_TEMPERATURES                                                                                                \
  KNOWN_BY(GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_TEMPERATURE_RATIO, GG_Q_PARTIAL_TEMPERATURE_RATIO)
#define BY_WALLS KNOWN_BY(GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_TEMPERATURE_RATIO)
#define BY_HEAT KNOWN_BY(GG_Q_TEMPERATURE, GG_Q_PRESSURE, GG_Q_TEMPERATURE_RATIO, GG_Q_WALL_HEAT_FLUX)

const gg_flow_row gg_common_flows[GG_N_FLOWS] = {
    [GG_EQUILIBRIUM] = {.word = "equilibrium",
                        .title = "Equilibrium",
                        .doc = "elastic gas at rest",
                        .state = "equilibrium without shear",
                        .conserves = true,
                        .thermostats = UNHEATED,
                        .engines = IN_MD | IN_DSMC,
                        .headline = KNOWN_BY(GG_Q_PRESSURE, GG_Q_COLLISION_RATE)},
    [GG_USF] = {.word = "usf",
                .title = "Uniform shear flow",
                .doc = "uniform shear in a Lees-Edwards box",
                .state = "uniform shear",
                .frame = GG_SHEARED_FRAME,
                .thermostats = UNHEATED | BATH,
                .engines = IN_MD | IN_DSMC,
                .headline = BY_SHEAR},
    [GG_HCS] = {.word = "hcs",
                .title = "Homogeneous cooling",
                .doc = "homogeneous cooling of a gas without energy supply",
                .state = "free cooling",
                .frame = GG_COOLING_FRAME,
                .thermostats = UNHEATED,
                .engines = IN_MD | IN_DSMC,
                .headline = BY_LOSS},
    [GG_HSS] = {.word = "hss",
                .title = "Homogeneous heating",
                .doc = "homogeneous gas heated by a thermostat, gaussian by default, or by kicks and torques",
                .state = "a homogeneously heated state",
                .frame = GG_CENTRE_OF_MASS,
                .thermostats = GAUSSIAN | WHITE_NOISE | BATH | INJECTION,
                .thermostat = GG_GAUSSIAN,
                .engines = IN_MD | IN_DSMC,
                .headline = BY_LOSS,
                .headline_in_bath = BY_TEMPERATURES},
    [GG_COUETTE] = {.word = "couette",
                    .title = "Couette flow",
                    .doc = "shear between moving walls",
                    .state = "shear between walls",
                    .walls = GG_MOVING_WALLS,
                    .falling = GG_MAY_FALL,
                    .thermostats = UNHEATED,
                    .engines = IN_MD | IN_DSMC,
                    .headline = BY_WALLS},
    [GG_POISEUILLE] = {.word = "poiseuille",
                       .title = "Poiseuille flow",
                       .doc = "flow between resting walls driven by gravity, [1, 0, 0] by default",
                       .state = "Poiseuille flow",
                       .walls = GG_RESTING_WALLS,
                       .falling = GG_ALWAYS_FALLS,
                       .gravity = {1, 0, 0},
                       .thermostats = UNHEATED,
                       .engines = IN_MD | IN_DSMC,
                       .headline = BY_WALLS},
    [GG_CHUTE] = {.word = "chute",
                  .title = "Chute flow",
                  .doc = "flow down an incline, gravity [0.1, -0.1, 0] by default",
                  .state = "chute flow",
                  .walls = GG_RESTING_WALLS,
                  .may_be_open = true,
                  .falling = GG_ALWAYS_FALLS,
                  .gravity = {0.1, -0.1, 0},
                  .thermostats = UNHEATED,
                  .engines = IN_MD | IN_DSMC,
                  .headline = BY_WALLS},
    [GG_SMALL_SHEAR] = {.word = "small_shear",
                        .title = "Linear response to shear",
                        .doc =
                            "linear response to shear: viscosity at vanishing shear rate of the cooling gas, or with "
                            "thermostat: gaussian of the heated gas",
                        .state = "the linear response of a cooling or heated gas to shear",
                        .frame = GG_SHEARED_FRAME,
                        .linear_response = true,
                        .thermostats = UNHEATED | GAUSSIAN,
                        .engines = IN_MD | IN_DSMC,
                        .measure = GG_MEASURE_VISCOSITY,
                        .headline = KNOWN_BY(GG_Q_VISCOSITY_REDUCED)},
    [GG_HEATED_SHEAR] = {.word = "heated_shear",
                         .title = "Heated shear flow",
                         .doc = "uniform shear of a gas heated by white noise; the noise alone would hold the initial "
                                "temperature",
                         .state = "uniform shear of a heated gas",
                         .frame = GG_SHEARED_FRAME,
                         .thermostats = WHITE_NOISE,
                         .thermostat = GG_WHITE_NOISE,
                         .engines = IN_MD | IN_DSMC,
                         .headline = BY_SHEAR},
    [GG_FOURIER] = {.word = "fourier",
                    .title = "Fourier flow",
                    .doc = "heat between resting walls of two temperatures, [1, 0.5] by default",
                    .state = "heat conduction between walls",
                    .walls = GG_RESTING_WALLS,
                    .falling = GG_MAY_FALL,
                    .thermostats = UNHEATED,
                    .engines = IN_MD | IN_DSMC,
                    .wall_temperature = {1, 0.5},
                    .headline = BY_HEAT},
};

/* Separated by commas, before the last one by "or". */
static void list(unsigned flows, char *text, size_t size)
{
  *text = '\0';
  for (int f = 0; f < GG_N_FLOWS; f++) {
    if (!(flows & GG_FLOW_BIT(f))) continue;
    const unsigned left = flows >> f >> 1;
    gg_base_text_append(text, size, "%s%s", gg_common_flows[f].word, !left ? "" : left & (left - 1) ? ", " : " or ");
  }
}

void gg_common_flow_list(bool (*test)(gg_flow flow), char *text, size_t size)
{
  unsigned flows = 0;
  for (int f = 0; f < GG_N_FLOWS; f++) flows |= test((gg_flow)f) ? GG_FLOW_BIT(f) : 0;
  list(flows, text, size);
}

void gg_common_flows_taking(gg_thermostat thermostat, char *text, size_t size)
{
  unsigned flows = 0;
  for (int f = 0; f < GG_N_FLOWS; f++) flows |= gg_flow_takes((gg_flow)f, thermostat) ? GG_FLOW_BIT(f) : 0;
  list(flows, text, size);
}
