/* SPDX-License-Identifier: GPL-3.0-or-later */
/* graingas: granular gases of hard spheres by event-driven molecular dynamics and Enskog Monte Carlo, with theories.
 * The whole public interface, for C99 and later and for C++. Rules for all functions:
 *
 * Status: every call that can fail returns a gg_status (its values are the exit codes of the graingas command; 0 is
 * success). It writes a message to its last argument, `err`, which may be NULL. Unless stated otherwise, outputs are
 * written only on success. A NULL argument that is needed gives GG_BAD_INPUT, never a crash; calls that return pointers
 * or numbers then return NULL or 0. The library never exits and never prints.
 *
 * Ownership: handles made by a call belong to the caller, who frees them with the matching `_free` (freeing NULL is
 * allowed). Texts returned through `char **` are freed with free(). Every other returned pointer is borrowed: it is
 * valid as long as the handle that it came from.
 *
 * Threads: there is no global state. One thread at a time may use a handle, several may use a `const` one. Simulations
 * and runs in different threads are independent. If HDF5 is not thread-safe (Debian's is), only one thread at a time
 * may read or write files. Unless stated otherwise, callbacks come on the calling thread. A `context` is passed to the
 * callbacks of its call. A callback `stop` is polled several times a second and returns non-zero to interrupt; it may
 * be NULL.
 *
 * Handles in use: while a call uses a simulation, session, trajectory or sweep, another call from its callback or from
 * a second thread returns GG_BAD_INPUT, and the call in progress is not affected. From a callback of a simulation,
 * gg_simulation_on_collision() and gg_simulation_on_stop() are allowed and take effect at once. A handle that is freed
 * while a call uses it lives until that call returns; advances return as soon as they can, with GG_INTERRUPTED.
 *
 * The library does not change the state of the process: locale, signal handlers, allocators of other libraries. The
 * exception is GSL's error handler, which the library replaces during calls that use GSL. Numbers in texts have a
 * decimal point in every locale.
 *
 * Units are those of results (gg_catalogue_entry() gives them): lengths in the diameter d and masses in the mass m of
 * species 1; sheared flows in units of the shear rate gamma (couette: of 2 walls.speed/L_y, its mean), others in the
 * initial thermal speed v_0 = sqrt(2T/m); between walls at rest, in a bath and with a given noise_strength or
 * gaussian_rate v_0 is a diameter per unit of time of the scene. Keys of scenes are in the scene's units of length,
 * mass and time, temperatures among them in mass x velocity^2. Stresses, and energies per volume, are in rho_p d^2
 * gamma^2 or rho_p v_0^2 with rho_p = 6m/(pi d^3). Temperatures are <C.C>/3, C the velocity relative to the imposed
 * flow; of mixtures m<C.C>/3, m in that of species 1. With phi = 0, n d^2 = 1 sets the length.
 *
 * Options: a struct of options begins with `size`, its sizeof; members that are zero or NULL have their defaults. So
 * options may grow in versions that are otherwise compatible: programs that were built before keep working, and
 * programs built with a newer header than the library's get GG_BAD_INPUT. All other structs stay as they are.
 *
 *   gg_run_options options = {.size = sizeof options, .threads = 4}; */
#ifndef GRAINGAS_H
#define GRAINGAS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this header; gg_version() is that of the library. While MAJOR is 0, versions of another MINOR are not
 * compatible, and the loader rejects them (libgraingas.so.0.MINOR). */
#define GRAINGAS_VERSION_MAJOR 0
#define GRAINGAS_VERSION_MINOR 1
#define GRAINGAS_VERSION_PATCH 0
#define GRAINGAS_VERSION "0.1.0"

#if defined(__GNUC__)
#define GG_API __attribute__((visibility("default")))
#else
#define GG_API
#endif

/* ---- Status ---- */

#ifndef GG_STATUS_DEFINED /* the library's own files include these lines alone */
#define GG_STATUS_DEFINED
typedef enum gg_status {
  GG_OK = 0,
  GG_FAILED = 1,       /* the run failed or did not reach its stopping criteria; out of memory */
  GG_BAD_INPUT = 2,    /* the scene or an argument is wrong */
  GG_BAD_FILE = 3,     /* a file could not be read or written */
  GG_INTERRUPTED = 130 /* stopped by the caller */
} gg_status;

typedef enum gg_cause {
  GG_CAUSE_OTHER,   /* the message says it */
  GG_CAUSE_COLLAPSE /* inelastic collapse: a larger md.contact_time prevents it */
} gg_cause;

typedef struct gg_error {
  gg_status status;
  char message[1024]; /* for people: what is wrong, where, what is allowed */
  gg_cause cause;     /* for programs that act on it */
} gg_error;
#endif

/**
 * Report the failure of a callback, from within it (any callback but those of gg_messages). The library's call ends
 * soon and returns GG_FAILED with this reason. The first reason counts; later results of the callback are ignored. A
 * simulation stays valid, and files that a run has stored stay. A user-defined theory that fails becomes a warning of
 * the comparison.
 * @param reason one line for people; bytes that are not UTF-8 become '?'
 */
GG_API void gg_callback_fail(const char *reason);

/**
 * Version of the library: "0.1.0" for a release, otherwise with the commit ("0.1.0+g156f34b3") and ".dirty" for changed
 * sources.
 * @return the version; never NULL
 */
GG_API const char *gg_version(void);

/**
 * Number of processors that this process may use. More threads than this are of no use.
 * @return at least 1
 */
GG_API int gg_processors(void);

/* ---- Scenes: what to simulate ----
 * A scene holds the given keys; all others have defaults, some of which depend on the given keys. Each key is checked
 * when it is set; combinations of keys are checked when the scene is used (gg_scene_check). Runs and simulations copy
 * the scene: you may change or free it afterwards. */

typedef struct gg_scene gg_scene;

/**
 * Read a scene from a YAML file.
 * @param path file name; "-" is standard input
 * @param scene receives the scene, to be freed by gg_scene_free()
 * @return GG_OK; GG_BAD_INPUT with line, key and allowed values; GG_BAD_FILE
 */
GG_API gg_status gg_scene_load(const char *path, gg_scene **scene, gg_error *err);

/**
 * Read a scene from YAML text.
 * @param yaml the text
 * @param name file name for messages; may be NULL
 * @param scene receives the scene, to be freed by gg_scene_free()
 * @return GG_OK; GG_BAD_INPUT with line, key and allowed values
 */
GG_API gg_status gg_scene_parse(const char *yaml, const char *name, gg_scene **scene, gg_error *err);

/**
 * Copy a scene with the observables, theories and law registered with it.
 * @param scene the scene
 * @param copy receives the copy, to be freed by gg_scene_free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_scene_copy(const gg_scene *scene, gg_scene **copy, gg_error *err);

/**
 * Free a scene.
 * @param scene may be NULL
 */
GG_API void gg_scene_free(gg_scene *scene);

/**
 * Set one key from YAML. The scene is unchanged on failure.
 * @param scene the scene
 * @param key "collision.e", "collision.e.12", "species.2.mass", "gravity"
 * @param value YAML in units of the scene: "0.9", "[0.01, 0, 0]"
 * @return GG_OK; GG_BAD_INPUT with the allowed values
 */
GG_API gg_status gg_scene_set(gg_scene *scene, const char *key, const char *value, gg_error *err);

/**
 * Value of a key in force, as YAML on one line.
 * @param scene the scene
 * @param key as for gg_scene_set()
 * @param text receives the text, cut to size bytes
 * @param size size of the buffer in bytes
 * @return GG_OK; GG_BAD_INPUT for an unknown key
 */
GG_API gg_status gg_scene_get(const gg_scene *scene, const char *key, char *text, size_t size, gg_error *err);

/**
 * Check that the keys of a scene go together.
 * @param scene the scene
 * @return GG_OK; GG_BAD_INPUT names what is missing or contradicts
 */
GG_API gg_status gg_scene_check(const gg_scene *scene, gg_error *err);

/**
 * Every key with the value in force, as YAML that gg_scene_parse() reads back, with the theories of its text.
 * @param scene the scene
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_scene_to_yaml(const gg_scene *scene, char **text, gg_error *err);

/**
 * Every key with the value in force, as JSON that gg_scene_parse() reads back, with the theories of its text.
 * @param scene the scene
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_scene_to_json(const gg_scene *scene, char **text, gg_error *err);

/**
 * One line about a scene: "Uniform shear flow, phi 0.3, e 0.9, smooth".
 * @param scene the scene
 * @param text receives the text, cut to size bytes
 * @param size size of the buffer in bytes
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_scene_title(const gg_scene *scene, char *text, size_t size, gg_error *err);

/**
 * Describe a run: what the engine switches on and off for the scene, its memory and its time.
 * @param scene the scene
 * @param engine "md" or "dsmc"
 * @param line called with each line of text
 * @return GG_OK; GG_BAD_INPUT with the reason why the engine cannot run the scene
 */
GG_API gg_status gg_scene_describe(const gg_scene *scene, const char *engine,
                                   void (*line)(void *context, const char *text), void *context, gg_error *err);

/* Cost of a run on an engine: memory within a fifth, time within a factor of two (three if the run stops at a requested
 * error). A run that needs more memory than available fails at the start with GG_FAILED. */
typedef struct gg_scene_needs {
  double memory, memory_available; /* bytes, all replicas; INFINITY available: unknown */
  double collisions_per_grain;     /* warm-up included */
  double cpu_seconds;
  double observables; /* time that the observables add, as a fraction of the run without them */
  double file;        /* bytes of the result file, with its trajectory */
} gg_scene_needs;

/**
 * Estimate memory and time of a run.
 * @param scene the scene
 * @param engine "md" or "dsmc"
 * @param needs receives the estimate: bytes, collisions per grain, seconds
 * @return GG_OK; GG_BAD_INPUT if the engine cannot run the scene
 */
GG_API gg_status gg_scene_get_needs(const gg_scene *scene, const char *engine, gg_scene_needs *needs, gg_error *err);

