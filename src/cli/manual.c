/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The manual page, in roff, from the tables of the program. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

/* Print text with roff's special characters escaped; line ends stay. */
static void put(const char *text)
{
  for (; *text; text++) {
    if (*text == '.' || *text == '\'') fputs("\\&", stdout); /* otherwise a request at the start of a line */
    if (*text == '-')
      fputs("\\-", stdout);
    else if (*text == '\\')
      fputs("\\e", stdout);
    else if (*text == '\n')
      fputs("\n.br\n", stdout);
    else
      fputc(*text, stdout);
  }
}

/* Begin an item; its text and a line end follow. */
static void begin_item(const char *head, const char *argument)
{
  printf(".TP\n.B ");
  put(head);
  if (argument && *argument) {
    printf(" \\fI");
    put(argument);
    printf("\\fR");
  }
  printf("\n");
}

static void item(const char *head, const char *argument, const char *text)
{
  begin_item(head, argument);
  put(text);
  printf("\n");
}

static void print_keys(gg_catalogue catalogue)
{
  gg_entry f;
  for (size_t i = 0; gg_catalogue_entry(catalogue, i, NULL, &f, NULL) == GG_OK; i++) {
    printf(".TP\n.B ");
    put(f.name);
    printf("\n");
    put(f.doc);
    printf("; ");
    put(f.allowed);
    if (f.unit) printf(" (unit: %s)", f.unit);
    if (catalogue == GG_CATALOGUE_KEYS && f.value[0]) printf("; default %s", f.value);
    printf(".\n");
  }
}

static void print_theories(void)
{
  gg_entry t;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_THEORIES, i, NULL, &t, NULL) == GG_OK; i++) {
    begin_item(t.name, NULL);
    put(t.doc);
    printf(". ");
    put(t.citation);
    printf(". ");
    put(t.assumptions);
    printf("\n");
  }
}

static void print_files(void)
{
  static const struct {
    const char *name, *argument, *text;
  } files[] = {
      {"RESULT.h5", NULL,
       "HDF5 in the layout of H5MD 1.1, written whole or not at all. A comparison holds both engines: what stands "
       "under /graingas/results in a run is under /graingas/md/results and /graingas/dsmc/results there, and its "
       "series are called md_... and dsmc_..."},
      {"/particles/grains", NULL,
       "box, position, velocity (peculiar), spin, species, mass, diameter, id: the last state, or every "
       "output.trajectory_every collisions per grain. Edges of a sheared box lean with its sliding images."},
      {"/observables", "QUANTITY", "step, time and value from the start of the run."},
      {"/graingas/results", "QUANTITY", "mean, stderr, unit, samples, correlation_time (its unit an attribute)."},
      {"/graingas/theory", "NAME/QUANTITY", "mean and unit."},
      {"/graingas", NULL,
       "scene (YAML), document (the JSON of --json), seed, version, command, machine, date, verdict, warnings, window, "
       "averaging and total effort."},
      {"RESULT.csv, RESULT_numbers.csv, RESULT_OBSERVABLE_CURVE.csv, RESULT.xyz", NULL,
       "Written by export: quantities, numbers derived from the curves, curves, grains as extended XYZ."},
      {"RESULT.checkpoint.h5", NULL,
       "The latest checkpoint; RESULT.checkpoint.h5.1 is the one before it and is read if the latest is missing or "
       "damaged. Both are removed when a run is done and its result in place."},
      {"RESULT.checkpoint.frames", NULL,
       "The trajectory up to the checkpoint, which goes into RESULT.h5 at the end. It belongs to the checkpoint: move "
       "both. If it is lost, the run can be resumed without a trajectory, with --set output.trajectory_every=0."},
      {"RESULT.h5.graingas-lock, RESULT.h5.graingas-tmp", NULL,
       "The lock names the process that writes the file; the other is the unfinished file. If that process dies, the "
       "next run removes both."},
      {"Checksum", NULL,
       "Results and checkpoints end with \"gg-crc32\", the size of the HDF5 file (8 bytes) and its CRC-32 (4 bytes), "
       "lowest byte first. A result without them is one that another program has changed: it is read with a warning. "
       "To vouch for it, in Python: data = open(FILE, \"rb\").read(); open(FILE, \"ab\").write(struct.pack(\"<8sQI\", "
       "b\"gg-crc32\", len(data), zlib.crc32(data)))"},
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
  for (const gg_command *c = gg_cli_commands; c->name; c++) {
    begin_item(c->name, c->arguments);
    put(c->summary);
    printf(".\n");
    if (!c->help) continue;
    put(c->help);
    printf("\n");
  }
  printf(".SH OPTIONS\n");
  for (const gg_option *o = gg_cli_options_table; o->flag; o++) {
    char name[32];
    snprintf(name, sizeof name, "--%s", o->name);
    begin_item(name, o->argument);
    put(o->doc);
    printf(". Taken by:");
    for (const gg_command *c = gg_cli_commands; c->name; c++)
      if (c->options & o->flag) printf(" %s", c->name);
    printf("\n");
  }
  item("--help", NULL, "Help on a command.");
  item("--version", NULL, "The version.");
  printf(".SH SCENE\nOnly flow and phi must be given. Keys with a dot stand in a section of YAML.\n");
  print_keys(GG_CATALOGUE_KEYS);
  printf(".SS Members of a species\n");
  print_keys(GG_CATALOGUE_SPECIES_KEYS);
  printf(".SH QUANTITIES\nThe names in tables, JSON documents and HDF5 files.\n");
  gg_entry q;
  for (size_t i = 0; gg_catalogue_entry(GG_CATALOGUE_QUANTITIES, i, NULL, &q, NULL) == GG_OK; i++)
    item(q.name, NULL, q.doc);
  printf(".SH THEORIES\n");
  print_theories();
  print_files();
  printf(".SH EXIT STATUS\n");
  item("0", NULL, "Done.");
  item("1", NULL, "The run failed or did not reach its stopping criteria.");
  item("2", NULL, "The command line or the scene is invalid.");
  item("3", NULL, "A file could not be read or written.");
  item("130", NULL, "Interrupted; a checkpoint is written if checkpoints are on.");
  printf(".SH EXAMPLES\n.EX\ngraingas compare examples/usf.yaml\n"
         "graingas run examples/usf.yaml \\-\\-engine md \\-\\-set collision.e=0.8 \\-\\-json\n"
         "graingas plot usf.h5 \\-\\-format png\n"
         "graingas export usf.h5 \\-\\-only results,trajectory\n.EE\n");
}
