/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/fields.h"

#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "common/collision.h"
#include "common/quantity.h"
#include "common/thermostat.h"
#include "graingas.h"

const gg_field_kind gg_scene_kinds[] = {
    [GG_FIELD_NUMBER] = {"number", GG_ITEM_F64, 1, "a number"},
    [GG_FIELD_INTEGER] = {"integer", GG_ITEM_I64, 1, "a whole number"},
    [GG_FIELD_CHOICE] = {"choice", GG_ITEM_U8, sizeof(int), NULL},
    [GG_FIELD_SET] = {"set", GG_ITEM_U8, sizeof(unsigned), NULL},
    [GG_FIELD_PAIRS] = {"pairs", GG_ITEM_F64, GG_PAIRS, "a number"},
    [GG_FIELD_VECTOR] = {"vector", GG_ITEM_F64, 3, "a list of three numbers"},
    [GG_FIELD_ENDS] = {"ends", GG_ITEM_F64, 2, "a number or [lower, upper], each"},
    [GG_FIELD_LIST] = {"list", GG_ITEM_F64, GG_LOCAL_DENSITIES, "a list of up to 8 different numbers, each"},
    [GG_FIELD_ERRORS] = {"errors", GG_ITEM_F64, GG_MAX_UNTIL, NULL},
    [GG_FIELD_RATE] = {"rate", GG_ITEM_U8, sizeof(double) + GG_FORMULA_TEXT, NULL},
    [GG_FIELD_FILE] = {"file", GG_ITEM_U8, GG_FILE_NAME, NULL},
    [GG_FIELD_CHANGES] = {"changes", GG_ITEM_U8, sizeof(gg_change) * GG_MAX_CHANGES, NULL},
    [GG_FIELD_SPECIES] = {"species", GG_ITEM_F64, GG_MAX_SPECIES *(sizeof(gg_species) / sizeof(double)), NULL},
};

static gg_word flow_word(int i)
{
  return i < GG_N_FLOWS ? (gg_word){gg_common_flows[i].word, i, gg_common_flows[i].doc} : (gg_word){0};
}

static gg_word thermostat_word(int i)
{
  return i < GG_N_THERMOSTATS ? (gg_word){gg_common_thermostats[i].word, i, gg_common_thermostats[i].doc}
                              : (gg_word){0};
}

#define ENGINE_WORD(KIND, name, title) {#name, GG_##KIND, title},
static const gg_word engines[] = {GG_ENGINES(ENGINE_WORD){0}};
static const gg_word contact_values[] = {
    {"carnahan_starling", GG_CARNAHAN_STARLING, "(1 - phi/2)/(1 - phi)^3"},
    {"lun_savage", GG_LUN_SAVAGE, "(1 - phi/0.64)^(-1.6)"},
    {"kolafa", GG_KOLAFA, "from the accurate equation of state; phi up to 0.55"},
    {"vescovi2014", GG_VESCOVI,
     "sheared smooth spheres: carnahan_starling up to phi = 0.4, above it a smooth change to 2/(0.636 - phi)"},
    {"chialvo_sundaresan2013", GG_CHIALVO_SUNDARESAN,
     "sheared smooth spheres: carnahan_starling plus 0.58 phi^2/(0.636 - phi)^(3/2)"},
    {0}};
static const gg_word precisions[] = {
    {"double", GG_DOUBLE, "relative precision 1e-16"},
    {"single", GG_SINGLE, "relative precision 1e-7, half the memory, up to 1.5 times as fast"},
    {0}};
static const gg_word stored_precisions[] = {{"double", GG_DOUBLE, "relative precision 1e-16"},
                                            {"single", GG_SINGLE, "relative precision 1e-7, half the size"},
                                            {0}};
static const gg_word kept_states[] = {
    {"removed", GG_STATE_REMOVED, "checkpoints are removed at the end"},
    {"kept", GG_STATE_KEPT, "the last one stays beside the result: `graingas run --extend RESULT` continues the run"},
    {0}};
static const gg_word placements[] = {{GG_LATTICE, 0, "a face-centred lattice"},
                                     {".xyz", 0, "extended XYZ, its first frame"},
                                     {".h5", 0, "H5MD, its last frame"},
                                     {0}};
static const gg_word frames_after[] = {
    {"start", GG_AFTER_START, "from the start of the run"},
    {"warmup", GG_AFTER_WARMUP,
     "from where the averaging behind the results begins; trials that a trend ended are left out"},
    {0}};
