/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of the keys of a scene, and what follows from it: defaults, the reader, --set, range checks, `graingas
 * info`, the scene echoed in results, what a checkpoint is compared with when a run is resumed, and the manual. A new
 * key is a member of gg_scene and a row of fields.c. */
#ifndef GG_SCENE_FIELDS_H
#define GG_SCENE_FIELDS_H

#include <jansson.h>
#include <stdio.h>

#include "base/archive.h"
#include "base/text.h"
#include "io/file_writer.h"
#include "scene/conditions.h"
#include "scene/scene.h"

typedef enum gg_field_type {
  GG_FIELD_NUMBER,  /* double */
  GG_FIELD_INTEGER, /* int64_t */
  GG_FIELD_CHOICE,  /* an enum: one of `words` */
  GG_FIELD_SET,     /* unsigned bits: a list of `words` */
  GG_FIELD_PAIRS,   /* double[GG_PAIRS]: a number, or a map by pair: {11: , 12: , other: } */
  GG_FIELD_VECTOR,  /* double[3] */
  GG_FIELD_ENDS,    /* double[2], lower and upper wall: a number for both, or a list of two */
  GG_FIELD_LIST,    /* double[GG_LOCAL_DENSITIES]: a list of different numbers, up to a 0; the special word: none */
  GG_FIELD_ERRORS,  /* double[GG_MAX_UNTIL]: a map by quantity: {N1: 0.01} */
  GG_FIELD_RATE,    /* double, then char[GG_FORMULA_TEXT]: a number, or a formula of t */
  GG_FIELD_FILE,    /* char[GG_FILE_NAME]: the name of a file with one of the endings `words`; "": none */
  GG_FIELD_CHANGES, /* gg_change[GG_MAX_CHANGES]: a list of maps {at: TIME, KEY: VALUE, ...} */
  GG_FIELD_SPECIES  /* gg_species[]: a list of maps, whose members are gg_scene_species_fields */
} gg_field_type;

/* A type's name in catalogues; how a value stands in memory, and so in archives; of numbers what is allowed, before
 * their limits. */
typedef struct gg_field_kind {
  const char *name;
  gg_item_type item;
  size_t count;
  const char *number;
} gg_field_kind;
extern const gg_field_kind gg_scene_kinds[];

typedef struct gg_word {
  const char *name;
  int value;
  const char *doc;
} gg_word;

typedef struct gg_field {
  const char *key; /* dotted */
  gg_field_type type;
  size_t offset; /* in gg_scene; of the fields of a species: in gg_species */
  double min, max;
  bool above_min;      /* min itself is not allowed */
  const char *special; /* a word that stands for special_value: "auto", "none" */
  double special_value;
  double by_default; /* of words their value, of pairs and vectors every element; phi: GG_AUTO, must be given */
  /* Words of choices and sets: a list that ends with a NULL name, or a function that returns the i-th of another
   * table. */
  const gg_word *words;
  gg_word (*word)(int i);
  const char *unit, *doc;
  const char *besides; /* of numbers: what to do in place of a value that is not allowed */
  uint64_t when;       /* sum of GG_BIT(GG_IF_...): unless all of them hold, the key has no effect; 0: it always has */
  const char *also;    /* what others call it, for messages: words separated by blanks */
  const char *older;   /* earlier spelling, which is accepted; NULL: none */
  bool reads;          /* of file names: a file to read, whose path is relative to the scene's file */
  bool may_change;     /* between the parts of a run that is resumed: it touches neither trajectory nor means */
  int by_speed;    /* of pairs: 1 plus the gg_contact_coefficient that may be a formula or a table; 0: numbers alone */
  bool on_the_way; /* may change during a run (protocol): it touches neither units nor box nor grains */
  /* The thermostat that has this key; GG_NO_THERMOSTAT: none. The first key of a thermostat is its strength; auto:
   * the strength that balances the losses. */
  gg_thermostat thermostat;
} gg_field;

enum { GG_MAX_FIELDS = GG_KEY_BITS };
extern const gg_field gg_scene_fields[];         /* ends with a NULL key */
extern const gg_field gg_scene_species_fields[]; /* likewise */
extern const gg_word
    gg_scene_former_keys[]; /* keys of earlier versions and of other files; what to do now; ends with a NULL name */
extern const char *const gg_scene_sections[]; /* first parts of dotted keys; ends with NULL */

/* Index in gg_scene_fields, or -1. */
int gg_scene_field_find(const char *key);
/* The same of keys and of members of their values, "collision.e.12" and "species.2.mass" (1 to n_species): *member is
 * the row, or a row for that member whose offset is in gg_scene. */
int gg_scene_key_find(const char *key, int n_species, gg_field *member);
/* The key that gives the strength of a thermostat; NULL: it has none. */
const gg_field *gg_scene_strength_of(gg_thermostat thermostat);
/* True if the user gave this key. */
bool gg_scene_is_given(const gg_scene *scene, const char *key);
/* True if it is the first part of some dotted key ("collision"). */
bool gg_scene_is_section(const char *name);

/* How many numbers the member holds; of others 1. */
size_t gg_scene_field_count(const gg_field *field);
/* The i-th word that a choice or a set takes; beyond the last one its name is NULL. */
gg_word gg_scene_field_word(const gg_field *field, int i);
/* The word of that name; its name is NULL if there is none. */
gg_word gg_scene_field_find_word(const gg_field *field, const char *name);
/* The word that stands for that value; its name is NULL if there is none. */
gg_word gg_scene_field_word_for(const gg_field *field, int value);

