/* Tables of results: what their documents hold, as CSV, every number as it is there. */
#ifndef GG_EXPORT_TABLES_H
#define GG_EXPORT_TABLES_H

#include "base/csv.h"
#include "files/h5/result_reader.h"

/* Of a run: a line a quantity, with mean, standard error, unit, samples, correlation time, and whether the run was
 * steady. */
void gg_files_csv_results(gg_text_out *out, const gg_stored_result *stored);
/* Of a comparison: a line a quantity, with both engines, z, and what each theory says. */
void gg_files_csv_comparison(gg_text_out *out, const gg_stored_result *stored);
/* A curve: x, mean, standard error, and the law beside it if there is one. */
void gg_files_csv_curve(gg_text_out *out, const json_t *curve);
/* Numbers read off all curves: exponents, coefficients; true if there are any (`out` may be NULL to ask). */
bool gg_files_csv_numbers(gg_text_out *out, const gg_stored_result *stored);

#endif
