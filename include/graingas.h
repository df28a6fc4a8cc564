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

#ifdef __cplusplus
}
#endif

#endif