/**
 * Keys that the scene gives and that have no effect. None of them is an error.
 * @param scene the scene
 * @param use "md", "dsmc", "compare", or "theory" for what holds with either engine
 * @param line called with each reason
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_scene_warnings(const gg_scene *scene, const char *use,
                                   void (*line)(void *context, const char *text), void *context, gg_error *err);

/* ---- Simulations, step by step ----
 * A simulation starts near the steady state, if there is one. The same scene, seed and stream give the same
 * trajectory, bit for bit; in md for any division into steps. Stream 0 is that of gg_run(). Nothing is averaged: use
 * gg_run() for means. Free cooling keeps the units of its start. */

typedef struct gg_simulation gg_simulation;

/* Default: stream 0, and nothing interrupts the start. */
typedef struct gg_start_options {
  size_t size;     /* sizeof(gg_start_options) */
  uint64_t stream; /* random stream; different streams of one seed are independent copies, 0 is that of gg_run() */
  void *context;   /* for stop */
  int (*stop)(void *context); /* polled several times a second during the start; returns non-zero to interrupt it */
} gg_start_options;

/**
 * Start a simulation with the scene's engine and run.seed. In md, placing a million grains takes seconds.
 * @param scene the scene
 * @param options NULL: default options
 * @param simulation receives the simulation, to be freed by gg_simulation_free()
 * @return GG_OK; GG_BAD_INPUT; GG_FAILED if memory is insufficient; GG_INTERRUPTED by options->stop
 */
GG_API gg_status gg_simulation_new(const gg_scene *scene, const gg_start_options *options, gg_simulation **simulation,
                                   gg_error *err);

/**
 * Free a simulation.
 * @param simulation may be NULL
 */
GG_API void gg_simulation_free(gg_simulation *simulation);

/**
 * Advance by a time. Monte Carlo between walls with a given time step ends at the first end of a step beyond.
 * @param simulation the simulation
 * @param time duration in units of results
 * @return GG_OK; GG_FAILED: inelastic collapse, or grains no longer collide; GG_INTERRUPTED by gg_simulation_on_stop()
 */
GG_API gg_status gg_simulation_advance(gg_simulation *simulation, double time, gg_error *err);

/**
 * Advance by a number of collisions between grains. Monte Carlo ends at the first end of a step beyond.
 * @param simulation the simulation
 * @param collisions number of collisions; each counts once
 * @return as gg_simulation_advance()
 */
GG_API gg_status gg_simulation_collide(gg_simulation *simulation, uint64_t collisions, gg_error *err);

/**
 * Set a function that is polled several times a second during gg_simulation_advance() and gg_simulation_collide(). A
 * non-zero return interrupts the call; the simulation stays valid and can be advanced again. In large systems it also
 * interrupts gg_simulation_set() and gg_simulation_set_grains(), which then change nothing.
 * @param simulation the simulation
 * @param stop returns non-zero to interrupt; NULL: none
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_simulation_on_stop(gg_simulation *simulation, int (*stop)(void *context), void *context,
                                       gg_error *err);

typedef struct gg_simulation_state {
  double time;                 /* since the start */
  uint64_t collisions;         /* between grains since the start; each counts once */
  double collisions_per_grain; /* each counts for both partners */
  size_t grains;
  double temperature;            /* T; of mixtures sum x_i m_i <C.C>_i / 3; between walls, where no flow is imposed,
                                  * of total velocities (in results about the local mean), the stress likewise */
  double rotational_temperature; /* theta = I <omega^2>/(3m) about the mean spin (in results between walls: about the
                                  * mean at each height); 0 for smooth grains */
  double kinetic_stress[3][3];   /* in units of stress; x along the flow, y along its gradient */
  double strain;                 /* integral of the shear rate over time; 0 without shear */
  double image_offset;           /* md, sheared: displacement of the box above along x, from 0 to box[0] */
  double box[3];                 /* edges; 0 where there is none (dsmc without walls) */
  int periodic[3];               /* the box repeats along x, y, z; 0: walls or open ends, or no box */
} gg_simulation_state;

/**
 * Time, collisions, temperatures, stress and box of a simulation.
 * @param simulation the simulation
 * @param state receives the state, in units of results
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_simulation_get_state(const gg_simulation *simulation, gg_simulation_state *state, gg_error *err);

/* One species of a simulation, in units of results. */
typedef struct gg_species_state {
  size_t grains;
  double diameter, mass, inertia;             /* inertia: 4I/(m d^2) */
  double temperature, rotational_temperature; /* of the species: m<C.C>/3, I<omega^2>/3 about its mean spin */
} gg_species_state;

/**
 * Number of species.
 * @param simulation the simulation
 * @return number of species; 0 without a simulation
 */
GG_API int gg_simulation_species(const gg_simulation *simulation);

/**
 * Grains, size, mass and temperatures of one species.
 * @param simulation the simulation
 * @param species number from 0
 * @param state receives the values, in units of results
 * @return GG_OK; GG_BAD_INPUT if there is no such species
 */
GG_API gg_status gg_simulation_get_species(const gg_simulation *simulation, int species, gg_species_state *state,
                                           gg_error *err);

/* Arrays of the caller, for `grains` grains; NULL: not wanted. md keeps the order of grains. dsmc permutes grains
 * within a species, except while a collision callback or record is set. */
typedef struct gg_grains {
  double *position; /* 3 a grain: x y z x y z ...; from 0 to box[i]; with walls at y = 0 and box[1] */
  double *velocity; /* 3 a grain, relative to the imposed flow gamma (y - box[1]/2) along x */
  double *spin;     /* 3 a grain: angular velocity omega ((d/2) omega where phi = 0); 0 for smooth grains */
  int *species;     /* from 0 */
} gg_grains;

/**
 * Copy positions, velocities, spins and species of all grains.
 * @param simulation the simulation
 * @param into the caller's arrays for `grains` grains, 3 numbers a grain for vectors; NULL members are left out
 * @return GG_OK; GG_BAD_INPUT if positions are requested from dsmc, which has none
 */
GG_API gg_status gg_simulation_get_grains(const gg_simulation *simulation, const gg_grains *into, gg_error *err);

/**
 * Start a simulation from given grains: a crystal, a cluster, two temperatures, the state of another program. NULL
 * members are started as in gg_simulation_new(). Without walls the mean velocity is subtracted. If the scene gives no
 * number of grains (particles, dsmc.particles), it is n. Under shear, image_offset starts at 0.
 * @param scene the scene; its phi and n make the box (gg_simulation_get_state() of any simulation of it)
 * @param grains arrays as gg_simulation_get_grains() fills them, in units of results; only read. Monte Carlo takes no
 *   positions, between walls only the heights, and numbers its grains species by species. With several species,
 *   `species` is needed, by md also `position`
 * @param n number of grains
 * @param options as for gg_simulation_new()
 * @param simulation receives the simulation, to be freed by gg_simulation_free()
 * @return GG_OK; GG_BAD_INPUT names two grains that overlap, a number that is not finite, a place outside the box, a
 *   count that is not the scene's; GG_FAILED if memory is insufficient; GG_INTERRUPTED by options->stop
 */
GG_API gg_status gg_simulation_from_grains(const gg_scene *scene, const gg_grains *grains, size_t n,
                                           const gg_start_options *options, gg_simulation **simulation, gg_error *err);

/**
 * Replace the grains of a simulation. NULL members leave their values unchanged. Time, counts and random stream
 * continue. The simulation is unchanged on failure.
 * @param simulation the simulation
 * @param grains as for gg_simulation_from_grains()
 * @param n number of grains, that of the simulation
 * @return as gg_simulation_from_grains()
 */
GG_API gg_status gg_simulation_set_grains(gg_simulation *simulation, const gg_grains *grains, size_t n, gg_error *err);

/**
 * Copy a simulation. Both continue with the same bits. Callbacks are not copied.
 * @param simulation the simulation
 * @param copy receives the copy, to be freed by gg_simulation_free()
 * @return GG_OK; GG_FAILED if memory is insufficient; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_simulation_copy(const gg_simulation *simulation, int (*stop)(void *context), void *context,
                                    gg_simulation **copy, gg_error *err);

/**
 * Hash of the state: the number of collisions and everything that gg_simulation_get_grains() copies, to the last bit.
 * Scene, seed and number of collisions give the same hash on every processor and in a browser.
 * @param simulation the simulation
 * @param hash receives the hash
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_simulation_hash(const gg_simulation *simulation, uint64_t *hash, gg_error *err);

/* The largest number of walls. */
enum { GG_WALLS = 6 };

/**
 * Name of a wall, as in wall_P_yy_lower. Walls are numbered lower, upper, others.
 * @param simulation the simulation
 * @param wall number from 0
 * @return the name; NULL if there are not so many. Borrowed; do not free.
 */
GG_API const char *gg_simulation_wall(const gg_simulation *simulation, int wall);

typedef struct gg_simulation_sums { /* over the collisions since the last call, or since the start */
  double time;                      /* covered by the sums */
  uint64_t collisions, wall_collisions;
  double collisional_stress[3][3]; /* mean over the time, in units of stress; 0 in components that vanish in every flow;
                                    * [1][0]: flux along y of momentum along x */
  double dissipation;              /* energy lost in collisions between grains, per volume and time, in units
                                    * of stress over time */
  double wall_impulse[GG_WALLS][3]; /* on each wall: m times velocity */
  double wall_loss;                 /* energy lost in collisions with walls, or taken by thermal walls */
  double wall_heat[GG_WALLS];       /* as wall_loss, of each wall */
  double injection;                 /* energy given by kicks at contact, in the units of dissipation */
} gg_simulation_sums;

/**
 * Collision sums since the last call or the start; resets them.
 * @param simulation the simulation
 * @param sums receives stress, dissipation and impulses, in units of results
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_simulation_take_sums(gg_simulation *simulation, gg_simulation_sums *sums, gg_error *err);

typedef struct gg_collision_event {
  size_t grain[2];     /* places in the arrays of gg_simulation_get_grains */
  int species[2];      /* from 0 */
  double k[3];         /* unit vector from the first grain's centre to the second's */
  double velocity[3];  /* of the first relative to the second, flow included, before the collision */
  double normal_speed; /* of approach: k . velocity, > 0 */
  double impulse[3];   /* J on the second grain, -J on the first; m times velocity */
  double time;         /* since the start; Monte Carlo: time of the step */
} gg_collision_event;
typedef void gg_on_collision(void *context, const gg_collision_event *event);

