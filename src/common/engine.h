/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine interface. md and dsmc are peers behind it: other code loops over the engines and asks what they can.
 *
 * Velocities are peculiar, C = c - shear_rate y x_hat, and spins are surface velocities s = (d/2) omega, both in model
 * units (common/model.h). Positions exist only where the engine has any. */
#ifndef GG_ENGINE_H
#define GG_ENGINE_H

#include "base/archive.h"
#include "common/model.h"

/* Contacts of grains with a surface of the model; like the others, all but the number is kept while sums are on. */
typedef struct gg_surface_sums {
  double impulse[3]; /* on the surface */
  double loss;       /* energy destroyed, or taken by a thermal wall; given: below 0 */
  uint64_t collisions;
} gg_surface_sums;

/* Sums over collisions since they were last taken, by pair of species (gg_pair); a collision
 * counts once, k from 1 to 2, J the impulse on 2. Kept by the engine's own kernel; nothing of it is computed while the
 * sums are off, but for `collisions`. */
typedef struct gg_collision_sums {
  uint64_t collisions[GG_PAIRS];
  double stress[GG_PAIRS][3][3]; /* sigma k_a J_b of ab = xx, yy, zz, xy, yx (else 0); stress x volume x time */
  double loss[GG_PAIRS];         /* energy destroyed, but for kicks */
  double given[GG_PAIRS];        /* energy that kicks gave */
  gg_surface_sums surface[GG_MOST_SURFACES];
} gg_collision_sums;

/* Contacts with all surfaces, and the energy lost there. */
GG_INLINE gg_surface_sums gg_sums_of_surfaces(const gg_collision_sums *sums)
{
  gg_surface_sums all = {0};
  for (int w = 0; w < GG_MOST_SURFACES; w++) {
    all.collisions += sums->surface[w].collisions;
    all.loss += sums->surface[w].loss;
    for (int a = 0; a < 3; a++) all.impulse[a] += sums->surface[w].impulse[a];
  }
  return all;
}

/* How a run goes; counts since creation. */
typedef struct gg_engine_state {
  double time;           /* since creation, model units of the present velocity scale */
  uint64_t collisions;   /* grain-grain */
  uint64_t events;       /* md: everything taken from the queue; dsmc: candidate pairs */
  uint64_t treated;      /* md: collisions treated by the contact-time rule */
  uint64_t wall_treated; /* the same for contacts with walls, which `collisions` does not count; dsmc: held up there */
  uint64_t clamped;      /* collisions at whose speed a law has no allowed value: a user's, or a formula */
  uint64_t overflows;    /* dsmc: candidates whose rate exceeded the majorant */
  double overfilled;     /* dsmc between walls: share of grains where they fill more space than there is */
  double offset;         /* md, sheared: displacement along x of the image of the box above; else 0 */
  double turns;          /* edges that it has moved beside */
  double worst_overlap;  /* md: largest overlap seen at a collision, in d; 0 otherwise */
  double time_step; /* dsmc: the present step, that of one sweep over all pairs of species; model units; 0 for md */
  double time_step_bias; /* dsmc: estimated relative bias of the step; 0 for md */
  double particles_bias; /* dsmc: means lie off by up to this share, as 1/N; of a result, 0 of an engine */
  double others_cpu;     /* seconds of processor time of threads of the engine's own, so far in this process */
} gg_engine_state;

/* Some hundred grains, in structure-of-arrays scratch that stays in the cache; at most GG_CHUNK. NULL where the engine
 * has none. */
enum { GG_CHUNK = 1024 };
typedef struct gg_chunk {
  size_t n;
  const double *r[3];                    /* positions in the box, all at the present time; only if requested */
  const double *c[3];                    /* peculiar velocities */
  const double *s[3];                    /* spins; NULL for smooth grains */
  const double *whole_c[3], *whole_s[3]; /* the same with their local mean, where c and s are about that; else NULL */
  const int32_t *image[3];               /* md: numbers of the image (md/images.h); NULL: not counted */
  const uint8_t *species;                /* NULL for one species */
  const int64_t *id; /* the grain's number, constant through a run; only if positions are requested */
} gg_chunk;
typedef void gg_visit(void *context, const gg_chunk *chunk);

/* Grains of one species as an engine that keeps them in blocks of eight has them, nothing copied: of block g the eight
 * x lie at c + 24 g, then eight y, eight z. The fast way to read them all. */
typedef struct gg_block_run {
  size_t n; /* grains; lanes beyond the last of them are 0 */
  int species;
  double strain;       /* what is there is C_x + strain C_y, C_y, C_z */
  const double *c, *s; /* s NULL for smooth grains */
} gg_block_run;
typedef void gg_visit_blocks(void *context, const gg_block_run *run);

/* One collision as a callback sees it, of two grains or, between walls, of a grain (1) with a surface (2): velocities
 * and spins are those before the impulse. */
typedef struct gg_collision_record {
  int64_t id[2]; /* the grains' numbers: gg_chunk.id, or their places in a snapshot where that is NULL */
  int species[2];
  gg_vec k;             /* from 1 to 2 */
  gg_vec c12;           /* c_1 - c_2 of the centres, the flow between them included */
  gg_vec c[2];          /* peculiar velocities */
  gg_vec s[2], turn[2]; /* between walls: spins, and what the collision adds to them; else 0 */
  double height[2];     /* y over the middle of the box; NaN where there are no positions; of a surface its place */
  int wall;             /* number of the surface, from 1; 0: two grains */
  gg_vec J;             /* impulse on grain 2, -J on grain 1 */
  double time;          /* in the clock of gg_engine_state; in dsmc the candidate's, and pairs of species take turns */
  double since[2]; /* time since the last contact of each, walls included; INFINITY: none since the callback was set */
} gg_collision_record;
typedef void gg_collision_callback(void *context, const gg_collision_record *collision);

