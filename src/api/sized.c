/* Functions with the sizes of the caller's structs (graingas.h, "Sizes"): what the caller's compiler did not know of
 * is zero where it is read, and left out where it is written. */
#include "api/sized.h"

gg_status gg_scene_get_needs_sized(const gg_scene *scene, const char *engine, gg_scene_needs *needs, gg_error *err,
                                   size_t needs_size)
{
  gg_scene_needs all_needs;
  GG_SIZE(gg_scene_needs, needs_size);
  GG_TRY(gg_scene_get_needs(scene, engine, needs ? &all_needs : NULL, err));
  if (needs) memcpy(needs, &all_needs, needs_size);
  return GG_OK;
}

gg_status gg_simulation_get_state_sized(const gg_simulation *simulation, gg_simulation_state *state, gg_error *err,
                                        size_t state_size)
{
  gg_simulation_state all_state;
  GG_SIZE(gg_simulation_state, state_size);
  GG_TRY(gg_simulation_get_state(simulation, state ? &all_state : NULL, err));
  if (state) memcpy(state, &all_state, state_size);
  return GG_OK;
}

gg_status gg_simulation_get_species_sized(const gg_simulation *simulation, int species, gg_species_state *state,
                                          gg_error *err, size_t state_size)
{
  gg_species_state all_state;
  GG_SIZE(gg_species_state, state_size);
  GG_TRY(gg_simulation_get_species(simulation, species, state ? &all_state : NULL, err));
  if (state) memcpy(state, &all_state, state_size);
  return GG_OK;
}

gg_status gg_simulation_get_grains_sized(const gg_simulation *simulation, const gg_grains *into, gg_error *err,
                                         size_t into_size)
{
  gg_grains all_into = {0};
  GG_SIZE(gg_grains, into_size);
  if (into) memcpy(&all_into, into, into_size);
  return gg_simulation_get_grains(simulation, into ? &all_into : NULL, err);
}

gg_status gg_simulation_from_grains_sized(const gg_scene *scene, const gg_grains *grains, size_t n, uint64_t stream,
                                          gg_simulation **simulation, gg_error *err, size_t grains_size)
{
  gg_grains all_grains = {0};
  GG_SIZE(gg_grains, grains_size);
  if (grains) memcpy(&all_grains, grains, grains_size);
  return gg_simulation_from_grains(scene, grains ? &all_grains : NULL, n, stream, simulation, err);
}

gg_status gg_simulation_set_grains_sized(gg_simulation *simulation, const gg_grains *grains, size_t n, gg_error *err,
                                         size_t grains_size)
{
  gg_grains all_grains = {0};
  GG_SIZE(gg_grains, grains_size);
  if (grains) memcpy(&all_grains, grains, grains_size);
  return gg_simulation_set_grains(simulation, grains ? &all_grains : NULL, n, err);
}

gg_status gg_simulation_take_sums_sized(gg_simulation *simulation, gg_simulation_sums *sums, gg_error *err,
                                        size_t sums_size)
{
  gg_simulation_sums all_sums;
  GG_SIZE(gg_simulation_sums, sums_size);
  GG_TRY(gg_simulation_take_sums(simulation, sums ? &all_sums : NULL, err));
  if (sums) memcpy(sums, &all_sums, sums_size);
  return GG_OK;
}

gg_status gg_workers_new_sized(const gg_messages *messages, int threads, gg_workers **workers, gg_error *err,
                               size_t messages_size)
{
  gg_messages all_messages = {0};
  GG_SIZE(gg_messages, messages_size);
  if (messages) memcpy(&all_messages, messages, messages_size);
  return gg_workers_new(messages ? &all_messages : NULL, threads, workers, err);
}

gg_status gg_worker_run_sized(const gg_messages *messages, gg_error *err, size_t messages_size)
{
  gg_messages all_messages = {0};
  GG_SIZE(gg_messages, messages_size);
  if (messages) memcpy(&all_messages, messages, messages_size);
  return gg_worker_run(messages ? &all_messages : NULL, err);
}