static const gg_word stored_fields[] = {
    {"position", GG_FIELDS_POSITION, "positions, which md has"},
    {"velocity", GG_FIELDS_VELOCITY, "velocities; always stored"},
    {"spin", GG_FIELDS_SPIN, "angular velocities of rough grains"},
    {"image", GG_FIELDS_IMAGE, "images of the box, for displacements: with output.trajectory_every, in md"},
    {0}};
#define WORD(FLAG, word, description) {#word, GG_LAW_##FLAG, description},
static const gg_word laws[] = {{"constant", GG_LAW_CONSTANT, "e is constant"}, GG_LAWS(WORD){0}};
#undef WORD
static const gg_word tops[] = {{"closed", GG_CLOSED_TOP, "a wall like the one below"},
                               {"open", GG_OPEN_TOP, "no wall: grains fall back under gravity"},
                               {0}};
static const gg_word frames[] = {
    {"imposed", GG_FRAME_IMPOSED, "the imposed flow"},
    {"cells", GG_FRAME_CELLS,
     "the mean of the cell, the imposed flow taken off first; the share of the mean is put back"},
    {"cells_laboratory", GG_FRAME_CELLS_LABORATORY,
     "the mean laboratory velocity of the cell: the shear within it stays in, the share of the mean is not put back"},
    {"slabs", GG_FRAME_SLABS, "as cells, of slabs across y"},
    {"slabs_laboratory", GG_FRAME_SLABS_LABORATORY, "as cells_laboratory, of slabs across y"},
    {0}};
#define WORD(FLAG, word, description) {#word, GG_MEASURE_##FLAG, description},
static const gg_word observables[] = {GG_OBSERVABLES(WORD){0}};
#undef WORD

static const gg_word log_endings[] = {{".csv", 0, "a table"}, {".jsonl", 0, "a JSON object a line"}, {0}};

#define AT(member) offsetof(gg_scene, member)
/* Begin a row whose key is the name of its member in gg_scene, or in gg_species. */
#define KEY(TYPE, member) #member, GG_FIELD_##TYPE, AT(member)
#define MEMBER(TYPE, member) #member, GG_FIELD_##TYPE, offsetof(gg_species, member)
#define IF(CONDITION) GG_BIT(GG_IF_##CONDITION)
#define AUTO .special = "auto", .special_value = GG_AUTO, .by_default = GG_AUTO
/* Limits of numbers with a unit: products and ratios of a few of them neither overflow nor underflow. */
#define SMALL 1e-30
#define LARGE 1e30
#define NONE .special = "none", .special_value = GG_AUTO, .by_default = GG_AUTO

