/* An entry: one figure of a paper, as validation/figures/NAME.yaml states it (docs/appendix/reproduction.md says how
 * one is written). Read whole, every key checked; texts are those of the YAML document, which the entry owns. */
#ifndef GG_ENTRY_H
#define GG_ENTRY_H

#include <yaml.h>

#include "reproduce/expression.h"

enum {
  GG_MOST_PANELS = 9,
  GG_MOST_NAMES = 8, /* quantities or curves of a panel, theories, guides */
  GG_MOST_CONDITIONS_OF = 8,
  GG_MOST_SWEEPS = 6,
  GG_MOST_NUMBERS = 32,
  GG_MOST_SETS = 24,
  GG_MOST_ABSCISSAE = 64
};

typedef struct gg_texts {
  int n;
  const char *text[GG_MOST_ABSCISSAE];
} gg_texts;

/* {collision.e: 0.9, phi: [0.1, 0.3]}: a scene key and the values that it may have. */
typedef struct gg_condition_of {
  const char *key;
  gg_texts values;
} gg_condition_of;
typedef struct gg_conditions {
  int n;
  gg_condition_of of[GG_MOST_CONDITIONS_OF];
} gg_conditions;

typedef struct gg_figure_axis {
  const char *label; /* NULL: what it is of by itself */
  gg_expression as;
  bool log;
  double from, to; /* equal: by the data */
} gg_figure_axis;

typedef enum gg_source_kind {
  GG_OF_QUANTITY, /* a mean of the results, over a scene key */
  GG_OF_NUMBER,   /* a number read off a curve, over a scene key or another number of the same curve */
  GG_OF_CURVE,
  GG_OF_SERIES, /* from the start of the run, over time */
  GG_OF_FRAMES, /* the velocity along x over the height, from the frames that were stored */
  GG_OF_SNAPSHOT
} gg_source_kind;

/* What a panel shows, or a number of the paper is set beside. */
typedef struct gg_source {
  gg_source_kind kind;
  gg_texts names;     /* quantities, curves, or the plane of a snapshot */
  const char *number; /* of GG_OF_NUMBER */
  double tail[2];     /* the range of a fit of one's own; equal: as the run fitted it */
  int frame;          /* of GG_OF_SNAPSHOT, from the end */
  bool beside;        /* of GG_OF_CURVE: the law */
  gg_conditions relative_to;
  const char *relative_theory; /* or NULL */
  gg_expression as;
} gg_source;

typedef struct gg_guide {
  const char *label;
  gg_expression as; /* of x */
} gg_guide;

typedef struct gg_figure_panel {
  const char *title;
  gg_texts of; /* names of sweeps; none: all */
  gg_figure_axis x, y;
  const char *key, *number; /* x is over this scene key, or this number of the curve */
  int bins;                 /* of curves: so many neighbours averaged; 1: none */
  gg_source source;
  gg_texts lines, line_labels; /* scene keys, one line for each of their values */
  gg_expression line_as;
  gg_conditions where;
  gg_texts engines; /* none: all there are */
  gg_texts theories, theories_over;
  int n_guides;
  gg_guide guide[GG_MOST_NAMES];
} gg_figure_panel;

typedef enum gg_find {
  GG_FIND_VALUE,
  GG_FIND_ZERO,
  GG_FIND_MINIMUM,
  GG_FIND_MAXIMUM,
  GG_FIND_PREFACTOR,
  GG_FIND_EXPONENT
} gg_find;

/* An explicit number of the paper. */
typedef struct gg_stated {
  const char *what, *where, *sweep, *over;
  double paper, error; /* error: half a unit of the last digit unless given */
  gg_find find;
  gg_source of;
  gg_expression x;
  gg_conditions at;
  gg_texts theories;
} gg_stated;

/* A sweep of the entry: YAML of its own, with the lines of the entry; or that of another figure. */
typedef struct gg_entry_sweep {
  const char *name; /* "" of the only one */
  char *yaml;       /* owned; NULL: of the figure */
  const char *figure;
} gg_entry_sweep;

typedef struct gg_set {
  const char *key, *value; /* value: YAML, owned */
} gg_set;

typedef struct gg_figure_entry {
  const char *file;   /* "thesis-3.05.yaml" */
  const char *figure; /* "thesis 3.5" */
  const char *shows, *cannot, *verdict, *because;
  int n_sweeps, n_panels, n_numbers, n_quick, n_quick_vary;
  gg_entry_sweep sweep[GG_MOST_SWEEPS];
  gg_set quick[GG_MOST_SETS], quick_vary[GG_MOST_SETS];
  gg_figure_panel panel[GG_MOST_PANELS];
  gg_stated number[GG_MOST_NUMBERS];
  yaml_document_t document;
  bool read; /* the document is there to be freed */
} gg_figure_entry;

/* GG_BAD_INPUT "FILE:LINE: key 'KEY': ..."; on failure nothing is left to be freed. */
gg_status gg_reproduce_entry_read(gg_figure_entry *entry, const char *file, const char *yaml, gg_error *err);
void gg_reproduce_entry_clear(gg_figure_entry *entry);

/* What there is, embedded when the program was built, in the order of papers and numbers; ends with a NULL file. */
typedef struct gg_entry_file {
  const char *file, *yaml;
} gg_entry_file;
extern const gg_entry_file gg_entry_files[];
extern const char gg_reproduction_head[]; /* the beginning of docs/appendix/reproduction.md */

#endif