/**
 * Set a function that is called at every collision between grains during advances. It costs time; Monte Carlo leaves
 * its fast path and has another trajectory. A callback may remove or replace itself: no further collision reaches it,
 * and Monte Carlo returns to its fast path within 20 mean free times.
 * @param simulation the simulation
 * @param callback called with each collision; NULL: none
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_simulation_on_collision(gg_simulation *simulation, gg_on_collision *callback, void *context,
                                            gg_error *err);

/**
 * Store the collisions of later advances in an array of the caller, without a callback for each. Once the array is
 * full, further collisions are not stored, and Monte Carlo returns to its fast path within 20 mean free times.
 * @param simulation the simulation
 * @param events array of `capacity` events; NULL: stop storing
 * @param capacity number of events that the array holds
 * @param n set to 0 now, and to the number of stored events by advances; both have to stay while events are stored
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_simulation_record(gg_simulation *simulation, gg_collision_event *events, size_t capacity, size_t *n,
                                      gg_error *err);

/**
 * Change a key of a running simulation: collision.*, bath.*, thermostat, gaussian_rate, noise_strength, shear_rate,
 * md.contact_time, dsmc.time_step, walls.e, walls.beta, walls.mu, walls.temperature, walls.accommodation, gravity.
 * Grains, time, counts, random stream and units stay: under shear, time stays in units of the shear rate of the start,
 * from a thousandth to a thousandfold of which shear_rate may be. Other keys set units, box or grains and are rejected,
 * as are values that would let smooth grains rotate. The simulation is unchanged on failure.
 * @param simulation the simulation
 * @param key as for gg_scene_set(), "collision.e"
 * @param value YAML in units of the scene
 * @return GG_OK; GG_BAD_INPUT with what is allowed
 */
GG_API gg_status gg_simulation_set(gg_simulation *simulation, const char *key, const char *value, gg_error *err);

/**
 * Scene of a simulation, with the keys that gg_simulation_set() has changed.
 * @param simulation the simulation
 * @return the scene, until the simulation is changed or freed; NULL without a simulation. Borrowed; do not free.
 */
GG_API const gg_scene *gg_simulation_scene(const gg_simulation *simulation);

/**
 * Write everything needed to continue with bit-identical results. The file appears whole or not at all; the file
 * before is kept as path.1.
 * @param simulation the simulation
 * @param path file name
 * @return GG_OK; GG_BAD_FILE; GG_INTERRUPTED by stop: the files are as they were
 */
GG_API gg_status gg_simulation_save(const gg_simulation *simulation, const char *path, int (*stop)(void *context),
                                    void *context, gg_error *err);

/**
 * Read a saved simulation. Callbacks have to be set again.
 * @param path file name
 * @param scene the scene that was saved (stopping criteria and output may differ); NULL: the stored one
 * @param simulation receives the simulation, to be freed by gg_simulation_free()
 * @return GG_OK; GG_BAD_FILE; GG_BAD_INPUT names a difference of the scene; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_simulation_load(const char *path, const gg_scene *scene, int (*stop)(void *context), void *context,
                                    gg_simulation **simulation, gg_error *err);

/**
 * Save a simulation to memory: the bytes of the file that gg_simulation_save() writes.
 * @param simulation the simulation
 * @param bytes receives the bytes, to be freed with free()
 * @param size receives their number
 * @return GG_OK, or an error status; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_simulation_to_bytes(const gg_simulation *simulation, int (*stop)(void *context), void *context,
                                        void **bytes, size_t *size, gg_error *err);

/**
 * Read a simulation from the bytes of gg_simulation_to_bytes() or of a file that graingas wrote.
 * @param bytes the bytes
 * @param size their number
 * @param scene as for gg_simulation_load(); may be NULL
 * @param simulation receives the simulation, to be freed by gg_simulation_free()
 * @return GG_OK; GG_BAD_FILE for bytes that are cut off or changed; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_simulation_from_bytes(const void *bytes, size_t size, const gg_scene *scene,
                                          int (*stop)(void *context), void *context, gg_simulation **simulation,
                                          gg_error *err);

/* ---- More than one process ----
 * Several processes, on one machine or many, can share the replicas of runs and comparisons. One of them, rank 0, calls
 * gg_run() or gg_compare() with `workers` among its options. Each of the others calls gg_worker_run(), which returns
 * when rank 0 has finished. Results have the same bits for any number of processes and any distribution of work. The
 * caller provides the message passing, so the library does not need MPI; the command `graingas` provides MPI's. All
 * processes need the same build. Scenes with user-defined observables, theories or laws, and the replica that writes a
 * trajectory, stay on rank 0. */

typedef struct gg_messages { /* message passing of the caller; calls come one at a time, from any thread */
  int rank, size;            /* this process, 0 to size - 1; number of processes */
  void *context;
  /* Take over a block from malloc, deliver it asynchronously and in order, and free it. Returns non-zero if it cannot.
   */
  int (*send)(void *context, int to, void *block, size_t size);
  /* Set *block to the next message, from malloc and freed by the library, and *from to its sender. Returns 1; 0: no
   * message now; -1: no further messages. */
  int (*receive)(void *context, int *from, void **block, size_t *size);
  /* Returns non-zero if this process is known to be lost. NULL: unknown; a process silent for a minute is lost. */
  int (*lost)(void *context, int rank);
  /* Warning for the user, at rank 0: a process is lost, and others repeat its work. NULL: no warning. */
  void (*warn)(void *context, const char *message);
} gg_messages;

typedef struct gg_workers gg_workers;

/**
 * Rank 0: connect to the other processes. Several runs in different threads may share the workers.
 * @param messages message functions; copied
 * @param threads threads of each process, this one included
 * @param workers receives the workers, to be freed by gg_workers_free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_workers_new(const gg_messages *messages, int threads, gg_workers **workers, gg_error *err);

/**
 * Shut the workers down: gg_worker_run() returns in the other processes.
 * @param workers may be NULL
 */
GG_API void gg_workers_free(gg_workers *workers);

/**
 * Number of threads of all processes together.
 * @param workers the workers
 * @return number of threads; 0 without workers
 */
GG_API int gg_workers_threads(const gg_workers *workers);

/**
 * Other ranks: work until rank 0 has no more tasks.
 * @param messages message functions
 * @return GG_OK; GG_FAILED if rank 0 is lost
 */
GG_API gg_status gg_worker_run(const gg_messages *messages, gg_error *err);

/* ---- Runs: until the scene's stopping criteria are met; means with errors ---- */

typedef struct gg_progress { /* progress of a run */
  const char *engine;        /* "md", "dsmc": a comparison runs both */
  const char *phase;         /* "start", "warm-up", "averaging" */
  double fraction;           /* of the run that is done, 0..1; never falls, and is 1 when the run is over */
  uint64_t collisions;       /* so far, of all replicas */
  double rate;               /* collisions per second of processor time */
  double relative_error;     /* of the worst headline quantity; NaN: not known yet */
  double time_left;          /* seconds until this engine meets its stopping criteria; NaN: not known yet */
  double limit_in;           /* seconds until run.time_limit ends the run; INFINITY: no limit */
  int64_t replicas;
  const char *next; /* in a comparison the engine that runs after this one; NULL: none */
  double overall;   /* fraction of the whole call, 0..1: in a comparison the mean over its engines; never falls */
} gg_progress;

/* Default: one thread, no callbacks, no files. Results do not depend on options. */
typedef struct gg_run_options {
  size_t size; /* sizeof(gg_run_options) */
  int threads; /* for replicas, for compare's two engines, for large Monte Carlo ensembles; 0: one */
  /* Result file to write, with the trajectory if the scene has output.trajectory_every; not one of the two files below.
   * For a device or pipe the file is first made in memory. */
  const char *output;
  /* File for checkpoints: every output.checkpoint_every seconds of the scene (0: never), and when the run is
   * interrupted or reaches its time limit. The previous one stays as FILE.1. A link, or the checkpoint of another run,
   * is GG_BAD_FILE. The trajectory so far is beside it (x.frames for x.h5). All are removed after GG_OK, when the
   * output is written. */
  const char *checkpoint;
  /* Checkpoint to resume, bit for bit, with its trajectory; FILE.1 if FILE is damaged. GG_BAD_FILE if its frames are
   * damaged or missing. */
  const char *resume;
  const char *command; /* command that made the file, stored in it; NULL: "the graingas library" */
  void *context;       /* for the callbacks; each may be NULL; one at a time, possibly on threads of the run */
  int (*progress)(void *context, const gg_progress *progress); /* returns non-zero to stop the run */
  int (*stop)(void *context);                            /* polled several times a second; returns non-zero to stop */
  void (*stored)(void *context, const char *checkpoint); /* a checkpoint was written */
  void (*warn)(void *context, const char *message);      /* before the run: keys without effect, corrections */
  const char *input;         /* file of the scene, which no output may replace; NULL: unknown */
  const char *picture;       /* file that gg_plot() will draw; checked before the run, like the other outputs */
  gg_workers *workers;       /* other processes that take part, each with the threads of gg_workers_new(); NULL: none */
  int accept_version;        /* non-zero: also resume a checkpoint of another build, whose numbers may differ */
  const char *picture_width; /* width for gg_plot(); NULL: as for a screen */
} gg_run_options;

typedef struct gg_result gg_result; /* of one engine's run */

/**
 * Run the scene's engine until its stopping criteria are met. There may be a result with a status other than GG_OK.
 * @param scene the scene
 * @param options NULL: default options
 * @param result receives the result, to be freed by gg_result_free()
 * @return GG_OK; GG_FAILED: ended before the criteria, the result has what there is; GG_INTERRUPTED: a callback
 *   stopped it within half a second, results so far (none while a large system is placed), no output is written, the
 *   checkpoint can be resumed; GG_BAD_FILE: a checkpoint or the output could not be written
 */
GG_API gg_status gg_run(const gg_scene *scene, const gg_run_options *options, gg_result **result, gg_error *err);

/* ---- Runs in pieces ----
 * A run of one replica that the caller advances in pieces, for a user interface, a notebook or a page. Means can be
 * read after each piece. The final result has the bits of gg_run(), for any division into pieces. */