const gg_field gg_scene_fields[] = {
    {KEY(CHOICE, flow), .word = flow_word, .by_default = GG_USF, .doc = "flow to simulate; required", .also = "type"},
    {KEY(CHOICE, engine), .words = engines, .doc = "engine of `graingas run`; `graingas compare` runs both",
     .also = "method"},
    {KEY(CHOICE, thermostat), .word = thermostat_word, .doc = "thermostat that supplies energy", .on_the_way = true},
    {KEY(NUMBER, bath.drag), 0, LARGE, true, .by_default = 1, .unit = "1/time",
     .doc = "drag coefficient: velocities relative to the imposed flow decay at this rate", .thermostat = GG_BATH,
     .also = "damping", .on_the_way = true},
    {KEY(NUMBER, bath.temperature), 0, LARGE, .by_default = 1, .unit = "mass velocity^2",
     .doc = "temperature that the bath alone would give; 0: drag alone, which needs shear", .thermostat = GG_BATH,
     .also = "T_b", .on_the_way = true},
    {KEY(NUMBER, bath.rotation), 0, LARGE,
     .doc = "drag of spins over that of velocities, at the same temperature; 0: none; 10/3: Stokes drag of a sphere",
     .when = IF(ROUGH), .thermostat = GG_BATH, .on_the_way = true},
    {KEY(NUMBER, gaussian_rate), 0, LARGE, true, AUTO, .unit = "1/time",
     .doc = "rate zeta_0 of the Gaussian thermostat, dT/dt = zeta_0 T; auto: that of the energy lost in collisions",
     .when = IF(HEATED), .thermostat = GG_GAUSSIAN, .on_the_way = true},
    {KEY(NUMBER, noise_strength), 0, LARGE, true, AUTO, .unit = "velocity^2/time",
     .doc = "xi^2 of white noise: variance that each component of a velocity gains per time; auto: balances the losses "
            "at the initial temperature",
     .thermostat = GG_WHITE_NOISE, .on_the_way = true},
    {KEY(CHOICE, contact_value), .words = contact_values, .doc = "formula for the pair correlation at contact",
     .when = IF(CONTACT_VALUE)},
    {KEY(NUMBER, phi), 0, 0.6, .by_default = GG_AUTO,
     .doc = "solid fraction; required; 0 is the Boltzmann limit (dsmc only)",
     .also = "density volume_fraction solid_fraction packing_fraction nu"},
    {KEY(INTEGER, particles), 2, 1e8, .by_default = 1000,
     .doc = "number of grains in the box; by default fewer, from 500 on, where a box of 1000 that cools or has the "
            "Gaussian thermostat would not stay homogeneous",
     .when = IF(COUNTED), .also = "N grains number n_particles num_particles"},
    {"shear_rate", GG_FIELD_RATE, AT(shear.rate), -LARGE, LARGE, .by_default = 1, .unit = "1/time",
     .doc = "imposed shear rate: above 0; with run.duration also 0, below 0, or a formula of the time t, "
            "\"sin(2*pi*t/10)\", whose mean in each of shear_steps steps is imposed",
     .when = IF(SHEARED), .also = "gamma gamma_dot rate shear", .on_the_way = true},
    {"shear_steps", GG_FIELD_INTEGER, AT(shear.steps), 1, 1e5, .by_default = 100,
     .doc = "number of equal steps of constant shear rate, at whose ends the gas is sampled: in shear_period, or in "
            "run.duration",
     .when = IF(SHEARED) | IF(FOLLOWED) | IF(FORMULA)},
    {"shear_period", GG_FIELD_NUMBER, AT(shear.period), 0, LARGE, true, NONE, .unit = "time",
     .doc = "period of the formula; run.duration has a whole number of them, two or more: of the later half amplitudes "
            "and phases of stress and temperature are computed",
     .when = IF(SHEARED) | IF(FOLLOWED) | IF(FORMULA)},
    {KEY(NUMBER, start.temperature), 1e-100, 1e100, false, AUTO, .unit = "mass velocity^2",
     .doc = "initial temperature, <m C.C>/3; auto: near the steady state, and where the gas keeps or loses its initial "
            "temperature the one that makes v_0 a diameter per unit of time",
     .when = IF(STARTED), .also = "T T0 temp", .older = "temperature"},
    {KEY(NUMBER, start.rotational_temperature), 0, 1e100, false, AUTO, .unit = "mass velocity^2",
     .doc = "initial rotational temperature; auto: near the steady state", .when = IF(STARTED) | IF(ROUGH),
     .also = "theta", .older = "rotational_temperature"},
    {KEY(NUMBER, start.a2), -0.39, 2,
     .doc = "initial fourth cumulant of the velocities: C^2 has the gamma distribution of shape 0.6/(0.4 + a2)",
     .when = IF(STARTED)},
    {KEY(NUMBER, start.spin), -LARGE, LARGE, false, AUTO, .unit = "1/time",
     .doc = "initial mean angular velocity along z; auto: -shear_rate/2 under shear, else 0",
     .when = IF(STARTED) | IF(ROUGH)},
    {KEY(NUMBER, start.wave), 0, 1,
     .doc = "amplitude of a transverse wave u_x = wave v_0 sin(2 pi y/L_y), v_0 = sqrt(2 T/m): shear_wave measures its "
            "decay; the box is then long enough along y, unless aspect is given",
     .when = IF(WAVY) | IF(FOLLOWED)},
    {KEY(FILE, start.positions), .words = placements, .special = "random",
     .doc = "initial positions: random, a face-centred lattice (fcc), or those of a file in the scene's unit of "
            "length, without overlaps; its path is relative to the scene's file, and only a start reads it",
     .when = IF(MD), .reads = true},
    {KEY(VECTOR, aspect), 0.01, 100, .by_default = 1, .doc = "shape of the box: ratio of its edges x : y : z",
     .when = IF(BOXED), .also = "box"},
    {KEY(PAIRS, collision.e), 0, 1, .by_default = 0.9,
     .doc = "coefficient of normal restitution; in equilibrium the default is 1; a formula or table may exceed 1",
     .also = "restitution alpha normal_restitution e_n en", .on_the_way = true, .by_speed = 1 + GG_OF_E},
    {KEY(PAIRS, collision.beta), -1, 1, .by_default = -1,
     .doc = "coefficient of tangential restitution: -1 smooth, 1 perfectly rough; with finite mu, of sticking contacts",
     .when = IF(FRICTION), .also = "tangential_restitution e_t et", .on_the_way = true, .by_speed = 1 + GG_OF_BETA},
    {KEY(PAIRS, collision.mu), 0, INFINITY, .by_default = INFINITY,
     .doc = "Coulomb friction coefficient; inf: beta is constant", .when = IF(BETA), .also = "friction",
     .on_the_way = true, .by_speed = 1 + GG_OF_MU},
    {"collision.normal_kick", GG_FIELD_PAIRS, AT(collision.kick[GG_NORMAL_KICK]), 0, LARGE, .unit = "velocity",
     .doc = "D of kicks at contact: two grains part with the relative normal velocity e g_n + 2 D", .on_the_way = true},
    {"collision.tangential_kick", GG_FIELD_PAIRS, AT(collision.kick[GG_TANGENTIAL_KICK]), -LARGE, LARGE,
     .unit = "velocity",
     .doc = "D_t of kicks at contact: the surface of grain 1 gets 2 D_t k x z against that of grain 2, k from 1 to 2; "
            "above 0 the pair turns about z by the right hand",
     .on_the_way = true},
    {KEY(CHOICE, collision.law), .words = laws,
     .doc = "dependence of e on the normal speed of a collision between grains", .also = "model", .on_the_way = true},
    {KEY(NUMBER, collision.speed), SMALL, LARGE, false, AUTO, .unit = "velocity",
     .doc = "normal speed at which collision.e holds; auto: the unit of velocity of results", .when = IF(LAW),
     .on_the_way = true},
    {KEY(SPECIES, species), 1, GG_MAX_SPECIES, .doc = "species of the mixture, up to 16"},
    {KEY(NUMBER, walls.e), 0, 1, .by_default = 0.9, .doc = "coefficient of normal restitution at walls",
     .when = IF(WALLED) | IF(WALL_RULE)},
    {KEY(NUMBER, walls.beta), -1, 1, .by_default = 1,
     .doc = "coefficient of tangential restitution at walls; smooth grains do not spin: theirs applies to the centre",
     .when = IF(WALLED) | IF(WALL_RULE) | IF(WALL_FRICTION)},
    {KEY(NUMBER, walls.mu), 0, INFINITY, .by_default = INFINITY, .doc = "Coulomb friction coefficient at walls",
     .when = IF(WALLED) | IF(WALL_RULE) | IF(WALL_BETA)},
    {KEY(ENDS, walls.temperature), SMALL, LARGE, false, NONE, .unit = "mass velocity^2",
     .doc = "temperature of the walls, of both or [lower, upper]: grains that touch leave with velocities and spins of "
            "a gas of it; none: by walls.e, beta and mu",
     .when = IF(WALLED) | IF(ACCOMMODATION)},
    {KEY(NUMBER, walls.accommodation), 0, 1, .by_default = 1,
     .doc = "share of contacts in which a wall of a given temperature does so; the others are by walls.e, beta and mu",
     .when = IF(WALLED) | IF(THERMAL_WALLS)},
    {KEY(CHOICE, walls.top), .words = tops, .doc = "upper boundary of a chute", .when = IF(WALLED) | IF(OPENABLE)},
    {KEY(NUMBER, walls.speed), SMALL, LARGE, .by_default = 1, .unit = "velocity",
     .doc = "speed of moving walls: +speed at +L_y/2, -speed at -L_y/2", .when = IF(WALLED) | IF(MOVING_WALLS)},
    {KEY(NUMBER, walls.ridges), 0, LARGE, .unit = "length",
     .doc =
         "diameter of half cylinders across the flow on resting walls, adjusted so that a whole number fits; 0: flat",
     .when = IF(WALLED)},
    {KEY(VECTOR, gravity), -1e12, 1e12, .unit = "acceleration",
     .doc = "body force per mass; poiseuille and chute have defaults of their own", .when = IF(WALLED), .also = "g"},
    {KEY(NUMBER, run.relative_error), 0, 1, true, AUTO,
     .doc = "stop when every headline quantity has this relative standard error; auto: 0.01, or no such test if "
            "run.collisions or run.until is given",
     .when = IF(AVERAGED) | IF(ERROR), .also = "error tolerance accuracy", .may_change = true},
    {KEY(ERRORS, run.until), 0, 1, true, .special = "none",
     .doc = "stop when each of these quantities has its relative standard error: {N1: 0.01, temperature: 0.002}; "
            "headline quantities that are not named keep run.relative_error, if it is given",
     .when = IF(AVERAGED), .also = "target targets", .may_change = true},
    {KEY(NUMBER, run.collisions), 0, 1e15, true, NONE, .unit = "collisions per grain",
     .doc = "stop after this length of averaging; a gas cooling with a restitution law has 400 by default",
     .when = IF(AVERAGED), .also = "steps", .may_change = true},
    {KEY(NUMBER, run.time_limit), 0, 1e9, true, NONE, .unit = "s",
     .doc = "wall-clock limit, counted from the first start; to continue, resume with a larger limit",
     .also = "walltime wall_time max_time", .may_change = true},
    {KEY(NUMBER, run.duration), 0, LARGE, true, NONE, .unit = "time",
     .doc = "follow the gas from its start for this time, without warm-up: curves in time are means over replicas, and "
            "values those at the end",
     .when = IF(UNWALLED), .also = "t_end end_time until_time"},
    {KEY(NUMBER, run.warmup), 0, 1e15, false, AUTO, .unit = "collisions per grain",
     .doc = "length of the warm-up; auto: until the slowest quantity is steady", .when = IF(AVERAGED),
     .also = "equilibration burn_in"},
    {KEY(INTEGER, run.replicas), 1, 10000, .by_default = 1,
     .doc = "number of independent copies to average over; 8 by default if run.duration is given",
     .also = "repeats copies"},
    {KEY(INTEGER, run.seed), 0, 9223372036854775807.0, .by_default = 1,
     .doc = "seed of the random streams; the same seed gives the same run"},
    {KEY(NUMBER, md.contact_time), 0, 1, false, AUTO, .unit = "mean free times",
     .doc = "collisions of a grain closer in time than this lose no normal energy, against inelastic collapse; 0: off; "
            "auto: 1e-5, tenfold up to 1e-3 where grains collapse nevertheless; with gravity along y 1e-3 sqrt(d/g)",
     .when = IF(MD) | IF(LOSSY)},
    {KEY(NUMBER, dsmc.time_step), 0, 1, true, AUTO, .unit = "mean free times",
     .doc = "time step of the Monte Carlo engine", .when = IF(DSMC), .also = "dt"},
    {KEY(INTEGER, dsmc.particles), 2, 1e8, .special = "auto", .special_value = 0,
     .doc = "size of the Monte Carlo ensemble; auto: particles, at least 5000, and finite-size bias below a quarter of "
            "run.relative_error, between walls half",
     .when = IF(DSMC)},
    {KEY(CHOICE, dsmc.precision), .words = precisions,
     .doc = "precision of stored velocities and spins in dsmc; sums are always double", .when = IF(DSMC)},
    {KEY(CHANGES, protocol),
     .doc = "what changes on the way, at times from the start: [{at: 5, bath.temperature: 2}]; keys: " GG_PROTOCOL_KEYS,
     .when = IF(FOLLOWED), .also = "schedule quench steps"},
    {KEY(SET, measure), .words = observables, .by_default = GG_MEASURE_RHEOLOGY,
     .doc = "observables to measure; unlisted ones cost nothing", .also = "observables"},
    {KEY(CHOICE, frame), .words = frames,
     .doc = "what peculiar velocities and spins are relative to, in means and distributions",
     .when = IF(MD) | IF(UNWALLED)},
    {KEY(INTEGER, frame_cells), 1, 400, .by_default = 5,
     .doc = "cells along each edge of the box, or slabs along y; at least 4 grains in each",
     .when = IF(MD) | IF(UNWALLED) | IF(CELLS)},
    {KEY(LIST, local_densities), 0, 0.74, true, .special = "auto",
     .doc = "solid fractions of the cells of local_distributions, each within a tenth; auto: 0.5, 0.75, 1, 1.25, 1.5 "
            "times phi",
     .when = IF(MD) | IF(UNWALLED) | IF(LOCAL)},
    {KEY(NUMBER, output.checkpoint_every), 0, 1e9, .unit = "s", .doc = "wall-clock time between checkpoints; 0: none",
     .may_change = true},
    {KEY(CHOICE, output.state), .words = kept_states, .doc = "checkpoint at the end of a finished run"},
    {KEY(NUMBER, output.trajectory_every), 0, 1e15, .unit = "collisions per grain",
     .doc = "interval between stored frames; 0: only the last state", .when = IF(ONE_ENGINE), .also = "dump",
     .may_change = true},
    {KEY(CHOICE, output.after), .words = frames_after, .doc = "first frame that is stored",
     .when = IF(ONE_ENGINE) | IF(FRAMES), .may_change = true},
    {KEY(SET, output.fields), .words = stored_fields, .by_default = GG_FIELDS_ALL,
     .doc = "what frames in the result file hold of every grain; velocity is always among it", .may_change = true},
    {KEY(CHOICE, output.precision), .words = stored_precisions,
     .doc = "precision of the frames in the result file; means, curves and checkpoints are always double",
     .may_change = true},
    {KEY(FILE, output.log), .words = log_endings, .special = "none",
     .doc = "file to which a run appends a row for each sample of its first replica: time, collisions, headline "
            "quantities and their means so far; beside the result, unless its path is absolute",
     .when = IF(ONE_ENGINE), .may_change = true},
    {0},
};

