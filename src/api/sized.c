/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/sized.h"

GG_WRITES(gg_scene_get_needs, gg_scene_needs, needs,
          (const gg_scene *scene, const char *engine, gg_scene_needs *needs, gg_error *err, size_t size),
          (scene, engine, needs, err))
GG_WRITES(gg_simulation_get_state, gg_simulation_state, state,
          (const gg_simulation *simulation, gg_simulation_state *state, gg_error *err, size_t size),
          (simulation, state, err))
GG_WRITES(gg_simulation_get_species, gg_species_state, state,
          (const gg_simulation *simulation, int species, gg_species_state *state, gg_error *err, size_t size),
          (simulation, species, state, err))
GG_READS(gg_simulation_get_grains, gg_grains, into,
         (const gg_simulation *simulation, const gg_grains *into, gg_error *err, size_t size), (simulation, into, err))
GG_READS(gg_simulation_new, gg_start_options, options,
         (const gg_scene *scene, const gg_start_options *options, gg_simulation **simulation, gg_error *err,
          size_t size),
         (scene, options, simulation, err))
GG_READS(gg_simulation_set_grains, gg_grains, grains,
         (gg_simulation * simulation, const gg_grains *grains, size_t n, gg_error *err, size_t size),
         (simulation, grains, n, err))
GG_WRITES(gg_simulation_take_sums, gg_simulation_sums, sums,
          (gg_simulation * simulation, gg_simulation_sums *sums, gg_error *err, size_t size), (simulation, sums, err))
GG_READS(gg_workers_new, gg_messages, messages,
         (const gg_messages *messages, int threads, gg_workers **workers, gg_error *err, size_t size),
         (messages, threads, workers, err))
GG_READS(gg_worker_run, gg_messages, messages, (const gg_messages *messages, gg_error *err, size_t size),
         (messages, err))
GG_READS(gg_run, gg_run_options, options,
         (const gg_scene *scene, const gg_run_options *options, gg_result **result, gg_error *err, size_t size),
         (scene, options, result, err))
GG_WRITES(gg_session_get_progress, gg_progress, progress,
          (const gg_session *session, gg_progress *progress, gg_error *err, size_t size), (session, progress, err))
GG_WRITES(gg_checkpoint_about, gg_checkpoint_info, info,
          (const char *path, gg_checkpoint_info *info, gg_scene **scene, gg_error *err, size_t size),
          (path, info, scene, err))
GG_WRITES(gg_result_find, gg_measurement, found,
          (const gg_result *result, const char *quantity, gg_measurement *found, gg_error *err, size_t size),
          (result, quantity, found, err))
GG_WRITES(gg_result_at, gg_measurement, found,
          (const gg_result *result, size_t i, gg_measurement *found, gg_error *err, size_t size),
          (result, i, found, err))
GG_WRITES(gg_result_get_info, gg_result_info, info,
          (const gg_result *result, gg_result_info *info, gg_error *err, size_t size), (result, info, err))
GG_WRITES(gg_result_curve, gg_curve_data, curve,
          (const gg_result *result, size_t i, gg_curve_data *curve, gg_error *err, size_t size),
          (result, i, curve, err))
GG_WRITES(gg_result_curve_number, gg_measurement, number,
          (const gg_result *result, size_t i, size_t k, gg_measurement *number, gg_error *err, size_t size),
          (result, i, k, number, err))
GG_READS(gg_result_grains, gg_grains, into,
         (const gg_result *result, const gg_grains *into, gg_error *err, size_t size), (result, into, err))
GG_WRITES(gg_trajectory_get_species, gg_species_state, state,
          (const gg_trajectory *trajectory, int species, gg_species_state *state, gg_error *err, size_t size),
          (trajectory, species, state, err))
GG_READS(gg_compare, gg_run_options, options,
         (const gg_scene *scene, const gg_run_options *options, gg_comparison **comparison, gg_error *err, size_t size),
         (scene, options, comparison, err))
GG_WRITES(gg_comparison_departure, gg_departure, departure,
          (const gg_comparison *comparison, const char *engine, const char *quantity, gg_departure *departure,
           gg_error *err, size_t size),
          (comparison, engine, quantity, departure, err))
GG_WRITES(gg_comparison_at, gg_comparison_row, row,
          (const gg_comparison *comparison, size_t i, gg_comparison_row *row, gg_error *err, size_t size),
          (comparison, i, row, err))
GG_WRITES(gg_comparison_theory, gg_theory_info, theory,
          (const gg_comparison *comparison, size_t i, gg_theory_info *theory, gg_error *err, size_t size),
          (comparison, i, theory, err))
GG_WRITES(gg_comparison_theory_curve, gg_curve_data, curve,
          (const gg_comparison *comparison, const char *theory, size_t i, gg_curve_data *curve, gg_error *err,
           size_t size),
          (comparison, theory, i, curve, err))
GG_WRITES(gg_comparison_remark, gg_remark, remark,
          (const gg_comparison *comparison, size_t i, gg_remark *remark, gg_error *err, size_t size),
          (comparison, i, remark, err))
GG_WRITES(gg_catalogue_entry, gg_entry, entry,
          (gg_catalogue list, size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err, size_t size),
          (list, i, scene, entry, err))
GG_WRITES(gg_catalogue_word, gg_entry, entry, (const char *key, size_t i, gg_entry *entry, gg_error *err, size_t size),
          (key, i, entry, err))
GG_READS(gg_scene_add_observable, gg_observable_definition, definition,
         (gg_scene * scene, const gg_observable_definition *definition, gg_error *err, size_t size),
         (scene, definition, err))
GG_READS(gg_scene_add_theory, gg_theory_definition, definition,
         (gg_scene * scene, const gg_theory_definition *definition, gg_error *err, size_t size),
         (scene, definition, err))

gg_status gg_simulation_from_grains_sized(const gg_scene *scene, const gg_grains *grains, size_t n,
                                          const gg_start_options *options, gg_simulation **simulation, gg_error *err,
                                          size_t grains_size, size_t options_size)
{
  gg_grains all_grains = {0};
  GG_SIZE(gg_grains, grains_size);
  if (grains) memcpy(&all_grains, grains, grains_size);
  gg_start_options all_options = {0};
  GG_SIZE(gg_start_options, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_simulation_from_grains(scene, grains ? &all_grains : NULL, n, &all_options, simulation, err);
}

gg_status gg_trajectory_frame_sized(gg_trajectory *trajectory, size_t k, gg_simulation_state *state,
                                    const gg_grains *into, gg_error *err, size_t state_size, size_t into_size)
{
  gg_simulation_state all_state;
  GG_SIZE(gg_simulation_state, state_size);
  gg_grains all_into = {0};
  GG_SIZE(gg_grains, into_size);
  if (into) memcpy(&all_into, into, into_size);
  GG_TRY(gg_trajectory_frame(trajectory, k, state ? &all_state : NULL, into ? &all_into : NULL, err));
  if (state) memcpy(state, &all_state, state_size);
  return GG_OK;
}
