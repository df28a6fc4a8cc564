/* The manual page, in roff, from the tables that the program itself uses. */
#include <stdio.h>
#include <string.h>

#include "cli/options.h"
#include "common/quantity.h"
#include "io/scene/json.h"
#include "theory/theory.h"

/* Text with what roff would read as its own escaped. */
static void put(const char *text)
{
  for (; *text; text++) {
    if (*text == '-')
      fputs("\\-", stdout);
    else if (*text == '\\')
      fputs("\\e", stdout);
    else if (*text == '\n')
      fputs("\n", stdout);
    else
      fputc(*text, stdout);
  }
}

static void item(const char *head, const char *argument, const char *text)
{
  printf(".TP\n.B ");
  put(head);
  if (argument && *argument) {
    printf(" \\fI");
    put(argument);
    printf("\\fR");
  }
  printf("\n");
  put(text);
  printf("\n");
}

static void print_fields(const gg_field *fields)
{
  gg_scene defaults = gg_scene_defaults();
  for (const gg_field *f = fields; f->key; f++) {
    char allowed[256];
    bool required = strcmp(f->key, "flow") == 0 || strcmp(f->key, "phi") == 0;
    gg_field_allowed(f, allowed, sizeof allowed);
    printf(".TP\n.B ");
    put(f->key);
    printf("\n");
    put(f->doc);
    printf("; ");
    put(allowed);
    if (f->unit) printf(" (unit: %s)", f->unit);
    if (fields == gg_scene_fields && !required) {
      json_t *value = gg_field_json(f, &defaults, &defaults);
      printf("; default ");
      fflush(stdout);
      gg_print_flow_style(stdout, value);
      json_decref(value);
    }
    printf(".\n");
  }
}

static void print_quantities(void)
{
  for (int q = 0; q < GG_N_QUANTITIES; q++)
    item(gg_quantity_name((gg_quantity)q), NULL, gg_quantity_doc((gg_quantity)q));
}

static void print_files(void)
{
  static const struct {
    const char *name, *argument, *text;
  } files[] = {
      {"RESULT.h5", NULL,
       "HDF5 in the layout of H5MD 1.1, written whole or not at all. A comparison holds both engines: what stands "
       "under "
       "/graingas/results in a run is under /graingas/md/results and /graingas/dsmc/results there, and its series are "
       "called md_... and dsmc_..."},
      {"/particles/grains", NULL,
       "box, position, velocity (peculiar), spin, species, id: the last state, or every output.trajectory_every "
       "collisions per grain. Edges of a sheared box lean with its sliding images."},
      {"/observables", "QUANTITY", "step, time and value from the start of the run."},
      {"/graingas/results", "QUANTITY", "mean, stderr, unit, samples, correlation_time."},
      {"/graingas/theory", "NAME/QUANTITY", "mean and unit."},
      {"/graingas", NULL,
       "scene (YAML), document (the JSON of --json), seed, version, command, machine, date, verdict, warnings, window, "
       "averaging and total effort."},
      {"RESULT.checkpoint.h5", NULL,
       "A checkpoint, with a checksum; RESULT.checkpoint.h5.1 is the one before it, and is taken where the first is "
       "missing or damaged."},
  };
  printf(".SH FILES\n");
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) item(files[i].name, files[i].argument, files[i].text);
}

void gg_cli_print_manual(void)
{
  printf(".TH GRAINGAS 1 \"\" \"graingas %s\" \"User Commands\"\n", gg_version());
  printf(".SH NAME\ngraingas \\- granular gases of hard spheres: molecular dynamics, Monte Carlo, theory\n");
  printf(".SH SYNOPSIS\n.B graingas\n.I COMMAND\n.RI [ OPTION ...]\n.I FILE\n");
  printf(
      ".SH DESCRIPTION\nA scene, a small YAML file, describes a granular gas. graingas runs event\\-driven molecular\n"
      "dynamics and Enskog Monte Carlo on it, evaluates kinetic theories, and gives every number with its standard\n"
      "error and unit.\n.SH COMMANDS\n");
  for (const gg_command *c = gg_commands; c->name; c++) {
    char text[600];
    snprintf(text, sizeof text, "%s.%s%s", c->summary, c->help ? "\n" : "", c->help ? c->help : "");
    item(c->name, c->arguments, text);
  }
  printf(".SH OPTIONS\n");
  for (const gg_option *o = gg_options_table; o->flag; o++) {
    char name[32], text[400];
    snprintf(name, sizeof name, "--%s", o->name);
    snprintf(text, sizeof text, "%s. Taken by:", o->doc);
    for (const gg_command *c = gg_commands; c->name; c++)
      if (c->options & o->flag) snprintf(text + strlen(text), sizeof text - strlen(text), " %s", c->name);
    item(name, o->argument, text);
  }
  item("--help", NULL, "Help on a command.");
  item("--version", NULL, "The version.");
  printf(".SH SCENE\nOnly flow and phi must be given. Keys with a dot stand in a section of YAML.\n");
  print_fields(gg_scene_fields);
  printf(".SS Members of a species\n");
  print_fields(gg_species_fields);
  printf(".SH QUANTITIES\nThe names in tables, JSON documents and HDF5 files.\n");
  print_quantities();
  printf(".SH THEORIES\n");
  for (int i = 0; gg_theories[i]; i++) {
    char text[800];
    snprintf(text, sizeof text, "%s. %s %s", gg_theories[i]->title, gg_theories[i]->citation,
             gg_theories[i]->assumptions);
    item(gg_theories[i]->name, NULL, text);
  }
  print_files();
  printf(".SH EXIT STATUS\n");
  item("0", NULL, "Done.");
  item("1", NULL, "The run failed or fell short of what was asked.");
  item("2", NULL, "The command line or the scene is wrong.");
  item("3", NULL, "A file could not be read or written.");
  item("130", NULL, "Interrupted; with a checkpoint if one was asked for.");
  printf(".SH EXAMPLES\n.EX\ngraingas compare examples/usf.yaml\n"
         "graingas run examples/usf.yaml \\-\\-engine md \\-\\-set collision.e=0.8 \\-\\-json\n"
         "graingas plot usf.h5 \\-\\-format png\n.EE\n");
}