gg_status gg_run_sized(const gg_scene *scene, const gg_run_options *options, gg_result **result, gg_error *err,
                       size_t options_size)
{
  gg_run_options all_options = {0};
  GG_SIZE(gg_run_options, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_run(scene, options ? &all_options : NULL, result, err);
}

gg_status gg_session_get_progress_sized(const gg_session *session, gg_progress *progress, gg_error *err,
                                        size_t progress_size)
{
  gg_progress all_progress;
  GG_SIZE(gg_progress, progress_size);
  GG_TRY(gg_session_get_progress(session, progress ? &all_progress : NULL, err));
  if (progress) memcpy(progress, &all_progress, progress_size);
  return GG_OK;
}

gg_status gg_checkpoint_about_sized(const char *path, gg_checkpoint_info *info, gg_scene **scene, gg_error *err,
                                    size_t info_size)
{
  gg_checkpoint_info all_info;
  GG_SIZE(gg_checkpoint_info, info_size);
  GG_TRY(gg_checkpoint_about(path, info ? &all_info : NULL, scene, err));
  if (info) memcpy(info, &all_info, info_size);
  return GG_OK;
}

gg_status gg_result_find_sized(const gg_result *result, const char *quantity, gg_measurement *found, gg_error *err,
                               size_t found_size)
{
  gg_measurement all_found;
  GG_SIZE(gg_measurement, found_size);
  GG_TRY(gg_result_find(result, quantity, found ? &all_found : NULL, err));
  if (found) memcpy(found, &all_found, found_size);
  return GG_OK;
}

gg_status gg_result_at_sized(const gg_result *result, size_t i, gg_measurement *found, gg_error *err, size_t found_size)
{
  gg_measurement all_found;
  GG_SIZE(gg_measurement, found_size);
  GG_TRY(gg_result_at(result, i, found ? &all_found : NULL, err));
  if (found) memcpy(found, &all_found, found_size);
  return GG_OK;
}

gg_status gg_result_get_info_sized(const gg_result *result, gg_result_info *info, gg_error *err, size_t info_size)
{
  gg_result_info all_info;
  GG_SIZE(gg_result_info, info_size);
  GG_TRY(gg_result_get_info(result, info ? &all_info : NULL, err));
  if (info) memcpy(info, &all_info, info_size);
  return GG_OK;
}

gg_status gg_result_curve_sized(const gg_result *result, size_t i, gg_curve_data *curve, gg_error *err,
                                size_t curve_size)
{
  gg_curve_data all_curve;
  GG_SIZE(gg_curve_data, curve_size);
  GG_TRY(gg_result_curve(result, i, curve ? &all_curve : NULL, err));
  if (curve) memcpy(curve, &all_curve, curve_size);
  return GG_OK;
}

gg_status gg_result_curve_number_sized(const gg_result *result, size_t i, size_t k, gg_measurement *number,
                                       gg_error *err, size_t number_size)
{
  gg_measurement all_number;
  GG_SIZE(gg_measurement, number_size);
  GG_TRY(gg_result_curve_number(result, i, k, number ? &all_number : NULL, err));
  if (number) memcpy(number, &all_number, number_size);
  return GG_OK;
}

gg_status gg_result_grains_sized(const gg_result *result, const gg_grains *into, gg_error *err, size_t into_size)
{
  gg_grains all_into = {0};
  GG_SIZE(gg_grains, into_size);
  if (into) memcpy(&all_into, into, into_size);
  return gg_result_grains(result, into ? &all_into : NULL, err);
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

gg_status gg_trajectory_get_species_sized(const gg_trajectory *trajectory, int species, gg_species_state *state,
                                          gg_error *err, size_t state_size)
{
  gg_species_state all_state;
  GG_SIZE(gg_species_state, state_size);
  GG_TRY(gg_trajectory_get_species(trajectory, species, state ? &all_state : NULL, err));
  if (state) memcpy(state, &all_state, state_size);
  return GG_OK;
}

gg_status gg_compare_sized(const gg_scene *scene, const gg_run_options *options, gg_comparison **comparison,
                           gg_error *err, size_t options_size)
{
  gg_run_options all_options = {0};
  GG_SIZE(gg_run_options, options_size);
  if (options) memcpy(&all_options, options, options_size);
  return gg_compare(scene, options ? &all_options : NULL, comparison, err);
}

gg_status gg_comparison_departure_sized(const gg_comparison *comparison, const char *engine, const char *quantity,
                                        gg_departure *departure, gg_error *err, size_t departure_size)
{
  gg_departure all_departure;
  GG_SIZE(gg_departure, departure_size);
  GG_TRY(gg_comparison_departure(comparison, engine, quantity, departure ? &all_departure : NULL, err));
  if (departure) memcpy(departure, &all_departure, departure_size);
  return GG_OK;
}

gg_status gg_comparison_at_sized(const gg_comparison *comparison, size_t i, gg_comparison_row *row, gg_error *err,
                                 size_t row_size)
{
  gg_comparison_row all_row;
  GG_SIZE(gg_comparison_row, row_size);
  GG_TRY(gg_comparison_at(comparison, i, row ? &all_row : NULL, err));
  if (row) memcpy(row, &all_row, row_size);
  return GG_OK;
}

gg_status gg_comparison_theory_sized(const gg_comparison *comparison, size_t i, gg_theory_info *theory, gg_error *err,
                                     size_t theory_size)
{
  gg_theory_info all_theory;
  GG_SIZE(gg_theory_info, theory_size);
  GG_TRY(gg_comparison_theory(comparison, i, theory ? &all_theory : NULL, err));
  if (theory) memcpy(theory, &all_theory, theory_size);
  return GG_OK;
}

gg_status gg_comparison_theory_curve_sized(const gg_comparison *comparison, const char *theory, size_t i,
                                           gg_curve_data *curve, gg_error *err, size_t curve_size)
{
  gg_curve_data all_curve;
  GG_SIZE(gg_curve_data, curve_size);
  GG_TRY(gg_comparison_theory_curve(comparison, theory, i, curve ? &all_curve : NULL, err));
  if (curve) memcpy(curve, &all_curve, curve_size);
  return GG_OK;
}

gg_status gg_comparison_remark_sized(const gg_comparison *comparison, size_t i, gg_remark *remark, gg_error *err,
                                     size_t remark_size)
{
  gg_remark all_remark;
  GG_SIZE(gg_remark, remark_size);
  GG_TRY(gg_comparison_remark(comparison, i, remark ? &all_remark : NULL, err));
  if (remark) memcpy(remark, &all_remark, remark_size);
  return GG_OK;
}

gg_status gg_catalogue_entry_sized(gg_catalogue list, size_t i, const gg_scene *scene, gg_entry *entry, gg_error *err,
                                   size_t entry_size)
{
  gg_entry all_entry;
  GG_SIZE(gg_entry, entry_size);
  GG_TRY(gg_catalogue_entry(list, i, scene, entry ? &all_entry : NULL, err));
  if (entry) memcpy(entry, &all_entry, entry_size);
  return GG_OK;
}

gg_status gg_catalogue_word_sized(const char *key, size_t i, gg_entry *entry, gg_error *err, size_t entry_size)
{
  gg_entry all_entry;
  GG_SIZE(gg_entry, entry_size);
  GG_TRY(gg_catalogue_word(key, i, entry ? &all_entry : NULL, err));
  if (entry) memcpy(entry, &all_entry, entry_size);
  return GG_OK;
}

gg_status gg_scene_add_observable_sized(gg_scene *scene, const gg_observable_definition *definition, gg_error *err,
                                        size_t definition_size)
{
  gg_observable_definition all_definition = {0};
  GG_SIZE(gg_observable_definition, definition_size);
  if (definition) memcpy(&all_definition, definition, definition_size);
  return gg_scene_add_observable(scene, definition ? &all_definition : NULL, err);
}

gg_status gg_scene_add_theory_sized(gg_scene *scene, const gg_theory_definition *definition, gg_error *err,
                                    size_t definition_size)
{
  gg_theory_definition all_definition = {0};
  GG_SIZE(gg_theory_definition, definition_size);
  if (definition) memcpy(&all_definition, definition, definition_size);
  return gg_scene_add_theory(scene, definition ? &all_definition : NULL, err);
}