/* Grains from outside, in model units: 3 numbers a grain, in the order of their numbers; NULL: the engine's own start.
 * They are numbers, and there are as many of each species as the model has. */
typedef struct gg_grain_arrays { /* gg_model.start */
  const double *r;               /* in the box; NULL where the engine has no positions */
  const double *c;               /* peculiar velocities */
  const double *s;               /* spins */
  const int *species;            /* NULL for one species */
} gg_grain_arrays;

typedef struct gg_engine gg_engine;

typedef struct gg_engine_ops {
  const char *name; /* "md" */
  const char *doc;  /* one line */
  bool ensemble;    /* grains are samples of a distribution: their number is numerical, dsmc.particles */
  /* GG_OK if it can run this model; GG_BAD_INPUT with a message naming the scene key otherwise. */
  gg_status (*accepts)(const gg_model *model, gg_error *err);
  /* Bytes that an engine of this model will take. */
  double (*bytes)(const gg_model *model);
  /* Estimated nanoseconds a collision of one processor of 2020 or so, without observables. */
  double (*nanoseconds)(const gg_model *model);
  /* A new engine at a fresh initial state; it keeps its own copy of the model. */
  gg_status (*create)(const gg_model *model, uint64_t seed, uint64_t stream, gg_engine **engine, gg_error *err);
  /* A new engine of this model with these grains, without overlaps. `before` (NULL: none) is an engine with as many of
   * them, whose clock, counts and random streams it takes over, not its callback and sums; then seed and stream are of
   * no account. GG_BAD_INPUT names two grains that overlap. */
  gg_status (*create_with)(const gg_model *model, uint64_t seed, uint64_t stream, const gg_grain_arrays *grains,
                           const gg_engine *before, gg_engine **engine, gg_error *err);
  void (*destroy)(gg_engine *engine);
  /* Continue for `dt`, or until `max_collisions` more have happened, whichever is first; *elapsed is the time gone.
   * dsmc may end its last step past either limit. Deterministic: cutting a run into advances never changes a trajectory
   * in md, and in dsmc only through the ends of steps.
   *
   * GG_INTERRUPTED if model.stop requests it, which is polled several times a second. The engine then is at the present
   * event, in dsmc at the end of a step, and *elapsed is the time gone. The next call may be a new advance; or `go_on`,
   * also after save and restore, which completes the interrupted advance, bit for bit. */
  gg_status (*advance)(gg_engine *engine, double dt, uint64_t max_collisions, double *elapsed, gg_error *err);
  /* Count from now on the images of the box that grains enter; it changes no bit of the trajectory, and a restored
   * engine continues. NULL where the engine has no images. */
  gg_status (*keep_images)(gg_engine *engine, gg_error *err);
  /* Return the sums over collisions since the last read, or the start, and reset them. */
  void (*take_sums)(gg_engine *engine, gg_collision_sums *sums);
  /* Show every collision between grains to `callback` from now on; NULL: none. The callback costs time; a dsmc engine
   * also leaves its block kernels, in which grains change places, until it has no callback. An engine restored from a
   * checkpoint has to be set again, and then continues bit for bit. */
  gg_status (*set_callback)(gg_engine *engine, gg_collision_callback *callback, void *context, gg_error *err);
  /* True if a callback slows this engine down many times over, so that it is best set in bursts. NULL: it does not. */
  bool (*callback_slows)(const gg_engine *engine);
  /* Share the work out to so many threads, the caller's included; the trajectory does not depend on it. NULL where the
   * engine cannot. */
  void (*threads)(gg_engine *engine, int threads);
  void (*state)(const gg_engine *engine, gg_engine_state *state);
  /* Show every grain at the present time. */
  void (*snapshot)(gg_engine *engine, bool positions, gg_visit *visit, void *context);
  /* The same grains in the same order, as they are. NULL where the engine has no blocks. */
  void (*blocks)(gg_engine *engine, gg_visit_blocks *visit, void *context);
  /* Multiply every velocity and spin by 2^power, exactly; for cooling over decades, and to begin the next sweep of a
   * linear response (linear_response.h), which leaves the clock alone. GG_BAD_INPUT in other sheared flows. */
  gg_status (*rescale)(gg_engine *engine, int power, gg_error *err);
  /* Continue with another shear rate, also 0 or below; peculiar velocities and spins stay. GG_BAD_INPUT in flows that
   * are not sheared. */
  gg_status (*shear)(gg_engine *engine, double rate, gg_error *err);
  /* Everything needed to continue bit for bit. Saving does not disturb the run. */
  gg_status (*save)(const gg_engine *engine, gg_archive *archive, gg_error *err);
  gg_status (*restore)(const gg_model *model, const gg_archive *archive, gg_engine **engine, gg_error *err);
  /* Lines of what this model switched on and off, for `graingas info`: calls `line` for each. */
  void (*describe)(const gg_model *model, void (*line)(void *context, const char *text), void *context);
  /* The rest of an advance that was stopped; *elapsed counts from where that began. */
  gg_status (*go_on)(gg_engine *engine, double *elapsed, gg_error *err);
} gg_engine_ops;

struct gg_engine {
  const gg_engine_ops *ops; /* first member of every engine */
};

#define GG_ENGINE_OPS(KIND, name, title) extern const gg_engine_ops gg_##name##_ops;
GG_ENGINES(GG_ENGINE_OPS)
#undef GG_ENGINE_OPS

static inline gg_engine_state gg_engine_state_of(const gg_engine *engine)
{
  gg_engine_state state;
  engine->ops->state(engine, &state);
  return state;
}

/* engines.c: the engine of a kind. */
const gg_engine_ops *gg_common_engine_of(int kind);

#endif