typedef struct gg_session gg_session;

/**
 * Start a run of one replica in pieces.
 * @param scene the scene
 * @param session receives the session, to be freed by gg_session_free()
 * @return GG_OK; GG_BAD_INPUT if the scene has replicas
 */
GG_API gg_status gg_session_new(const gg_scene *scene, gg_session **session, gg_error *err);

/**
 * Free a session.
 * @param session may be NULL
 */
GG_API void gg_session_free(gg_session *session);

/**
 * Continue the run for a wall-clock time. The final result has the bits of gg_run().
 * @param session the session
 * @param seconds wall-clock time, kept within a few milliseconds for some thousand grains
 * @param over receives whether the run has ended; may be NULL
 * @return GG_OK; GG_FAILED, also in later calls: ended before the stopping criteria, or failed
 */
GG_API gg_status gg_session_advance(gg_session *session, double seconds, int *over, gg_error *err);

/**
 * Progress of a session.
 * @param session the session
 * @param progress receives the progress
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_session_get_progress(const gg_session *session, gg_progress *progress, gg_error *err);

/**
 * Means, errors, history, curves and grains as of now. The session is not affected.
 * @param session the session
 * @param result receives the result, to be freed by gg_result_free(); missing means have a reason
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_session_result(gg_session *session, gg_result **result, gg_error *err);

typedef struct gg_checkpoint_part { /* the run of one engine */
  const char *engine;               /* "md", "dsmc"; NULL: none */
  const char *phase;                /* "warm-up", "averaging"; "stepped": a saved simulation */
  double collisions_per_grain;      /* since the start, approximately */
  double averaged;                  /* collisions per grain while averaging; 0 for a saved simulation */
  double seconds;                   /* wall-clock time; 0 for a saved simulation */
} gg_checkpoint_part;
typedef struct gg_checkpoint_info {
  const char *kind; /* "run", "comparison", "simulation" */
  gg_checkpoint_part part[2];
  uint64_t frames; /* of the trajectory, in the file beside it */
  int older;       /* non-zero: FILE is missing or damaged, this is FILE.1 */
} gg_checkpoint_info;

/**
 * Content of a checkpoint or of a saved simulation.
 * @param path file name
 * @param info receives the content
 * @param scene receives its scene, to be freed by gg_scene_free(); may be NULL
 * @return GG_OK; GG_BAD_FILE
 */
GG_API gg_status gg_checkpoint_about(const char *path, gg_checkpoint_info *info, gg_scene **scene, gg_error *err);

/**
 * Whether a result is of the run that a checkpoint continues: by the keys that cannot change on resume.
 * @param path checkpoint
 * @param result_file result of a run or of a comparison
 * @return GG_OK; GG_BAD_INPUT names the first key that differs; GG_BAD_FILE
 */
GG_API gg_status gg_checkpoint_check_result(const char *path, const char *result_file, gg_error *err);

/* ---- Results ---- */

typedef struct gg_measurement {
  const char *name;        /* "temperature", "shear_viscosity", "N1": see GG_CATALOGUE_QUANTITIES */
  double mean, error;      /* standard error. NaN mean: none; NaN error: the run is too short */
  double correlation_time; /* integrated, in correlation_time_unit; NaN: unknown */
  uint64_t samples;
  const char *unit;
  const char *reason;                /* why there is no mean; NULL if there is one; "" if it was not requested */
  const char *correlation_time_unit; /* of time; "collisions a grain" if the gas cools or heats up for ever */
  const char *symbol; /* LaTeX: "T", "P_{xy}"; NULL: none, for numbers of curves and user-defined quantities */
} gg_measurement;

/**
 * Mean and standard error of a quantity.
 * @param result the result
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param mean receives the mean in units of results; may be NULL
 * @param error receives the standard error; NaN if the run is too short; may be NULL
 * @return GG_OK; GG_BAD_INPUT with the reason if there is none
 */
GG_API gg_status gg_result_get(const gg_result *result, const char *quantity, double *mean, double *error,
                               gg_error *err);

/**
 * Find a quantity: mean, error, unit, samples; also a quantity without a mean, with the reason.
 * @param result the result
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param found receives mean, error, unit, samples, reason
 * @return GG_OK; GG_BAD_INPUT for an unknown name
 */
GG_API gg_status gg_result_find(const gg_result *result, const char *quantity, gg_measurement *found, gg_error *err);

/**
 * Covariance of two means of a result (also of one engine of a comparison), from the blocks that their errors come
 * from: that of a quantity with itself is its error squared. Means of different runs are independent. Pairs are
 * estimated one by one: the variance of a sum of several means that nearly cancel may come out negative.
 * @param result the result
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param other name of a quantity; may be the same
 * @param covariance receives the covariance, in the product of the units of both; NaN, also on failure, if there is
 * none
 * @return GG_OK; GG_BAD_INPUT for an unknown name, or with the reason why there is no covariance
 */
GG_API gg_status gg_result_covariance(const gg_result *result, const char *quantity, const char *other,
                                      double *covariance, gg_error *err);

/**
 * The i-th quantity of a result: for (i = 0; gg_result_at(result, i, &m, NULL) == GG_OK; i++).
 * @param result the result
 * @param i index from 0
 * @param found as for gg_result_find()
 * @return GG_OK; GG_BAD_INPUT after the last one.
 */
GG_API gg_status gg_result_at(const gg_result *result, size_t i, gg_measurement *found, gg_error *err);

/**
 * Unit of a quantity.
 * @param result the result
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @return the unit; NULL if it was not measured. Borrowed; do not free.
 */
GG_API const char *gg_result_unit(const gg_result *result, const char *quantity);

/**
 * Whether the steady state was reached.
 * @param result the result
 * @return 1 or 0
 */
GG_API int gg_result_is_steady(const gg_result *result);

typedef struct gg_result_info {
  const char *engine;  /* "md", "dsmc" */
  int steady;          /* whether the steady state was reached, or a metastable one */
  const char *verdict; /* reason for `steady` */
  int64_t grains;
  const char *grains_chosen;                      /* reason for this number; NULL if given, or the default */
  double window[2];                               /* averaged over these times */
  uint64_t collisions;                            /* between grains, while averaging */
  double cpu_seconds;                             /* while averaging */
  uint64_t total_collisions;                      /* of the whole run */
  double total_cpu_seconds, wall_seconds;         /* NaN: not known */
  const char *version, *command, *machine, *date; /* of the result's file; NULL without a file */
  size_t frames;                                  /* of the trajectory in that file */
  int metastable;     /* no trend, but grains that spin fast escape friction one by one: free cooling with friction */
  double escape_rate; /* their fraction per collision a grain, estimated; NaN: not known, or no such gas */
} gg_result_info;

/**
 * Verdict, window, effort and origin of a result.
 * @param result the result
 * @param info receives the information; times in units of results, effort in seconds
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_result_get_info(const gg_result *result, gg_result_info *info, gg_error *err);

/**
 * The scene of a result, as it was run.
 * @param result the result
 * @return the scene. Borrowed; do not free.
 */
GG_API const gg_scene *gg_result_scene(const gg_result *result);

/**
 * The i-th warning of a result.
 * @param result the result
 * @param i index from 0
 * @return the text; NULL after the last. Borrowed; do not free.
 */
GG_API const char *gg_result_warning(const gg_result *result, size_t i);

/**
 * Time series of a quantity from the start of the run, first replica. It exists for temperature,
 * rotational_temperature, temperature_ratio, pressure, P_xy, spin_z, collision_rate, a2, cos2_psi.
 * @param result the result
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param n receives the number of values
 * @param time receives n times; borrowed; may be NULL
 * @param value receives n values, NaN where there is none; borrowed
 * @return GG_OK; GG_BAD_INPUT for other quantities
 */
GG_API gg_status gg_result_history(const gg_result *result, const char *quantity, size_t *n, const double **time,
                                   const double **value, gg_error *err);

typedef struct gg_curve_data { /* a distribution, profile, correlation function, spectrum ... */
  const char *name;            /* unique in a result */
  const char *observable;      /* its observable, a word of `measure` */
  const char *panel, *label;   /* curves of one panel are drawn together, with these labels */
  const char *x_name, *x_unit, *y_name, *unit;
  int log_x, log_y; /* non-zero: logarithmic axis */
  size_t n;
  const double *x, *value, *error; /* NaN: none, unknown */
  const double *law;               /* reference curve: n values with this label; NULL: none */
  const char *law_label;
  uint64_t samples;
} gg_curve_data;

/**
 * The i-th curve of a result.
 * @param result the result
 * @param i index from 0
 * @param curve receives the curve; its arrays are borrowed
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_result_curve(const gg_result *result, size_t i, gg_curve_data *curve, gg_error *err);

/**
 * The k-th number derived from a curve (an exponent, a coefficient).
 * @param result the result
 * @param i index from 0
 * @param k number from 0
 * @param number receives value, error and unit
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_result_curve_number(const gg_result *result, size_t i, size_t k, gg_measurement *number,
                                        gg_error *err);

/**
 * Last state of the grains of the first replica.
 * @param result the result
 * @param into as for gg_simulation_get_grains()
 * @return GG_OK; GG_BAD_INPUT if there are no positions
 */
GG_API gg_status gg_result_grains(const gg_result *result, const gg_grains *into, gg_error *err);

/**
 * The JSON document of `graingas run --json`.
 * @param result the result
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_result_to_json(const gg_result *result, char **text, gg_error *err);

/**
 * Write the HDF5 (H5MD) result file; it appears whole or not at all.
 * @param result the result
 * @param path file name
 * @return GG_OK; GG_BAD_FILE; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_result_write(const gg_result *result, const char *path, int (*stop)(void *context), void *context,
                                 gg_error *err);

/**
 * Read a result file. User-defined quantities keep their names, not their callbacks.
 * @param path file name
 * @param result receives the result, to be freed by gg_result_free()
 * @return GG_OK; GG_BAD_FILE
 */
GG_API gg_status gg_result_read(const char *path, gg_result **result, gg_error *err);

