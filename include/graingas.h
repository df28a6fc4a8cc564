/* graingas: granular gases of hard spheres by event-driven molecular dynamics and Enskog Monte Carlo.
 *
 * The whole public interface. Every call that can fail returns a gg_status (0 is success; the values are the exit codes
 * of the graingas command) and, where the caller passes a gg_error, leaves a message there. The library never exits and
 * never prints. Objects made by a `_new`, `_load` or `_run` call belong to the caller, who frees them with the matching
 * `_free`. No global state: different objects may be used from different threads.
 *
 * Quantities and their units are those of `graingas info`: lengths in the diameter and masses in the mass of species 1;
 * sheared flows in units of the shear rate, others in the initial thermal speed v_0 = sqrt(2T/m). */
#ifndef GRAINGAS_H
#define GRAINGAS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define GG_API __attribute__((visibility("default")))
#else
#define GG_API
#endif

typedef enum gg_status {
  GG_OK = 0,
  GG_FAILED = 1,       /* the run failed or fell short of what was asked */
  GG_BAD_INPUT = 2,    /* the scene or an argument is wrong */
  GG_BAD_FILE = 3,     /* a file could not be read or written */
  GG_INTERRUPTED = 130 /* stopped by the caller */
} gg_status;

typedef struct gg_error {
  gg_status status;
  char message[1024];
} gg_error;

typedef struct gg_scene gg_scene;   /* what to simulate */
typedef struct gg_result gg_result; /* what came out */

GG_API const char *gg_version(void);

/* A scene from a YAML file. */
GG_API gg_status gg_scene_load(const char *path, gg_scene **scene, gg_error *err);
/* A scene from YAML text; `name` stands for the file name in messages. */
GG_API gg_status gg_scene_parse(const char *yaml, const char *name, gg_scene **scene, gg_error *err);
/* Set one value, e.g. gg_scene_set(scene, "collision.e", "0.9", &err); the scene is unchanged on failure. */
GG_API gg_status gg_scene_set(gg_scene *scene, const char *key, const char *value, gg_error *err);
GG_API void gg_scene_free(gg_scene *scene);

/* Run the scene's engine to the end that the scene asks for. GG_FAILED with *result set: the run ended short of what
 * was asked (no steady state, time limit) and the result says how far it came. */
GG_API gg_status gg_run(const gg_scene *scene, gg_result **result, gg_error *err);

/* One measured mean and its standard error by its shared name ("temperature", "shear_viscosity", "N1" ...).
 * GG_BAD_INPUT for a name that the run did not measure, with the reason. Either pointer may be NULL. */
GG_API gg_status gg_result_get(const gg_result *result, const char *quantity, double *mean, double *stderr_,
                               gg_error *err);
GG_API const char *gg_result_unit(const gg_result *result, const char *quantity); /* NULL if not measured */
GG_API int gg_result_is_steady(const gg_result *result);
/* Write the HDF5 (H5MD) result file: complete, or not at all. */
GG_API gg_status gg_result_write(const gg_result *result, const char *path, gg_error *err);
GG_API void gg_result_free(gg_result *result);

/* ---- Extension -----------------------------------------------------------------------------------------------------
 *
 * Observables, theories and a restitution law of one's own, registered with a scene. What is run, compared or evaluated
 * from it uses them; their quantities stand under their own names beside all others in results, tables, JSON documents,
 * files and pictures.
 *
 * Definitions are copied, strings and tables included. A `context` stays the caller's, is handed to the callbacks as it
 * is, and must live for as long as the scene and whatever runs from it (results keep no more than names). Callbacks come
 * from the threads of the run, several at once where replicas or engines run side by side: they must not write to what
 * they share without a lock. Numbers have the units of results. Each call below returns GG_BAD_INPUT with the reason, and
 * leaves the scene as it was, if something is missing, a name is taken or is no name (letters, digits and _, at most 40),
 * or if there are too many: 32 quantities, 8 theories a scene. */

/* A quantity of one's own. */
typedef struct gg_quantity_definition {
  const char *name;
  const char *unit; /* as it is to be printed; NULL: "1" */
  const char *doc;  /* one line; may be NULL */
} gg_quantity_definition;

