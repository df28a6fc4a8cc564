/* The points of a figure: what its sweeps ran, read back from their files. */
#ifndef GG_FIGURE_POINTS_H
#define GG_FIGURE_POINTS_H

#include "files/h5/result_reader.h"
#include "reproduce/entry.h"

enum { GG_MOST_VARIED_KEYS = 32 };

typedef struct gg_figure_point {
  const char *sweep;                 /* its name in the entry */
  gg_scene scene;                    /* resolved */
  char *varied[GG_MOST_VARIED_KEYS]; /* keys that change from point to point of its sweep; owned */
  size_t n_varied;
  char *path; /* owned */
  gg_stored_result stored;
} gg_figure_point;

typedef struct gg_figure_points {
  size_t n;
  gg_figure_point *point;
} gg_figure_points;

void gg_reproduce_figure_points_clear(gg_figure_points *points);

typedef struct gg_told {
  double mean, error; /* NaN: not known; error 0: exact */
  const char *unit;   /* may be NULL */
} gg_told;
#define GG_NO_VALUE ((gg_told){NAN, NAN, NULL})

/* Value of a scene key as a number; NaN if it is none. And as text for a legend. */
double gg_reproduce_key_number(const gg_scene *scene, const char *key);
void gg_reproduce_key_text(const gg_scene *scene, const char *key, char *text, size_t size);
/* Has the scene one of the values that each condition allows? */
bool gg_reproduce_scene_meets(const gg_scene *scene, const gg_conditions *conditions);
/* Is it of one of these sweeps (none named: of all)? */
bool gg_reproduce_figure_point_of(const gg_figure_point *point, const gg_texts *sweeps);

/* What an engine says: a mean, a number read off a curve. */
gg_told gg_reproduce_figure_quantity(const gg_figure_point *point, int engine, const char *quantity);
gg_told gg_reproduce_figure_curve_number(const gg_figure_point *point, int engine, const char *curve,
                                         const char *number, const double tail[2]);
const json_t *gg_reproduce_figure_curve(const gg_figure_point *point, int engine, const char *curve);
/* What a theory says, at another value of a scene key where `key` is not NULL. */
gg_told gg_reproduce_figure_theory(const gg_figure_point *point, const char *theory, const char *quantity,
                                   const char *key, double at);

/* The same, with `as` and what it is relative to; `name`: which of the source's. Engine or theory: one of them. */
typedef struct gg_asked {
  const gg_figure_points *points;
  const gg_source *source;
  const char *name;
  int engine;         /* -1: a theory's */
  const char *theory; /* over `key` at `at`, if that is not NULL */
  const char *key;
  double at;
} gg_asked;
gg_told gg_reproduce_figure_value(const gg_asked *asked, const gg_figure_point *point, double x);

#endif
