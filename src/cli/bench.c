/* graingas bench: throughput of the engines, by kernel, size and density. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/table.h"
#include "common/model.h"
#include "io/document.h"
#include "run/throughput.h"

/* What is timed: sheared at e = 0.9, the tap open as in a measuring run. */
static const struct {
  const char *name;
  double beta, mu;
} kernels[] = {{"smooth", -1, INFINITY}, {"rough", 0, INFINITY}, {"frictional", 0.4, 0.123}};
enum { N_KERNELS = sizeof kernels / sizeof *kernels };

static const double densities[] = {0.01, 0.3};
static const int64_t sizes[] = {1000, 10000, 100000};
enum { N_DENSITIES = 2, N_SIZES = 3 };

typedef struct bench {
  const gg_options *options;
  gg_table *table;
  json_t *rows;
} bench;

static gg_scene scene_of(gg_engine_kind engine, int kernel, double phi, int64_t n)
{
  gg_scene s = gg_scene_defaults();
  s.engine = engine;
  s.phi = phi;
  s.particles = s.dsmc.particles = n;
  s.collision.beta[0] = kernels[kernel].beta;
  s.collision.mu[0] = kernels[kernel].mu;
  return s;
}

static void note(bench *b, const char *engine, double phi, int64_t n, const gg_throughput t[N_KERNELS])
{
  int row = gg_table_row(b->table);
  snprintf(gg_table_cell(b->table, row, 0), GG_TABLE_CELL, "%s", engine);
  snprintf(gg_table_cell(b->table, row, 1), GG_TABLE_CELL, "%g", phi);
  snprintf(gg_table_cell(b->table, row, 2), GG_TABLE_CELL, "%lld", (long long)n);
  for (int k = 0; k < N_KERNELS; k++) {
    snprintf(gg_table_cell(b->table, row, 3 + k), GG_TABLE_CELL, "%.3g M/s (%.0f ns)", t[k].rate * 1e-6,
             1e9 / t[k].rate);
    json_array_append_new(b->rows,
                          json_pack("{s:s, s:f, s:I, s:s, s:f, s:f, s:f, s:s}", "engine", engine, "phi", phi,
                                    "particles", (json_int_t)n, "kernel", kernels[k].name, "mean", t[k].rate, "slowest",
                                    t[k].slowest, "fastest", t[k].fastest, "unit", "collisions per CPU-second"));
  }
  if (!b->options->quiet) fprintf(stderr, "%s phi %g N %lld done\n", engine, phi, (long long)n);
}

static gg_status measure(bench *b, gg_engine_kind engine, gg_error *err)
{
  bool quick = b->options->quick;
  for (int d = 0; d < N_DENSITIES; d++)
    for (int i = 0; i < (quick ? N_SIZES - 1 : N_SIZES); i++) {
      gg_throughput t[N_KERNELS];
      for (int k = 0; k < N_KERNELS; k++) {
        gg_scene s = scene_of(engine, k, densities[d], sizes[i]);
        GG_TRY(gg_measure_throughput(&s, true, 20, quick ? 3 : 5, quick ? 0.2 : 0.6, &t[k], err));
      }
      note(b, gg_engine_ops_of(engine)->name, densities[d], sizes[i], t);
    }
  return GG_OK;
}

static void start_table(bench *b)
{
  gg_table_column(b->table, "engine", false);
  gg_table_column(b->table, "phi", true);
  gg_table_column(b->table, "N", true);
  for (int k = 0; k < N_KERNELS; k++) gg_table_column(b->table, kernels[k].name, true);
}

static int print(const bench *b)
{
  if (b->options->json) {
    json_t *document = json_pack("{s:s, s:O}", "graingas", gg_version(), "throughput", b->rows);
    char *text = gg_document_text(document);
    if (text) puts(text);
    free(text);
    json_decref(document);
  } else {
    printf("Collisions per CPU-second, one core; uniform shear, e = 0.9, stress measured; median of repeats\n\n");
    gg_table_print(b->table, stdout, gg_terminal_width(), 3);
  }
  return fflush(stdout) == 0 ? GG_OK : gg_cli_fail(GG_BAD_FILE, "standard output cannot be written");
}

static int run(bench *b, const char *which)
{
  gg_error err;
  for (int k = GG_MD; k <= GG_DSMC; k++) {
    if (which && strcmp(which, gg_engine_ops_of((gg_engine_kind)k)->name) != 0) continue;
    if (measure(b, (gg_engine_kind)k, &err) != GG_OK) return gg_cli_report(&err);
  }
  return print(b);
}

int gg_cli_bench_main(const gg_command *command, int argc, char **argv)
{
  gg_options o;
  int code = gg_options_parse(command, argc, argv, &o);
  if (code == GG_CLI_GO_ON && o.input && strcmp(o.input, "md") != 0 && strcmp(o.input, "dsmc") != 0)
    code = gg_cli_fail(GG_BAD_INPUT, "bench: '%s' is not an engine; allowed: md, dsmc", o.input);
  if (code == GG_CLI_GO_ON) {
    bench b = {.options = &o, .table = gg_table_new(), .rows = json_array()};
    if (b.table && b.rows) {
      start_table(&b);
      code = run(&b, o.input);
    } else {
      code = gg_cli_fail(GG_FAILED, "out of memory");
    }
    free(b.table);
    json_decref(b.rows);
  }
  gg_options_clear(&o);
  return code;
}