/**
 * Write a result to memory: the bytes of the file that gg_result_write() writes.
 * @param result the result
 * @param bytes receives the bytes, to be freed with free()
 * @param size receives their number
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_result_to_bytes(const gg_result *result, void **bytes, size_t *size, gg_error *err);

/**
 * Read a result from the bytes of gg_result_to_bytes() or of a file that graingas wrote.
 * @param bytes the bytes
 * @param size their number
 * @param result receives the result, to be freed by gg_result_free()
 * @return GG_OK; GG_BAD_FILE for bytes that are cut off or changed
 */
GG_API gg_status gg_result_from_bytes(const void *bytes, size_t size, gg_result **result, gg_error *err);

/**
 * Free a result.
 * @param result may be NULL
 */
GG_API void gg_result_free(gg_result *result);

/* ---- Trajectories ----
 * The stored frames of a run (output.trajectory_every; without this key, the last state), in units of results. One
 * frame at a time is in memory. A comparison has the frames of md. */

typedef struct gg_trajectory gg_trajectory;

/**
 * Open the trajectory of a result file; of a comparison, the trajectory of md.
 * @param path file name
 * @param trajectory receives the trajectory, to be freed by gg_trajectory_free()
 * @return GG_OK; GG_BAD_FILE; GG_FAILED if it has no positions
 */
GG_API gg_status gg_trajectory_open(const char *path, gg_trajectory **trajectory, gg_error *err);

/**
 * Close a trajectory.
 * @param trajectory may be NULL
 */
GG_API void gg_trajectory_free(gg_trajectory *trajectory);

/**
 * Scene of a trajectory, as it was run.
 * @param trajectory the trajectory
 * @return the scene; NULL without a trajectory. Borrowed; do not free.
 */
GG_API const gg_scene *gg_trajectory_scene(const gg_trajectory *trajectory);

/**
 * Number of frames.
 * @param trajectory the trajectory
 * @return number of frames; 0 without a trajectory
 */
GG_API size_t gg_trajectory_frames(const gg_trajectory *trajectory);

/**
 * Read one frame: state and grains, in the order of their numbers.
 * @param trajectory the trajectory
 * @param k frame from 0
 * @param state receives the state; may be NULL
 * @param into the caller's arrays, as for gg_simulation_get_grains(); may be NULL
 * @return GG_OK; GG_BAD_INPUT after the last frame; GG_BAD_FILE if it is damaged
 */
GG_API gg_status gg_trajectory_frame(gg_trajectory *trajectory, size_t k, gg_simulation_state *state,
                                     const gg_grains *into, gg_error *err);

/**
 * One species in the frame that was read last.
 * @param trajectory the trajectory
 * @param species number from 0
 * @param state receives the values, in units of results
 * @return GG_OK; GG_BAD_INPUT before the first frame and after the last species
 */
GG_API gg_status gg_trajectory_get_species(const gg_trajectory *trajectory, int species, gg_species_state *state,
                                           gg_error *err);

/**
 * Write the teaching page, one HTML file. Each release contains it; ./check --page builds it from the sources.
 * @param page the page to be copied; NULL: the installed page, or that of the build folder of the running program
 * @param scene scene that the page starts with; NULL: the page's default
 * @param path file name
 * @return GG_OK; GG_BAD_FILE if there is no page
 */
GG_API gg_status gg_page_write(const char *page, const gg_scene *scene, const char *path, gg_error *err);

/* ---- Comparisons and theories ----
 * Both engines and every theory on one scene; also theories without a simulation, and the file of a run. */

typedef struct gg_comparison gg_comparison;

/**
 * Run both engines and evaluate every theory. An engine that cannot run the scene is left out with its reason.
 * @param scene the scene
 * @param options NULL: default options
 * @param comparison receives the comparison, to be freed by gg_comparison_free()
 * @return as gg_run(); GG_INTERRUPTED while theories are evaluated: no comparison, nothing to resume
 */
GG_API gg_status gg_compare(const gg_scene *scene, const gg_run_options *options, gg_comparison **comparison,
                            gg_error *err);

/**
 * Evaluate the named theories, without simulation. A formula takes microseconds, the
 * noise-free solver up to three seconds. Theories that do not apply have a reason in gg_comparison_theory().
 * @param scene the scene; with a protocol, the gas after the last change
 * @param theory names of theories, separated by commas: "lun1991", "lun1991,grad"; NULL: all
 * @param stop polled on this thread
 * @param comparison receives the answers, to be freed by gg_comparison_free()
 * @return GG_OK, also if none applies; GG_BAD_INPUT, also for an unknown name; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_theories_evaluate(const gg_scene *scene, const char *theory, int (*stop)(void *context),
                                      void *context, gg_comparison **comparison, gg_error *err);

/**
 * Free a comparison.
 * @param comparison may be NULL
 */
GG_API void gg_comparison_free(gg_comparison *comparison);

/**
 * Add a result of the same scene to a comparison. It replaces the result of its engine.
 * @param comparison the comparison
 * @param result the result; owned by the comparison on success
 * @return GG_OK; GG_BAD_INPUT if the scene is another
 */
GG_API gg_status gg_comparison_take(gg_comparison *comparison, gg_result *result, gg_error *err);

/**
 * An engine's result in a comparison.
 * @param comparison the comparison
 * @param engine "md" or "dsmc"
 * @return the result; NULL if there is none. Borrowed; do not free.
 */
GG_API const gg_result *gg_comparison_result(const gg_comparison *comparison, const char *engine);

/**
 * Reason why a comparison has no result of an engine.
 * @param comparison the comparison
 * @param engine "md" or "dsmc"
 * @return the reason; NULL if there is a result. Borrowed; do not free.
 */
GG_API const char *gg_comparison_refusal(const gg_comparison *comparison, const char *engine);

/**
 * Scene of a comparison.
 * @param comparison the comparison
 * @return the scene. Borrowed; do not free.
 */
GG_API const gg_scene *gg_comparison_scene(const gg_comparison *comparison);

/**
 * The i-th key that has no effect on any part of a comparison.
 * @param comparison the comparison
 * @param i index from 0
 * @return the text; NULL after the last. Borrowed; do not free.
 */
GG_API const char *gg_comparison_warning(const gg_comparison *comparison, size_t i);

/**
 * Difference of both engines. "Enskog's equation" below is its noise-free solution if there is one, otherwise dsmc.
 * @param comparison the comparison
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param z receives (md - dsmc) over the combined standard error, NaN if unknown; may be NULL
 * @param beyond receives whether md differs from Enskog's equation by more than expected; may be NULL
 * @return GG_OK; GG_BAD_INPUT for an unknown quantity
 */
GG_API gg_status gg_comparison_agreement(const gg_comparison *comparison, const char *quantity, double *z, int *beyond,
                                         gg_error *err);

#ifndef GG_DEPARTURE_DEFINED /* the library's own files include these lines alone */
#define GG_DEPARTURE_DEFINED
/* Difference of an engine's mean and Enskog's equation solved without random numbers (theory enskog_hermite). */
typedef struct gg_departure {
  double difference, error; /* engine - solution, in units of results; the error combines the engine's standard error
                               and the numerical error of the solution */
  double z;                 /* difference over error */
  double deviation, deviation_error; /* difference and error over the solution; NaN for numbers near 0: N1, N2, a2 */
  int headline;                      /* non-zero: one of the main quantities, those of a comparison's picture */
} gg_departure;

typedef struct gg_comparison_row {  /* one quantity; arrays: md, dsmc */
  const char *name, *symbol, *unit; /* symbol: LaTeX; NULL if user-defined */
  double mean[2], error[2];         /* standard errors; NaN: none */
  double z;                         /* z and beyond: see gg_comparison_agreement() */
  int beyond;
  gg_departure departure[2];
} gg_comparison_row;
#endif

/**
 * Difference of an engine's mean and Enskog's equation solved without random numbers (theory enskog_hermite).
 * @param comparison the comparison
 * @param engine "md" or "dsmc"
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param departure receives the differences; all NaN without a solution or a mean
 * @return GG_OK; GG_BAD_INPUT for an unknown quantity
 */
GG_API gg_status gg_comparison_departure(const gg_comparison *comparison, const char *engine, const char *quantity,
                                         gg_departure *departure, gg_error *err);

/**
 * The i-th quantity of a comparison, in the order of tables.
 * @param comparison the comparison
 * @param i index from 0
 * @param row receives means, errors and differences
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_comparison_at(const gg_comparison *comparison, size_t i, gg_comparison_row *row, gg_error *err);

typedef struct gg_theory_info {
  const char *name, *title, *citation, *assumptions;
  const char *reason; /* why the theory does not apply to this scene; NULL if it does */
  const char *beyond; /* why this scene is out of the theory's range, though it gives values; NULL: within */
} gg_theory_info;

/**
 * The i-th theory of a comparison.
 * @param comparison the comparison
 * @param i index from 0
 * @param theory receives name, source and reason
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_comparison_theory(const gg_comparison *comparison, size_t i, gg_theory_info *theory, gg_error *err);

/**
 * Answer of a theory to a quantity.
 * @param comparison the comparison
 * @param theory name of a theory
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param value receives the answer in units of results; NaN: none
 * @param deviation receives theory/simulation - 1 against md, or dsmc without md; NaN if the simulation is 0 within
 *   its error; may be NULL
 * @return GG_OK; GG_BAD_INPUT for unknown names
 */
GG_API gg_status gg_comparison_theory_value(const gg_comparison *comparison, const char *theory, const char *quantity,
                                            double *value, double *deviation, gg_error *err);

/**
 * T(t) of freely cooling smooth grains of one species and constant e, by Haff's law with the theory's cooling rate.
 * @param comparison the comparison
 * @param theory name of a theory
 * @param time time since the start, in units of results
 * @param temperature receives T, in units of results
 * @return GG_OK; GG_BAD_INPUT without a rate, for another gas, or before the start
 */
GG_API gg_status gg_comparison_theory_cooling(const gg_comparison *comparison, const char *theory, double time,
                                              double *temperature, gg_error *err);

/**
 * Numerical error of an answer.
 * @param comparison the comparison
 * @param theory name of a theory
 * @param quantity name of a quantity (GG_CATALOGUE_QUANTITIES)
 * @param error receives the error; NaN: the answer is exact, or there is none
 * @return GG_OK; GG_BAD_INPUT for unknown names
 */