const gg_field gg_scene_species_fields[] = {
    {MEMBER(NUMBER, fraction), 0, LARGE, true, .by_default = 1,
     .doc = "mole fraction n_i/n, or a weight: fractions are divided by their sum; left out: an equal part",
     .besides = "leave out a species without grains", .also = "concentration"},
    {MEMBER(NUMBER, diameter), SMALL, LARGE, .by_default = 1, .unit = "length", .doc = "diameter of a grain",
     .also = "d size radius"},
    {MEMBER(NUMBER, mass), SMALL, LARGE, .by_default = 1, .unit = "mass", .doc = "mass of a grain", .also = "m"},
    {MEMBER(NUMBER, inertia), 1e-6, 1, false, .by_default = 0.4, .doc = "K = 4I/(m d^2): 0.4 solid sphere, 2/3 hollow",
     .when = IF(ROUGH), .also = "K I"},
    {MEMBER(NUMBER, drag), SMALL, LARGE, .by_default = 1,
     .doc = "drag of the bath on this species, in units of bath.drag", .thermostat = GG_BATH},
    {MEMBER(NUMBER, torque), -LARGE, LARGE, .unit = "mass velocity^2", .doc = "constant torque about z on each grain",
     .when = IF(ROUGH)},
    {0},
};

const gg_word gg_scene_former_keys[] = {
    {"small_shear", 0, "is a flow of its own: write flow: small_shear instead of flow: usf, and leave this key out"},
    {"vary", 0, "is for a sweep: graingas sweep FILE"},
    {"sweep", 0, "is for a sweep: graingas sweep FILE"},
    {0},
};

