/* The one table of what a scene may say. It drives the reader, --set, range checks, `graingas info`, the scene echoed
 * in results, what a checkpoint is held against when a run is resumed, and the manual. A new key is a member of
 * gg_scene and a line of fields.c. */
#ifndef GG_SCENE_FIELDS_H
#define GG_SCENE_FIELDS_H

#include "common/scene.h"

typedef enum gg_field_type {
  GG_FIELD_NUMBER,  /* double */
  GG_FIELD_INTEGER, /* int64_t */
  GG_FIELD_CHOICE,  /* an enum: one of `words` */
  GG_FIELD_SET,     /* unsigned bits: a list of `words` */
  GG_FIELD_PAIRS,   /* double[GG_PAIRS]: a number, or a map by pair: {11: , 12: , other: } */
  GG_FIELD_VECTOR,  /* double[3] */
  GG_FIELD_SPECIES  /* gg_species[]: a list of maps, whose members are gg_scene_species_fields */
} gg_field_type;

typedef struct gg_word {
  const char *name;
  int value;
  const char *doc;
} gg_word;

enum { GG_MOST_CONDITIONS = 2 };

typedef struct gg_field {
  const char *key; /* dotted */
  gg_field_type type;
  size_t offset; /* in gg_scene; of the fields of a species: in gg_species */
  double min, max;
  bool above_min;      /* min itself is not allowed */
  const char *special; /* a word that stands for special_value: "auto", "none" */
  double special_value;
  /* Of choices and sets: a list that ends with a NULL name, or a table of another room, which is asked for its rows. */
  const gg_word *words;
  gg_word (*word)(int i);
  const char *unit, *doc;
  const struct gg_condition *when[GG_MOST_CONDITIONS]; /* all of them, or the key has no effect (scene/conditions.h) */
  const char *also; /* what others call it, for messages: words separated by blanks */
  bool may_change;  /* between the parts of a run that is resumed: it touches neither trajectory nor means */
} gg_field;

enum { GG_MAX_FIELDS = 48 };                     /* as many bits of gg_scene.given are used */
extern const gg_field gg_scene_fields[];         /* ends with a NULL key */
extern const gg_field gg_scene_species_fields[]; /* likewise */
extern const gg_word
    gg_scene_former_keys[]; /* keys of earlier versions and of other files; what to do now; ends with a NULL name */
extern const char *const gg_scene_sections[]; /* first parts of dotted keys; ends with NULL */

/* Index in gg_scene_fields, or -1. */
int gg_scene_field_find(const char *key);
/* "collision.e.12": index of collision.e, and the pair; else -1. */
int gg_scene_field_of_pair(const char *key, int *pair);
/* Is there such a key: collision.e, species.2.mass, collision.e.12? */
bool gg_scene_key_exists(const char *key);
/* Did the user give this key? */
bool gg_scene_is_given(const gg_scene *scene, const char *key);
/* Is it the first part of some dotted key ("collision")? */
bool gg_scene_is_section(const char *name);

/* The i-th word that a choice or a set takes; beyond the last one its name is NULL. */
gg_word gg_scene_field_word(const gg_field *field, int i);
/* The word of that name; its name is NULL if there is none. */
gg_word gg_scene_field_find_word(const gg_field *field, const char *name);
/* The word that stands for that value; its name is NULL if there is none. */
gg_word gg_scene_field_word_for(const gg_field *field, int value);

/* A number in the fewest digits that read back as the same number. */
void gg_scene_number_format(double value, char *text, size_t size);
/* What a field takes, in words: "a number from 0 to 1", "one of md, dsmc". */
void gg_scene_field_allowed(const gg_field *field, char *text, size_t size);

#endif