GG_API gg_status gg_comparison_theory_error(const gg_comparison *comparison, const char *theory, const char *quantity,
                                            double *error, gg_error *err);

/**
 * The i-th curve of a theory, with name and abscissae of the measured curve.
 * @param comparison the comparison
 * @param theory name of a theory
 * @param i index from 0
 * @param curve receives the curve; errors are numerical, values with too large errors NaN
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_comparison_theory_curve(const gg_comparison *comparison, const char *theory, size_t i,
                                            gg_curve_data *curve, gg_error *err);

/**
 * The k-th number of a theory's curve: slip, jump, stress on a wall.
 * @param comparison the comparison
 * @param theory name of a theory
 * @param i index of the curve, from 0
 * @param k number from 0
 * @param number receives value and unit
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_comparison_theory_curve_number(const gg_comparison *comparison, const char *theory, size_t i,
                                                   size_t k, gg_measurement *number, gg_error *err);

#ifndef GG_LOCAL_STATE_DEFINED /* the library's own files include these lines alone */
#define GG_LOCAL_STATE_DEFINED
/* A gas between walls at one height (slopes along y), and its fluxes and loss per volume there; units of profiles. */
typedef struct gg_local_state {
  double solid_fraction, temperature, shear_rate, solid_fraction_slope, temperature_slope;
} gg_local_state;
typedef struct gg_local_fluxes {
  double P_xx, P_yy, P_zz, P_yx, q_y, loss;
} gg_local_fluxes;
#endif

/**
 * Stress and heat flux by the closure of a theory between walls at given states, such as measured ones.
 * @param scene the scene: one species of smooth grains between walls
 * @param theory "navier_stokes", "navier_stokes_hermite" or "moments"
 * @param n number of states
 * @param state n states
 * @param fluxes receives n answers; NaN where the theory has none
 * @return GG_OK; GG_BAD_INPUT for another theory or scene
 */
GG_API gg_status gg_theory_local_fluxes(const gg_scene *scene, const char *theory, size_t n,
                                        const gg_local_state *state, gg_local_fluxes *fluxes, gg_error *err);

typedef struct gg_remark { /* a difference larger than expected */
  const char *theory;      /* NULL: the difference of md and Enskog's equation or dsmc */
  const char *quantity;    /* quantity with the largest deviation; NULL for md and Enskog's equation */
  double deviation;
  const char *cause; /* causes that apply to this scene */
} gg_remark;

/**
 * The i-th remark on a difference larger than expected.
 * @param comparison the comparison
 * @param i index from 0
 * @param remark receives theory, quantity, deviation and cause
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_comparison_remark(const gg_comparison *comparison, size_t i, gg_remark *remark, gg_error *err);

/**
 * The JSON document of `graingas compare --json`.
 * @param comparison the comparison
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_comparison_to_json(const gg_comparison *comparison, char **text, gg_error *err);

/**
 * Write the HDF5 file of a comparison; it appears whole or not at all.
 * @param comparison the comparison
 * @param path file name
 * @return GG_OK; GG_BAD_FILE; GG_INTERRUPTED by stop
 */
GG_API gg_status gg_comparison_write(const gg_comparison *comparison, const char *path, int (*stop)(void *context),
                                     void *context, gg_error *err);

/**
 * Read the file of a comparison, or of a run as a comparison of one.
 * @param path file name
 * @param comparison receives the comparison, to be freed by gg_comparison_free()
 * @return GG_OK; GG_BAD_FILE
 */
GG_API gg_status gg_comparison_read(const char *path, gg_comparison **comparison, gg_error *err);

/**
 * Write a comparison to memory: the bytes of the file that gg_comparison_write() writes.
 * @param comparison the comparison
 * @param bytes receives the bytes, to be freed with free()
 * @param size receives their number
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_comparison_to_bytes(const gg_comparison *comparison, void **bytes, size_t *size, gg_error *err);

/**
 * Read a comparison from the bytes of gg_comparison_to_bytes() or of a file that graingas wrote.
 * @param bytes the bytes
 * @param size their number
 * @param comparison receives the comparison, to be freed by gg_comparison_free()
 * @return GG_OK; GG_BAD_FILE for bytes that are cut off or changed
 */
GG_API gg_status gg_comparison_from_bytes(const void *bytes, size_t size, gg_comparison **comparison, gg_error *err);

/* ---- Sweeps: one scene on a grid of keys ----
 * A folder holds one file per point, FOLDER/NAME.h5, an ordinary result or comparison. NAME is a hash of the point's
 * complete scene and of the command. A point is done when its file exists. A point that ended before its stopping
 * criteria (GG_FAILED of gg_run) has NAME.short.h5 and is done, too. */

typedef struct gg_sweep gg_sweep;

/**
 * Read a sweep: a scene that may have the maps `vary` and `sweep`.
 * @param path file name; "-" is standard input; or the folder of a sweep, which holds the sweep that was run last
 * @param sweep receives the sweep, to be freed by gg_sweep_free()
 * @return GG_OK; GG_BAD_INPUT; GG_BAD_FILE
 */
GG_API gg_status gg_sweep_load(const char *path, gg_sweep **sweep, gg_error *err);

/**
 * Read a sweep from YAML text.
 * @param yaml the text
 * @param name file name for messages; may be NULL
 * @param sweep receives the sweep, to be freed by gg_sweep_free()
 * @return GG_OK; GG_BAD_INPUT
 */
GG_API gg_status gg_sweep_parse(const char *yaml, const char *name, gg_sweep **sweep, gg_error *err);

/**
 * Free a sweep.
 * @param sweep may be NULL
 */
GG_API void gg_sweep_free(gg_sweep *sweep);

/**
 * Set a key of the scene for all points, or a key of the map `sweep` ("sweep.does").
 * @param sweep the sweep
 * @param key key of a scene
 * @param value YAML
 * @return GG_OK; GG_BAD_INPUT, also for a varied key or after gg_sweep_check()
 */
GG_API gg_status gg_sweep_set(gg_sweep *sweep, const char *key, const char *value, gg_error *err);

/**
 * Vary one more key, multiplied with the others.
 * @param sweep the sweep
 * @param key key of a scene
 * @param values "0.1:0.5:0.1" (first, last, step) or "md,dsmc"
 * @return GG_OK; GG_BAD_INPUT, also after gg_sweep_check()
 */
GG_API gg_status gg_sweep_vary(gg_sweep *sweep, const char *key, const char *values, gg_error *err);

/**
 * Check that every point can be simulated. Most calls below do this check first; afterwards the sweep is fixed.
 * @param sweep the sweep
 * @return GG_OK; GG_BAD_INPUT names the first point that cannot be simulated
 */
GG_API gg_status gg_sweep_check(gg_sweep *sweep, gg_error *err);

/**
 * Number of points.
 * @param sweep the sweep
 * @return number of points; 0 before gg_sweep_check()
 */
GG_API size_t gg_sweep_points(const gg_sweep *sweep);

/**
 * Command of the points.
 * @param sweep the sweep
 * @return "run", "compare" or "theory". Borrowed; do not free.
 */
GG_API const char *gg_sweep_does(const gg_sweep *sweep);

typedef struct gg_sweep_point {
  char name[17];      /* name of the point's file, without folder and ending */
  double cpu_seconds; /* expected; see gg_scene_get_needs() */
  int64_t replicas;   /* given in the scene, otherwise chosen (sweep.longest) */
  uint64_t seed;      /* of this point, or of the scene (sweep.seeds) */
} gg_sweep_point;

/**
 * Name, cost, replicas and seed of a point.
 * @param sweep the sweep
 * @param i index from 0
 * @param point receives the values
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_sweep_at(const gg_sweep *sweep, size_t i, gg_sweep_point *point, gg_error *err);

/**
 * Complete scene of a point.
 * @param sweep the sweep
 * @param i index from 0
 * @param scene receives the scene, to be freed by gg_scene_free()
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_sweep_scene(const gg_sweep *sweep, size_t i, gg_scene **scene, gg_error *err);

/**
 * The k-th varied key.
 * @param sweep the sweep
 * @param k number from 0
 * @return the key; NULL after the last. Borrowed; do not free.
 */
GG_API const char *gg_sweep_key(const gg_sweep *sweep, size_t k);

/**
 * Value of the k-th varied key at a point, as YAML.
 * @param sweep the sweep
 * @param i index from 0
 * @param k number from 0
 * @return the value; NULL after the last. Borrowed; do not free.
 */
GG_API const char *gg_sweep_value(const gg_sweep *sweep, size_t i, size_t k);

#ifndef GG_POINT_STATE_DEFINED /* likewise */
#define GG_POINT_STATE_DEFINED
typedef enum gg_point_state {
  GG_POINT_MISSING,
  GG_POINT_DONE,
  GG_POINT_SHORT,       /* done, but ended before its stopping criteria */
  GG_POINT_OTHER_BUILD, /* done by a build with other sources: gg_sweep_run repeats it, unless accept_version is set */
  GG_POINT_DAMAGED      /* the file is damaged: gg_sweep_run repeats the point */
} gg_point_state;
#endif

/**
 * State of a point in a folder.
 * @param sweep the sweep
 * @param folder folder of the results
 * @param i index from 0
 * @param state receives the state
 * @param file receives the file name, to be freed; may be NULL
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_sweep_find(const gg_sweep *sweep, const char *folder, size_t i, gg_point_state *state, char **file,
                               gg_error *err);

/**
 * Every point with values, name, seed and state, as `graingas sweep --list --json` prints it.
 * @param sweep the sweep
 * @param folder folder of the results
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_sweep_to_json(const gg_sweep *sweep, const char *folder, char **text, gg_error *err);

typedef struct gg_sweep_progress {
  size_t points, done;    /* done: in this call or before, with or without the stopping criteria met */
  size_t fell_short;      /* done, but ended before their stopping criteria */
  size_t failed, running; /* running: in progress in this process */
  size_t elsewhere;       /* in progress in other processes that use this folder */
  double time_left;       /* seconds; NaN: not known yet */
  double relative_error;  /* the largest among points in progress; NaN: not known */
} gg_sweep_progress;