_Static_assert((int)GG_MAX_UNTIL >= (int)GG_N_QUANTITIES, "run.until has room for every quantity");
_Static_assert(sizeof gg_scene_fields / sizeof *gg_scene_fields <= GG_MAX_FIELDS + 1, "a bit for every key");

static void set_default(const gg_field *f, void *base)
{
  void *at = (char *)base + f->offset;
  if (f->type == GG_FIELD_INTEGER)
    *(int64_t *)at = (int64_t)f->by_default;
  else if (f->type == GG_FIELD_CHOICE || f->type == GG_FIELD_SET)
    memcpy(at, &(int){(int)f->by_default}, sizeof(int)); /* of numbers it may be infinite */
  else if (f->type != GG_FIELD_SPECIES && f->type != GG_FIELD_CHANGES && f->type != GG_FIELD_FILE)
    for (size_t i = 0; i < gg_scene_field_count(f); i++) ((double *)at)[i] = f->by_default; /* no formula of a rate */
}

gg_scene gg_scene_defaults(void)
{
  gg_scene scene = {.n_species = 1, .fixed = {GG_AUTO, GG_AUTO, GG_AUTO}};
  for (const gg_field *f = gg_scene_fields; f->key; f++) set_default(f, &scene);
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    for (const gg_field *f = gg_scene_species_fields; f->key; f++) set_default(f, &scene.species[i]);
    if (i > 0) scene.species[i].fraction = 0;
  }
  return scene;
}