/* The formula or table that stands in the place of the `past`-th number of a field; NULL: a number. */
const char *gg_scene_field_law(const gg_field *field, const gg_scene *scene, int past);
/* Number of the pair of the field's first number; 0 but for a member "collision.e.12". */
int gg_scene_field_pair(const gg_field *field);
/* When the key has an effect: "flow couette; walls.beta is not -1"; "" if it always has. */
void gg_scene_field_when(const gg_field *field, char *text, size_t size);
/* True if a key belongs to the flow, whatever else a scene says. */
bool gg_scene_field_is_of(const gg_field *field, gg_flow flow);
/* Values that a field takes, in words: "a number from 0 to 1", "one of md, dsmc". */
void gg_scene_field_allowed(const gg_field *field, char *text, size_t size);

/* scene_schema.c: a map with these keys as JSON Schema; the part before a dot is a map of its own. */
json_t *gg_scene_schema_of(const gg_field *fields);

/* scene_template.c: a scene of the flow to begin with, as YAML with comments, to be freed; NULL: out of memory. */
char *gg_scene_template(gg_flow flow);

/* scene_json.c: scenes as JSON for results and as YAML for people; either can be read again as a scene. */

/* Every key with its value; NULL only if out of memory. The caller owns the reference. */
json_t *gg_scene_json(const gg_scene *scene);
/* One value of it; the same. */
json_t *gg_scene_field_json(const gg_field *field, const void *base, const gg_scene *scene);
/* The value of one key: "collision.e", "collision.e.12", "species.2.mass". NULL: there is no such key,
 * or out of memory. */
json_t *gg_scene_key_json(const gg_scene *scene, const char *key);
/* A JSON value on one line, as YAML flow style, cut to `size` bytes. */
void gg_scene_flow_style_text(const json_t *value, char *text, size_t size);
/* The scene as YAML text, to be freed; NULL if out of memory. */
char *gg_scene_yaml(const gg_scene *scene);
/* JSON of a scene, or of a part of its keys, as YAML. */
void gg_scene_yaml_print(FILE *out, const json_t *scene);

/* yaml_text.c: what any reader of YAML takes for the same text or number. */

/* A text, in double quotes where it would be something else without; always in quotes. */
void gg_scene_yaml_text_print(FILE *out, const char *text);
void gg_scene_yaml_quoted_print(FILE *out, const char *text);
void gg_scene_yaml_number(double value, char text[GG_NUMBER_TEXT]);

/* shear_in_time.c: the shear rate as a formula of time, in user's units. */
/* Steps of constant rate in the run, and periods; 0 steps: the rate is a number. */
int64_t gg_scene_shear_steps(const gg_scene *scene);
double gg_scene_shear_periods(const gg_scene *scene);
/* Rate in a step, from 0 on; the number where there is no formula. */
double gg_scene_shear_rate(const gg_scene *scene, int64_t step);
double gg_scene_shear_strain(const gg_scene *scene, double time);
/* Check the formula, and set shear.rate to its largest absolute value. */
gg_status gg_scene_shear_finish(gg_scene *scene, gg_error *err);

/* protocol.c: changes on the way. */

/* The keys that may change on the way, in words for messages. */
#define GG_PROTOCOL_KEYS "collision.*, bath.*, thermostat, gaussian_rate, noise_strength, shear_rate"
/* The scene after the first n changes; n of them by a time (user's units). */
gg_status gg_scene_protocol_apply(const gg_scene *scene, int n, gg_scene *changed, gg_error *err);
int gg_scene_protocol_count(const gg_scene *scene, double time);
/* Check that a changed shear rate is within a factor of 1000 of that of the start, whose units grains keep. */
gg_status gg_scene_check_shear_rate(const gg_scene *changed, gg_error *err);
/* Strain up to a time, both as in results; 0 without shear. */
double gg_scene_strain(const gg_scene *scene, double time);

/* checks.c: what concerns several keys. */

/* Fill in the defaults that depend on other keys. */
void gg_scene_fill_in(gg_scene *scene);
/* The same, and reject combinations that are invalid in any engine: call it before a scene is used. */
gg_status gg_scene_finish(gg_scene *scene, gg_error *err);

/* Uses of a scene: a sum of these. */
enum { GG_USE_MD = 1u << GG_MD, GG_USE_DSMC = 1u << GG_DSMC, GG_USE_THEORY = 1u << 2 };
/* Keys that the scene gives and that have no effect in it, a line for each reason: "walls.e, walls.beta have no effect
 * ...". Keys with their default values are left out. A last line states what fractions become that do not sum to 1.
 * `scene` is finished, `uses` a sum of GG_USE_... */
void gg_scene_ineffective_keys(const gg_scene *scene, unsigned uses, gg_string_list *lines);

/* resumption.c: a checkpoint keeps every key but those that `may_change`, and the name of what the program added to
 * the scene: items "scene/KEY" and "scene/extension". */

gg_status gg_scene_resumption_put(const gg_scene *scene, gg_archive *archive, gg_error *err);
/* Before the scene's model is made: an ensemble whose size followed from the requested error at first keeps it. */
gg_status gg_scene_resumption_settle(gg_scene *scene, const gg_archive *archive, gg_error *err);
/* GG_BAD_INPUT names the first key that differs, with both values; numbers are compared to the last bit. */
gg_status gg_scene_resumption_check(const gg_scene *scene, const gg_archive *archive, gg_error *err);

#endif