/* Default: one thread, no callbacks. Files depend on options only in the times and dates in them. */
typedef struct gg_sweep_options {
  size_t size;         /* sizeof(gg_sweep_options) */
  int threads;         /* for points and their replicas; 0: one */
  const char *command; /* command that made the files, stored in them; NULL: "the graingas library" */
  const char *input;   /* file of the sweep, which no output may replace; NULL: unknown */
  void *context;       /* for the callbacks, on the calling thread; each may be NULL */
  void (*progress)(void *context, const gg_sweep_progress *progress); /* several times a second */
  int (*stop)(void *context); /* polled several times a second; returns non-zero to stop */
  /* Point i ended: GG_OK, GG_FAILED (with a `file`: before its stopping criteria) or GG_BAD_FILE, with the reason. */
  void (*ended)(void *context, size_t i, gg_status status, const char *file, const char *message);
  void (*warn)(void *context, const char *message); /* keys without effect; once for all points */
  gg_workers *workers;                              /* other processes that take part; NULL: none */
  int accept_version; /* non-zero: keep points and checkpoints of another build, whose numbers may differ;
                       * 0: such points run again, and their files stay as NAME.old.h5 */
} gg_sweep_options;

/**
 * Run all unfinished points; the folder is created if missing. Several processes may share a folder; all return when
 * everything is done. Unfinished points resume from checkpoints if the scene has output.checkpoint_every.
 * @param sweep the sweep
 * @param folder folder of the results
 * @param options NULL: default options
 * @return GG_OK; GG_FAILED if points failed or ended before their criteria, also in an earlier call; GG_INTERRUPTED
 */
GG_API gg_status gg_sweep_run(gg_sweep *sweep, const char *folder, const gg_sweep_options *options, gg_error *err);

/**
 * Run one point.
 * @param sweep the sweep
 * @param folder folder of the results
 * @param i index from 0
 * @param options NULL: default options
 * @return as gg_sweep_run()
 */
GG_API gg_status gg_sweep_run_point(gg_sweep *sweep, const char *folder, size_t i, const gg_sweep_options *options,
                                    gg_error *err);

/* Options of gg_sweep_collect(). */
typedef struct gg_collect_options {
  size_t size;         /* sizeof(gg_collect_options) */
  const char *command; /* command that made the files, stored in them; NULL: "the graingas library" */
  const char *picture; /* instead of PREFIX.svg; "none": no picture */
  const char *over;    /* key along x; NULL: the key of numbers with the most values */
  const char *show;    /* quantities, separated by commas, a panel each; NULL: the headline quantities */
  /* Called with the reason if the picture fails and no option of the picture is set; NULL: that is an error. */
  void (*warn)(void *context, const char *message);
  const char *width;       /* width of the picture, as for gg_plot(); NULL: as for a screen */
  const char *log;         /* logarithmic axes: "x", "y", "xy" or "none"; NULL: y where its values span decades */
  const char *relative_to; /* method: the picture shows deviations from this method; NULL: the quantities */
  const char *theories;    /* theories in the picture, separated by commas; NULL: all */
  /* For the lines of the picture, theories are also evaluated between the points, at 25 values of the axis, and stored
   * in FOLDER/lines. */
  int threads;                                                        /* for these evaluations; 0: one */
  void (*progress)(void *context, const gg_sweep_progress *progress); /* of these evaluations; may be NULL */
  int (*stop)(void *context); /* returns non-zero to stop them: lines then end early */
} gg_collect_options;

/**
 * Write the results of all finished points: PREFIX.csv and PREFIX.h5 (a row for each point, method and quantity) and
 * the picture PREFIX.svg. The tables are written even if the picture fails.
 * @param sweep the sweep
 * @param folder folder of the results
 * @param prefix beginning of the file names
 * @param options NULL: default options
 * @param written called with each file name; may be NULL
 * @return GG_OK; GG_FAILED if no point is finished or the picture fails
 */
GG_API gg_status gg_sweep_collect(gg_sweep *sweep, const char *folder, const char *prefix,
                                  const gg_collect_options *options, void (*written)(void *context, const char *file),
                                  void *context, gg_error *err);

/* Output of gg_sweep_validate() beside its verdict. Default: none. */
typedef struct gg_validate_options {
  size_t size;          /* sizeof(gg_validate_options) */
  const char *command;  /* command that made the files, stored in them; NULL: "the graingas library" */
  const char *repeat;   /* command that repeats a point, without its number; NULL: none is printed */
  const char *picture;  /* maps of deviations: "grid.svg" makes grid_temperature.svg and so on; NULL: no maps */
  const char *width;    /* width of the maps, as for gg_plot(); NULL: as for a screen */
  const char *show;     /* quantities, separated by commas, a map each; NULL: the headline quantities */
  const char *theories; /* theories in the maps, separated by commas; NULL: lun1991 */
  const char *page;     /* Markdown with maps, counts and tables; NULL: no page */
  void (*warn)(void *context, const char *message); /* maps that cannot be drawn, points of other builds; may be NULL */
  int json;                                         /* non-zero: the verdict is one JSON document */
  int (*stop)(void *context); /* polled between points and between maps; returns non-zero to interrupt */
} gg_validate_options;

/**
 * Compare all finished points of a sweep (`does: compare`) with Enskog's equation: dsmc with the noise-free solution of
 * the same equation, md and theories with both.
 * @param sweep the sweep
 * @param folder folder of the results
 * @param options NULL: default options
 * @param written called with each file name; may be NULL
 * @param verdict receives counts and tables as Markdown or JSON, to be freed with free(); also with GG_FAILED, else
 * NULL
 * @return GG_OK; GG_FAILED if dsmc and the noise-free solution differ significantly (false alarm: one grid in 1000), if
 *   no point has a steady dsmc and a noise-free solution, or if no point is finished; GG_BAD_INPUT if the sweep does
 * not compare; GG_INTERRUPTED by options->stop: there is no page, maps that were drawn stay
 */
GG_API gg_status gg_sweep_validate(gg_sweep *sweep, const char *folder, const gg_validate_options *options,
                                   void (*written)(void *context, const char *file), void *context, char **verdict,
                                   gg_error *err);

/**
 * Sweep that `graingas validate` runs without a file: uniform shear over density and restitution.
 * @param quick non-zero: the small grid
 * @return the YAML text; never NULL. Borrowed; do not free.
 */
GG_API const char *gg_standard_grid(int quick);

/**
 * Draw pictures of a result file with gnuplot: PICTURE, PICTURE_snapshot and one for each observable with curves.
 * Nothing is drawn if one of them cannot be written.
 * @param result_file file name of a result
 * @param picture file name of the first picture
 * @param format "svg", "png", "pdf" or "gp", a script for gnuplot with its data; NULL: from the file name
 * @param width width on paper, "86mm" (mm, cm, in, pt); NULL: for a screen
 * @param drawn called with each file name; may be NULL
 * @param stop polled between pictures and several times a second while theories are evaluated; returns non-zero to
 *   interrupt; may be NULL
 * @return GG_OK; GG_BAD_FILE; GG_BAD_INPUT if a picture is the result file; GG_INTERRUPTED by stop: pictures that were
 *   drawn stay
 */
GG_API gg_status gg_plot(const char *result_file, const char *picture, const char *format, const char *width,
                         void (*drawn)(void *context, const char *picture), int (*stop)(void *context), void *context,
                         gg_error *err);

/* Files of gg_export(). */
enum {
  GG_EXPORT_RESULTS = 1, /* PREFIX.csv: a line a quantity */
  /* PREFIX_<observable>_<curve>.csv, of comparisons PREFIX_<engine>_<observable>_<curve>.csv; PREFIX_numbers.csv: the
   * numbers derived from the curves */
  GG_EXPORT_CURVES = 2,
  GG_EXPORT_TRAJECTORY = 4, /* PREFIX.xyz: frames of the grains as extended XYZ, if they have positions */
  GG_EXPORT_ALL = 7
};

/**
 * Write tables (CSV) and trajectories (extended XYZ) of a result file. All files are written before the first appears.
 * @param result_file file name of a result
 * @param prefix beginning of the file names
 * @param parts a sum of GG_EXPORT_...
 * @param written called with each file name; may be NULL
 * @param progress called after each frame of a trajectory with the fraction that is written; may be NULL
 * @return GG_OK; GG_BAD_FILE; GG_BAD_INPUT if a file is the result, or the prefix is a device or pipe; GG_FAILED if
 *   the result has none of the parts; GG_INTERRUPTED by stop: no file is written or replaced
 */
GG_API gg_status gg_export(const char *result_file, const char *prefix, unsigned parts,
                           void (*written)(void *context, const char *file),
                           void (*progress)(void *context, double fraction), int (*stop)(void *context), void *context,
                           gg_error *err);

/**
 * Warnings about a readable result file: another program has changed it, or a newer graingas wrote it.
 * @param result_file file name of a result
 * @param text receives one line, cut to size bytes; empty: nothing is unusual
 * @param size size of the buffer in bytes
 * @return GG_OK; GG_BAD_FILE if the file cannot be read
 */
GG_API gg_status gg_result_file_notice(const char *result_file, char *text, size_t size, gg_error *err);

/* ---- Tables of names ---- */

typedef enum gg_catalogue {
  GG_CATALOGUE_KEYS,         /* of scenes: name, type, unit, doc, allowed, value, given, when */
  GG_CATALOGUE_SPECIES_KEYS, /* of one species: the same */
  GG_CATALOGUE_FLOWS,        /* name, doc, traits */
  GG_CATALOGUE_ENGINES,      /* name, doc */
  GG_CATALOGUE_OBSERVABLES,  /* words under `measure`: name, doc */
  GG_CATALOGUE_QUANTITIES,   /* name, unit, doc, symbol, formula, missing, headline, when */
  GG_CATALOGUE_THEORIES      /* name, doc, citation, assumptions, answers, when */
} gg_catalogue;