gg_scene *gg_scene_copy_new(const gg_scene *scene, gg_error *err)
{
  gg_scene *copy = gg_base_array_new(1, sizeof *copy, err);
  if (!copy) return NULL;
  *copy = *scene;
  gg_common_extension_hold(copy->extension);
  return copy;
}

void gg_scene_free(gg_scene *scene)
{
  if (scene) gg_common_extension_release(scene->extension);
  free(scene);
}

size_t gg_scene_field_count(const gg_field *f)
{
  return gg_scene_kinds[f->type].item == GG_ITEM_F64 && f->type != GG_FIELD_SPECIES ? gg_scene_kinds[f->type].count : 1;
}

static int find(const gg_field *fields, const char *key)
{
  for (int i = 0; fields[i].key; i++)
    if (strcmp(fields[i].key, key) == 0 || (fields[i].older && strcmp(fields[i].older, key) == 0)) return i;
  return -1;
}

int gg_scene_field_find(const char *key)
{
  return find(gg_scene_fields, key);
}

const gg_field *gg_scene_strength_of(gg_thermostat thermostat)
{
  const gg_field *f = gg_scene_fields;
  while (f->key && (!f->thermostat || f->thermostat != thermostat)) f++;
  return f->key ? f : NULL;
}

bool gg_scene_is_driven(const gg_scene *s)
{
  const gg_field *f = gg_scene_strength_of(s->thermostat);
  return f && *(const double *)(const void *)((const char *)s + f->offset) != GG_AUTO;
}

