/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stddef.h>

#include "cli/options.h"
#include "cli/pages.h"

/* Table of the subcommands. */
enum {
  SIMULATES = GG_OPT_SET | GG_OPT_OUTPUT | GG_OPT_JSON | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_QUIET | GG_OPT_ALL
};
const gg_command gg_cli_commands[] = {
    {"compare", "SCENE.yaml", "Both engines and the theories: one table, with standard errors and z-scores",
     "Runs event-driven molecular dynamics (md) and Enskog Monte Carlo (dsmc) on the scene, evaluates every theory "
     "that applies, and prints all of them side by side. Writes an HDF5 result file and a picture. Checkpoints and "
     "--resume work as for run.",
     SIMULATES | GG_OPT_PICTURE | GG_OPT_RESUME | GG_OPT_ACCEPT, gg_cli_compare_main},
    {"run", "SCENE.yaml", "One engine: the scene's, or the one of --engine", gg_cli_page_help_run,
     SIMULATES | GG_OPT_ENGINE | GG_OPT_RESUME | GG_OPT_ACCEPT, gg_cli_run_main},
    {"theory", "SCENE.yaml", "Theories without simulation",
     "Evaluates every theory that applies to the scene and prints the answers side by side; theories that do not apply "
     "are listed with the reason. --theory names those to evaluate, and saves the time of the others.",
     GG_OPT_SET | GG_OPT_THEORY | GG_OPT_JSON | GG_OPT_ALL | GG_OPT_QUIET, gg_cli_theory_main},
    {"sweep", "SWEEP.yaml", "A grid of scenes: run, compare or theory at every point", gg_cli_page_help_sweep,
     GG_OPT_SWEEP | GG_OPT_ACCEPT | GG_OPT_SET | GG_OPT_PICTURE | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_JSON |
         GG_OPT_QUIET,
     gg_cli_sweep_main},
    {"validate", "[SWEEP.yaml]",
     "Both engines and the theories against Enskog's equation, over a grid: verdict and maps",
     gg_cli_page_help_validate,
     GG_OPT_VALIDATE | GG_OPT_ACCEPT | GG_OPT_SET | GG_OPT_PICTURE | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_QUICK |
         GG_OPT_JSON | GG_OPT_QUIET,
     gg_cli_validate_main},
    {"plot", "RESULT.h5", "Pictures of a result file",
     "Draws the relaxation of the temperatures with the averaging window; for a comparison also md, dsmc and the "
     "theories side by side. Draws a snapshot if the file has positions, and one picture for each observable with "
     "curves.",
     GG_OPT_OUTPUT | GG_OPT_FORMAT | GG_OPT_QUIET, gg_cli_plot_main},
    {"export", "RESULT.h5", "Tables and curves as CSV, trajectories as extended XYZ", gg_cli_page_help_export,
     GG_OPT_PREFIX | GG_OPT_ONLY | GG_OPT_QUIET, gg_cli_export_main},
    {"info", "[FILE|WORD]", "Contents of a result or checkpoint, meaning of a scene, definition of a word",
     "FILE is a scene, a result or a checkpoint. WORD is a scene key, a quantity, a theory, a flow or an observable: "
     "graingas info N1 prints its definition in five lines, --all in full. Without an argument: every scene key with "
     "its default and range.",
     GG_OPT_SET | GG_OPT_JSON | GG_OPT_ALL | GG_OPT_SCHEMA | GG_OPT_QUIET, gg_cli_info_main},
    {"cite", "[RESULT.h5|WORD]", "References of the program, and of the methods of a result, as BibTeX",
     "WORD is md, dsmc or the name of a theory. Without an argument: the program alone.", GG_OPT_QUIET,
     gg_cli_cite_main},
    {"init", "[FLOW]", "A scene to begin with: FLOW.yaml, with every key of the flow",
     "Writes a scene of the flow (usf without an argument) that runs as it is. Its other keys are comments with their "
     "defaults and meanings. An existing file is not replaced.",
     GG_OPT_OUTPUT | GG_OPT_QUIET, gg_cli_init_main},
    {"fingerprint", "SCENE.yaml", "A hash of the grains' state after a number of collisions, to compare machines",
     "Runs the scene's engine, or the one of --engine, from its start and prints a hash of all positions, velocities "
     "and spins. The hash of a scene and seed is the same on every processor, with every compiler and in the browser. "
     "It is taken after --collisions collisions of the whole gas (100 000), in dsmc at the end of that time step.",
     GG_OPT_SET | GG_OPT_ENGINE | GG_OPT_COLLISIONS | GG_OPT_SEED | GG_OPT_JSON | GG_OPT_QUIET,
     gg_cli_fingerprint_main},
    {"page", "[SCENE.yaml]", "The teaching page: one HTML file with live engines", gg_cli_page_help_page,
     GG_OPT_PAGE | GG_OPT_SET | GG_OPT_OUTPUT | GG_OPT_SEED | GG_OPT_QUIET, gg_cli_page_main},
    {"bench", "[md|dsmc|observables|error|compare A B]",
     "Speed of the engines: collisions per second by kernel, density and size; run time against error",
     gg_cli_page_help_bench,
     GG_OPT_MORE | GG_OPT_LIMIT | GG_OPT_PICTURE | GG_OPT_JSON | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_QUICK |
         GG_OPT_QUIET,
     gg_cli_bench_main},
    {0},
};

const char *gg_cli_nearest_command(const char *word)
{
  enum { N = sizeof gg_cli_commands / sizeof *gg_cli_commands };
  const char *known[2 + N] = {"--help", "--version"};
  for (int i = 0; i < N; i++) known[2 + i] = gg_cli_commands[i].name; /* the last one is NULL */
  return gg_nearest_word(word, known);
}