typedef struct gg_entry { /* NULL or "": not in this table */
  const char *name, *doc, *unit, *citation, *assumptions;
  const char *type;    /* "number", "integer", "choice", "set", "pairs", "vector", "ends", "file", "species" */
  char allowed[256];   /* of a key: "a number from 0 to 1"; of a flow: its thermostats */
  char value[4096];    /* in force in the scene; without a scene the default, "": none */
  int given;           /* non-zero: given in the scene */
  const char *formula; /* of a quantity: its definition, as LaTeX has it */
  const char *missing; /* of a quantity, an observable: why the scene cannot have it; NULL: it can, or none is given */
  const char *answers; /* of a theory: names of quantities, separated by blanks */
  char symbol[48];     /* of a quantity, LaTeX: "T", "\\kappa_{rh}"; "" if user-defined */
  int headline;        /* of a quantity: non-zero if run.relative_error applies to it in the scene */
  char when[256];      /* when a key has an effect, a quantity has a mean, which flows a theory describes */
  char traits[64];     /* of a flow, separated by blanks: sheared, walls, moving_walls, cools, falls, may_fall */
} gg_entry;

/**
 * The i-th entry of a table of names.
 * @param list which table
 * @param i index from 0
 * @param scene determines units, values and availability; NULL: defaults, and units of uniform shear
 * @param entry receives the entry; texts are borrowed
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_catalogue_entry(gg_catalogue list, size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err);

/**
 * The i-th word that a key of type choice or set takes.
 * @param key key of a scene, "flow"
 * @param i index from 0
 * @param entry receives name and doc
 * @return GG_OK; GG_BAD_INPUT after the last one
 */
GG_API gg_status gg_catalogue_word(const char *key, size_t i, gg_entry *entry, gg_error *err);

/**
 * Template of a scene, as YAML: the keys that must be given, and every other key of the flow as a comment with its
 * default.
 * @param flow "usf", or another word of the key flow
 * @param text receives the text, to be freed with free()
 * @return GG_OK; GG_BAD_INPUT: there is no such flow
 */
GG_API gg_status gg_scene_begin(const char *flow, char **text, gg_error *err);

/**
 * JSON Schema (draft 7) of scenes and sweeps. With it editors complete keys and mark errors.
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_schema_to_json(char **text, gg_error *err);

/**
 * References of the program and of methods, as BibTeX.
 * @param words names of engines, theories, contact values and laws, with blanks or commas between them; "": the program
 * @param n receives the number of words that have a reference; NULL: not needed
 * @param text receives the text, to be freed with free()
 * @return GG_OK, or an error status
 */
GG_API gg_status gg_cite(const char *words, size_t *n, char **text, gg_error *err);

/* ---- Words for people ---- */

/**
 * Format a mean and its error: "1.2340(41)" has the standard error in the last digits, "1.23(?)" an unknown one.
 * @param mean the mean
 * @param error its standard error; NaN: unknown
 * @param text receives the text, cut to size bytes
 * @param size size of the buffer in bytes
 */
GG_API void gg_format_estimate(double mean, double error, char *text, size_t size);

/**
 * Spelling suggestion: the known word nearest to a mistyped word.
 * @param word the mistyped word
 * @param known known words; NULL after the last
 * @return the word; NULL if none is near
 */
GG_API const char *gg_nearest_word(const char *word, const char *const *known);

/**
 * Make a text safe to print: control characters, marks of writing direction and bytes that are not UTF-8 become '?'.
 * Messages of this library are safe; names of files and other foreign texts may not be.
 * @param text the text, changed in place; may be NULL
 */
GG_API void gg_text_make_printable(char *text);

/* ---- Extension ----
 * User-defined observables, theories and a restitution law, registered with a scene. Runs, comparisons and evaluations
 * of the scene use them. Their quantities appear under their own names in results, tables, JSON, files and pictures.
 *
 * Definitions are copied, with their strings and tables. A `context` is passed to the callbacks unchanged; the library
 * never frees it. It must be valid as long as the scene and everything that runs from it (results keep names only).
 * Callbacks come from the threads of the run, several at once if replicas or engines run side by side: protect shared
 * data with a lock. Numbers are in units of results.
 *
 * Each call below checks the definition: no member is missing, names are free and valid (letters, digits and _, at most
 * 40), texts are one line of UTF-8. A scene has at most 32 quantities and 8 theories. Otherwise the call returns
 * GG_BAD_INPUT with the reason, and the scene is unchanged. */

/* A user-defined quantity. */
typedef struct gg_quantity_definition {
  const char *name;
  const char *unit; /* as printed; NULL: "1" */
  const char *doc;  /* one line; may be NULL */
} gg_quantity_definition;

/* Input of an observable at the end of a sampling interval (two collisions per grain on average): the grains at that
 * time, and sums over the collisions of the interval. Valid during the call only. */
typedef struct gg_sample {
  double time;    /* since the start */
  double elapsed; /* length of the interval */
  size_t n;       /* grains; in md always in the same order */
  int n_species;
  const double *position;       /* 3 a grain: x y z x y z ...; 0 to box[i]; NULL without positions (dsmc) */
  const double *velocity;       /* 3 a grain; relative to the imposed flow, between walls to the local mean */
  const double *spin;           /* 3 a grain: angular velocity (phi = 0: times d/2); NULL for smooth grains */
  const unsigned char *species; /* of each grain, from 0 */
  const double *mass, *diameter, *inertia; /* of each species; inertia: 4I/(m d^2) */
  double box[3], volume;
  uint64_t collisions;
  double stress[3][3]; /* collisional stress: xx, yy, zz, xy, yx */
  double dissipation;  /* energy lost in collisions per volume and time */
} gg_sample;

/* A collision of two grains, before its impulse. Valid during the call only. */
typedef struct gg_collision_view {
  int species[2];               /* from 0 */
  double normal[3];             /* unit vector from the first grain to the second */
  double relative_velocity[3];  /* of the first centre relative to the second, flow included */
  double velocity[2][3];        /* peculiar, of each */
  double height[2];             /* y above the middle of the box; NaN where there are no positions */
  double time_since_contact[2]; /* of each; INFINITY: none since averaging began */
} gg_collision_view;

/* `sample` sets one number per quantity at the end of every sampling interval. The run computes means over the
 * averaging window, errors and correlation times as for every other quantity. `collision` (may be NULL) is called at
 * every collision between grains while averaging; this costs time, and dsmc then uses slower kernels. Both get
 * `state`: state_size plain bytes, zero at the start, one for each replica, stored in checkpoints. A resumed run needs
 * the same observables. */
typedef struct gg_observable_definition {
  const char *name;
  const char *doc; /* one line; may be NULL */
  int n_quantities;
  const gg_quantity_definition *quantities;
  size_t state_size;
  void (*sample)(void *context, void *state, const gg_sample *sample, double *values);
  void (*collision)(void *context, void *state, const gg_collision_view *collision);
  void *context;
} gg_observable_definition;

/**
 * Register a user-defined observable with a scene; its quantities appear in results, files and pictures.
 * @param scene the scene
 * @param definition copied, except for context
 * @return GG_OK; GG_BAD_INPUT, the scene is unchanged
 */
GG_API gg_status gg_scene_add_observable(gg_scene *scene, const gg_observable_definition *definition, gg_error *err);

typedef struct gg_species_facts {
  double fraction, diameter, mass, inertia; /* mole fraction; inertia: 4I/(m d^2) */
} gg_species_facts;
typedef struct gg_pair_facts {
  double e, beta, mu, diameter, contact_value; /* e of a restitution law: at the mean impact speed at the start */
} gg_pair_facts;

/* Input of a theory: the scene in units of results. Valid during the call only. */
typedef struct gg_facts {
  const char *flow, *thermostat; /* words of the scene */
  const char *restitution_law;   /* its name; NULL: constant e */
  double phi, density;           /* solid fraction, 0: Boltzmann limit; n d^3 (1 in that limit) */
  double shear_rate, gravity[3], box[3];
  double temperature; /* <C.C>/3 at the start */
  double stress_unit; /* factor from stresses in m n_0 v^2, n_0 = 1/d^3, to units of results */
  int n_species;
  const gg_species_facts *species;
  const gg_pair_facts *pairs; /* of species i and j: pairs[n_species*i + j] */
} gg_facts;

/* `evaluate` sets one number for each of `quantities`, which are names of graingas or of user-defined observables, and
 * returns NULL. All numbers are preset to NaN: no value. If the theory does not apply, `evaluate` returns the reason, a
 * text as for gg_callback_fail() that continues the name: "describes free cooling". */
typedef struct gg_theory_definition {
  const char *name;
  const char *title, *citation, *assumptions; /* a line each; may be NULL */
  int n_quantities;
  const char *const *quantities;
  const char *(*evaluate)(void *context, const gg_facts *facts, double *values);
  void *context;
} gg_theory_definition;

/**
 * Register a user-defined theory with a scene.
 * @param scene the scene
 * @param definition copied, except for context
 * @return GG_OK; GG_BAD_INPUT, the scene is unchanged
 */
GG_API gg_status gg_scene_add_theory(gg_scene *scene, const gg_theory_definition *definition, gg_error *err);

/* Coefficient of normal restitution, 0 to 1, of two grains (species from 0) that collide with this relative speed along
 * their normal. Called at every collision of either engine; the same arguments must give the same value. */
typedef double gg_restitution(void *context, double normal_speed, int species_1, int species_2);

/**
 * Set a restitution law for collisions between grains, in place of collision.e and collision.law. It is tested at
 * speeds from 1e-9 to 1e9. Values out of range during a run are clamped (NaN: 0), and the result counts them and warns.
 * dsmc uses slower kernels; theories of constant e do not apply. A resumed run needs the same law, by name.
 * @param scene the scene
 * @param name name of the law
 * @param law the law; NULL: back to collision.e
 * @return GG_OK; GG_BAD_INPUT, the scene is unchanged
 */
GG_API gg_status gg_scene_set_restitution(gg_scene *scene, const char *name, gg_restitution *law, void *context,
                                          gg_error *err);

/**
 * Set a restitution law from a table: linear between speeds, constant beyond the ends.
 * @param scene the scene
 * @param name name of the law
 * @param n number of speeds, at least 1
 * @param speed n ascending speeds, in units of results
 * @param e n coefficients, 0 to 1
 * @return GG_OK; GG_BAD_INPUT, the scene is unchanged
 */
GG_API gg_status gg_scene_set_restitution_table(gg_scene *scene, const char *name, size_t n, const double *speed,
                                                const double *e, gg_error *err);

#ifdef __cplusplus
}
#endif

#endif