bool gg_scene_has_kicks(const gg_scene *s)
{
  bool yes = false;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++)
    for (int k = 0; k < GG_N_KICKS; k++) yes |= s->collision.kick[k][p] != 0;
  return yes;
}

bool gg_scene_has_torque(const gg_scene *s)
{
  bool torque = false, rough = false;
  for (int i = 0; i < s->n_species; i++) torque |= s->species[i].torque != 0;
  for (int p = 0; p < gg_pairs_of(s->n_species); p++) rough |= gg_scene_pair_rule(s, p) != GG_SMOOTH;
  return torque && rough;
}

int gg_scene_field_pair(const gg_field *f)
{
  static const size_t first[] = {AT(collision.e), AT(collision.beta), AT(collision.mu)};
  return f->by_speed ? (int)((f->offset - first[f->by_speed - 1]) / sizeof(double)) : 0;
}

const char *gg_scene_field_law(const gg_field *f, const gg_scene *s, int past)
{
  if (!f->by_speed) return NULL;
  return gg_speed_law_text(&s->collision.by_speed, (gg_contact_coefficient)(f->by_speed - 1),
                           gg_scene_field_pair(f) + past);
}

static int find_of_species(const char *member_key, int number, gg_field *member)
{
  const int k = find(gg_scene_species_fields, member_key);
  if (k < 0) return -1;
  *member = gg_scene_species_fields[k];
  member->offset += AT(species) + (size_t)(number - 1) * sizeof(gg_species);
  return gg_scene_field_find("species");
}

/* "collision.e.12", "run.until.N1": a number of those that a map has. */
static int find_of_map(const char *key, gg_field *member)
{
  char base[64];
  const char *dot = strrchr(key, '.');
  if (!dot || strlen(key) >= sizeof base) return -1;
  snprintf(base, sizeof base, "%.*s", (int)(dot - key), key);
  const int id = gg_scene_field_find(base);
  const gg_field_type type = id < 0 ? GG_FIELD_NUMBER : gg_scene_fields[id].type;
  if (type != GG_FIELD_PAIRS && type != GG_FIELD_ERRORS) return -1;
  const int at = type == GG_FIELD_PAIRS ? gg_common_pair_find(dot + 1) : (int)gg_common_quantity_find(dot + 1);
  if (at < 0 || at >= (int)gg_scene_field_count(&gg_scene_fields[id])) return -1;
  *member = gg_scene_fields[id];
  member->type = GG_FIELD_NUMBER;
  member->offset += (size_t)at * sizeof(double);
  return id;
}

int gg_scene_key_find(const char *key, int n_species, gg_field *member)
{
  int number, used = 0;
  const int id = gg_scene_field_find(key);
  if (id >= 0) return *member = gg_scene_fields[id], id;
  if (sscanf(key, "species.%d.%n", &number, &used) != 1 || !used) return find_of_map(key, member);
  return number >= 1 && number <= n_species ? find_of_species(key + used, number, member) : -1;
}

bool gg_scene_is_given(const gg_scene *scene, const char *key)
{
  int id = gg_scene_field_find(key);
  return id >= 0 && scene->given.bits[id / 64] >> id % 64 & 1;
}

