/* graingas bench: how fast things are. A subject measures and fills sheets; it is a file of its own and a line in
 * bench.c's table. */
#ifndef GG_BENCH_H
#define GG_BENCH_H

#include "bench/bench_table.h"
#include "common/scene.h"

typedef struct gg_bench_options {
  bool quick;          /* fewer sizes, shorter stretches */
  const char *picture; /* of "error": file to draw, .svg, .png or .pdf; NULL: none */
  const char *width;   /* of the picture, "86mm"; NULL: free */
  int threads;         /* that one engine may use where threads are measured */
  double smaller; /* so many times fewer grains and shorter stretches: what is measured says little; 0: as they are */
  int n_overrides;
  const char *const *override; /* "KEY=VALUE" of a scene; only run.seed matters */
  void *context;
  void (*tell)(void *context, const char *line); /* progress; NULL: not wanted */
} gg_bench_options;

enum { GG_BENCH_SHEETS = 8 };
typedef struct gg_bench {
  const gg_bench_options *options;
  uint64_t seed;
  bool measured; /* the sheets are whole, whatever became of the picture */
  int n_sheets;
  gg_bench_sheet *sheet[GG_BENCH_SHEETS];
} gg_bench;

/* Measure a subject: "md", "dsmc", "observables", "error"; NULL for the overview. Clear *bench whatever comes of it. */
gg_status gg_bench_run(gg_bench *bench, const char *subject, const gg_bench_options *options, gg_error *err);
void gg_bench_clear(gg_bench *bench);
/* All rows as one JSON document; to be freed. NULL if out of memory. */
char *gg_bench_document(const gg_bench *bench);

/* For subjects. */
typedef gg_status gg_bench_subject(gg_bench *bench, gg_error *err);
gg_bench_subject gg_bench_overview, gg_bench_md, gg_bench_dsmc, gg_bench_observables, gg_bench_error;

/* A new, empty sheet, owned by the bench; NULL with the message if out of memory. Strings must be literals. */
gg_bench_sheet *gg_bench_new_sheet(gg_bench *bench, const char *key, const char *caption, int keep, gg_error *err);
void gg_bench_tell(const gg_bench *bench, const char *format, ...) GG_PRINTF(2, 3);
/* The defaults with this bench's seed; and seconds of a stretch: less where the options say so. */
gg_scene gg_bench_scene(const gg_bench *bench, gg_engine_kind engine, double phi, int64_t n);
double gg_bench_seconds(const gg_bench *bench, double seconds);

#endif