/* What an observable is shown at the end of a sampling interval (two collisions a grain on average): the grains then,
 * and what the collisions of the interval came to. Valid during the call only. */
typedef struct gg_sample {
  double time;    /* since the start */
  double elapsed; /* length of the interval */
  size_t n;       /* grains; in md always in the same order */
  int n_species;
  const double (*position)[3];  /* in the box, 0 to its edges; NULL where there are no positions (dsmc) */
  const double (*velocity)[3];  /* peculiar: less the imposed flow; between walls less the local mean */
  const double (*spin)[3];      /* angular velocity (Boltzmann limit: times d/2); NULL for smooth grains */
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
  double relative_velocity[3];  /* of the first centre against the second, the flow between them included */
  double velocity[2][3];        /* peculiar, of each */
  double height[2];             /* y above the middle of the box; NaN where there are no positions */
  double time_since_contact[2]; /* of each; INFINITY: none since averaging began */
} gg_collision_view;

/* `sample` sets one number a quantity, at every interval from the start of the run; means over the averaging window,
 * their errors and correlation times are taken as of every other quantity. `collision` (may be NULL) is shown every
 * collision between grains while averaging: that costs time, and dsmc leaves its fast kernels for it. Both get `state`:
 * state_size plain bytes, zero at the start, one for each replica, kept in checkpoints. A run that is resumed needs the
 * same observables. */
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
GG_API gg_status gg_scene_add_observable(gg_scene *scene, const gg_observable_definition *definition, gg_error *err);

typedef struct gg_species_facts {
  double fraction, diameter, mass, inertia; /* mole fraction; inertia: 4I/(m d^2) */
} gg_species_facts;
typedef struct gg_pair_facts {
  double e, beta, mu, diameter, contact_value; /* e of a restitution law: that of the mean impact at the start */
} gg_pair_facts;

/* A scene as theories see it, in the units of results. Valid during the call only. */
typedef struct gg_facts {
  const char *flow, *thermostat; /* words of the scene */
  const char *restitution_law;   /* its name; NULL: constant e */
  double phi, density;           /* solid fraction, 0: Boltzmann limit; n d^3 (1 in that limit) */
  double shear_rate, gravity[3], box[3];
  double temperature; /* <C.C>/3 at the start */
  double stress_unit; /* a stress in units of m n_0 v^2, n_0 = 1/d^3, times this is one in units of results */
  int n_species;
  const gg_species_facts *species;
  const gg_pair_facts *pairs; /* of species i and j: pairs[n_species*i + j] */
} gg_facts;

/* `evaluate` sets one number for each of `quantities`, names of shared quantities or of the scene's own observables
 * (NaN, as which all are preset: no answer), and returns NULL; or the reason why the theory does not apply. */
typedef struct gg_theory_definition {
  const char *name;
  const char *title, *citation, *assumptions; /* a line each; may be NULL */
  int n_quantities;
  const char *const *quantities;
  const char *(*evaluate)(void *context, const gg_facts *facts, double *values);
  void *context;
} gg_theory_definition;
GG_API gg_status gg_scene_add_theory(gg_scene *scene, const gg_theory_definition *definition, gg_error *err);

/* Coefficient of normal restitution, 0 to 1, of two grains (species from 0) that meet with this relative speed along
 * their normal, instead of collision.e (walls keep theirs). Asked at every collision of either engine; the same
 * arguments must have the same answer. It is tried at speeds from 1e-9 to 1e9 when it is registered; what it
 * returns out of range during a run is taken as the nearer end. dsmc leaves its fast kernels for it; theories of constant
 * e do not apply. A run that is resumed needs the same law; its name tells. NULL: back to collision.e. */
typedef double gg_restitution(void *context, double normal_speed, int species_1, int species_2);
GG_API gg_status gg_scene_set_restitution(gg_scene *scene, const char *name, gg_restitution *law, void *context,
                                          gg_error *err);
/* The same from a table of n >= 1 ascending speeds: linear between them, constant beyond the ends. */
GG_API gg_status gg_scene_set_restitution_table(gg_scene *scene, const char *name, size_t n, const double *speed,
                                                const double *e, gg_error *err);

#ifdef __cplusplus
}
#endif

#endif
