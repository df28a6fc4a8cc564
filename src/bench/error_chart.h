/* The picture of `graingas bench error`. */
#ifndef GG_BENCH_ERROR_CHART_H
#define GG_BENCH_ERROR_CHART_H

#include "bench/error_state.h"

/* Of the rough states at e = 0.9: a row a quantity, a column a density. */
gg_status gg_bench_error_chart_draw(const gg_error_state *states, int n, const char *picture, const char *width,
                                    gg_error *err);

#endif
