/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conditions for a key to have an effect, in the order of their evaluation. F: of the flow alone, with the words around
 * the flows that have it in "KEY has no effect ...", and the function that has it. S: of a scene s and its uses, with
 * the words after "KEY has no effect", the condition in words, and the same in C, for checks.c. */
#ifndef GG_SCENE_CONDITIONS_H
#define GG_SCENE_CONDITIONS_H

#define GG_CONDITIONS(F, S)                                                                                            \
  F(WALLED, "but between walls (flow: ", ")", gg_flow_is_walled)                                                       \
  F(SHEARED, "but in flow: ", "", gg_flow_is_sheared)                                                                  \
  F(MOVING_WALLS, "but in flow: ", "", gg_flow_has_moving_walls)                                                       \
  F(OPENABLE, "but in flow: ", "", may_be_open)                                                                        \
  S(MD, "with engine: dsmc", "engine md", uses_md(s, uses))                                                            \
  S(DSMC, "with engine: md", "engine dsmc", uses_dsmc(s, uses))                                                        \
  S(COUNTED, "with engine: dsmc, whose ensemble has dsmc.particles (auto: at least 5000)",                             \
    "engine md; dsmc between walls or with start.wave, or above 5000",                                                 \
    has_box(s, uses) || (s->dsmc.particles == 0 && s->particles > GG_LEAST_ENSEMBLE))                                  \
  S(BOXED, "with engine: dsmc, which has no box", "engine md, walls or start.wave", has_box(s, uses))                  \
  S(ONE_ENGINE, "in a comparison; graingas run keeps trajectories and logs", "graingas run",                           \
    !(uses & GG_USE_MD) || !(uses & GG_USE_DSMC))                                                                      \
  S(CONTACT_VALUE, "but on theories, engine: dsmc and the strength of white noise, with one species and phi above 0",  \
    "one species and phi above 0, in theories, dsmc and white noise", uses_contact_value(s, uses))                     \
  S(LOSSY, "where no collision loses energy", "collisions lose energy", has_losses(s))                                 \
  S(ERROR,                                                                                                             \
    "but on the ensemble's size, in a gas without such means: elastic and sheared, elastic and alone, or cooling by "  \
    "a law",                                                                                                           \
    "the flow has headline quantities", has_error(s, uses))                                                            \
  S(ROUGH, "on smooth grains, which do not spin", "rough grains", traits_of(s).rough)                                  \
  S(LAW, "while collision.law is constant", "collision.law is not constant", s->collision.law != GG_LAW_CONSTANT)      \
  S(BETA, "while collision.beta is -1: smooth grains", "collision.beta is not -1", traits_of(s).beta)                  \
  S(FRICTION, "while collision.mu is 0: smooth grains", "collision.mu is not 0", traits_of(s).friction)                \
  S(WALL_BETA, "while walls.beta is -1: smooth walls", "walls.beta is not -1", s->walls.beta != -1)                    \
  S(WALL_FRICTION, "while walls.mu is 0: smooth walls", "walls.mu is not 0", s->walls.mu != 0)                         \
  S(FRAMES, "while output.trajectory_every is 0", "output.trajectory_every is not 0", s->output.trajectory_every > 0)  \
  S(UNWALLED, "between walls", "no walls", !gg_flow_is_walled(s->flow))                                                \
  S(CELLS, "while frame is imposed", "frame is not imposed", s->frame != GG_FRAME_IMPOSED)                             \
  S(LOCAL, "without measure: [local_distributions]", "measure has local_distributions",                                \
    (s->measure & GG_MEASURE_LOCAL_DISTRIBUTIONS) != 0)                                                                \
  F(HEATED, "but in flow: ", "", gg_flow_is_heated)                                                                    \
  F(WAVY, "but in flow: ", "", takes_wave)                                                                             \
  F(STARTED, "but in flow: ", "", takes_start)                                                                         \
  S(THERMAL_WALLS, "while walls.temperature is none", "walls.temperature is given",                                    \
    s->walls.temperature[0] != GG_AUTO)                                                                                \
  S(WALL_RULE, "while every contact with a wall is by its temperature: walls.accommodation is 1",                      \
    "walls.temperature is none, or walls.accommodation below 1", walls_have_rule(s))                                   \
  S(ACCOMMODATION, "while walls.accommodation is 0", "walls.accommodation is not 0", s->walls.accommodation > 0)       \
  S(AVERAGED, "while run.duration is given", "run.duration is none", !gg_scene_is_followed(s))                         \
  S(FOLLOWED, "while run.duration is none", "run.duration is given", gg_scene_is_followed(s))                          \
  S(FORMULA, "while shear_rate is a number", "shear_rate is a formula", *s->shear.formula != 0)

#define GG_CONDITION(NAME, ...) GG_IF_##NAME,
typedef enum gg_condition { GG_CONDITIONS(GG_CONDITION, GG_CONDITION) GG_N_CONDITIONS } gg_condition;
#undef GG_CONDITION
#define GG_BIT(condition) (UINT64_C(1) << (condition))
_Static_assert(GG_N_CONDITIONS <= 64, "gg_field.when has a bit for each");

#endif