const char *const gg_scene_sections[] = {"bath", "start", "collision", "walls", "run", "md", "dsmc", "output", NULL};

bool gg_scene_is_section(const char *name)
{
  for (int i = 0; gg_scene_sections[i]; i++)
    if (strcmp(gg_scene_sections[i], name) == 0) return true;
  return false;
}

gg_word gg_scene_field_word(const gg_field *f, int i)
{
  return f->word ? f->word(i) : f->words ? f->words[i] : (gg_word){0};
}

gg_word gg_scene_field_find_word(const gg_field *f, const char *name)
{
  int i = 0;
  while (gg_scene_field_word(f, i).name && strcmp(gg_scene_field_word(f, i).name, name) != 0) i++;
  return gg_scene_field_word(f, i);
}

gg_word gg_scene_field_word_for(const gg_field *f, int value)
{
  int i = 0;
  while (gg_scene_field_word(f, i).name && gg_scene_field_word(f, i).value != value) i++;
  return gg_scene_field_word(f, i);
}

/* Whole numbers in full; the largest of 64 bits is none of those that a double can be. */
static void format_limit(const gg_field *f, double value, char text[GG_NUMBER_TEXT])
{
  if (f->type == GG_FIELD_INTEGER && isfinite(value))
    snprintf(text, GG_NUMBER_TEXT, "%" PRId64, value >= 0x1p63 ? INT64_MAX : (int64_t)value);
  else
    gg_io_number_format(value, text);
}

static void number_allowed(const gg_field *f, char *text, size_t size)
{
  const char *what = gg_scene_kinds[f->type].number;
  char min[GG_NUMBER_TEXT], max[GG_NUMBER_TEXT];
  format_limit(f, f->min, min);
  format_limit(f, f->max, max);
  if (f->max == INFINITY)
    snprintf(text, size, "%s of at least %s, or inf", what, min);
  else if (f->above_min)
    snprintf(text, size, "%s above %s, at most %s", what, min, max);
  else
    snprintf(text, size, "%s from %s to %s", what, min, max);
  if (f->special) gg_base_text_append(text, size, ", or %s", f->special);
  if (f->besides) gg_base_text_append(text, size, " (%s)", f->besides);
}

void gg_scene_field_allowed(const gg_field *f, char *text, size_t size)
{
  gg_word word;
  switch (f->type) {
  case GG_FIELD_NUMBER:
  case GG_FIELD_INTEGER:
  case GG_FIELD_VECTOR:
  case GG_FIELD_ENDS:
  case GG_FIELD_LIST: number_allowed(f, text, size); return;
  case GG_FIELD_PAIRS:
    number_allowed(f, text, size);
    if (f->by_speed) gg_base_text_append(text, size, ", a formula of the normal speed v, {table: FILE}");
    gg_base_text_append(text, size, ", or a map of them by pair of species: {11: , 12: , other: }");
    return;
  case GG_FIELD_ERRORS: snprintf(text, size, "a map of quantities: {N1: 0.01}, or none"); return;
  case GG_FIELD_CHOICE:
  case GG_FIELD_SET:
    snprintf(text, size, f->type == GG_FIELD_SET ? "a list of " : "one of ");
    for (int i = 0; (word = gg_scene_field_word(f, i)).name; i++)
      gg_base_text_append(text, size, "%s%s", i ? ", " : "", word.name);
    return;
  case GG_FIELD_RATE:
    snprintf(text, size, "a number from %g to %g, such a number below 0, 0, or a formula of t", 1 / f->max, f->max);
    return;
  case GG_FIELD_FILE:
    snprintf(text, size, "the name of a file that ends in ");
    for (const gg_word *w = f->words; w->name; w++)
      if (*w->name == '.') gg_base_text_append(text, size, "%s%s", strchr(text, '.') ? " or " : "", w->name);
    gg_base_text_append(text, size, ", or %s%s", f->reads ? GG_LATTICE " or " : "", f->special);
    return;
  case GG_FIELD_CHANGES:
    snprintf(text, size, "a list of maps {at: TIME, KEY: VALUE}, up to %d changes of " GG_PROTOCOL_KEYS,
             GG_MAX_CHANGES);
    return;
  case GG_FIELD_SPECIES:
    snprintf(text, size, "a list of 1 to %d maps with fraction, diameter, mass, inertia, drag and torque",
             GG_MAX_SPECIES);
    return;
  }
}
