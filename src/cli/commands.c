/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stddef.h>

#include "cli/options.h"

/* Table of the subcommands. */
const gg_command gg_cli_commands[] = {
    {"compare", "SCENE.yaml", "Both engines and the theories: one table, with standard errors and z-scores",
     "Runs event-driven molecular dynamics (md) and Enskog Monte Carlo (dsmc) on the scene, evaluates every theory "
     "that applies, and prints all of them side by side. Writes an HDF5 result file and a picture. Checkpoints and "
     "--resume work as for run.",
     gg_cli_run_main},
    {"run", "SCENE.yaml", "One engine: the scene's, or the one of --engine",
     "With output.checkpoint_every above 0 in the scene, the run keeps a checkpoint beside the result "
     "(usf.checkpoint.h5 for usf.h5) and removes it at the end. --resume continues from it with bit-identical results. "
     "With output.state: kept the last checkpoint stays, and --extend RESULT continues a finished run to other "
     "stopping criteria, e.g. --set run.relative_error=0.001, with the bits of a run that had them from the "
     "start.\nmpirun -n 4 graingas run SCENE.yaml distributes the replicas over four processes with bit-identical "
     "results; so does compare.",
     gg_cli_run_main},
    {"theory", "SCENE.yaml", "Theories without simulation",
     "Evaluates every theory that applies to the scene and prints the answers side by side; theories that do not apply "
     "are listed with the reason. --theory names those to evaluate, and saves the time of the others.",
     gg_cli_theory_main},
    {"sweep", "SWEEP.yaml", "A grid of scenes: run, compare or theory at every point",
     "The file is a scene with two more maps. vary gives the values of keys: {phi: 0.1:0.5:0.1, collision.e: [0.7, "
     "0.9]} is every combination. In a list of maps, the keys of one map change together. {random: {points: 100}, phi: "
     "0.1..0.5} draws points at random. sweep gives the command: {does: run}, compare or theory. A plain scene works "
     "with --vary.\nThe results folder holds one file for each finished point; its name is a hash of the scene. The "
     "same command continues an interrupted sweep, and several processes may share the folder. With "
     "output.checkpoint_every, unfinished points resume from their checkpoints.",
     gg_cli_sweep_main},
    {"validate", "[SWEEP.yaml]",
     "Both engines and the theories against Enskog's equation, over a grid: verdict and maps",
     "Compares both engines and all theories with Enskog's equation, solved without random numbers, at every point of "
     "a sweep. Without a file: over the standard grid of 180 points in density and restitution, for smooth, rough and "
     "frictional grains. It takes eight minutes of processor time, with --quick one. Like any sweep it continues after "
     "an interruption.\nPrints counts and tables: z of dsmc, the largest z with the command that repeats each, where "
     "md is off by more than 1, 5 and 20 %, where Lun is within 5 %. Draws maps of the deviations "
     "(grid_temperature.svg and on). The exit code is 1 where dsmc and the noise-free solution disagree beyond chance.",
     gg_cli_validate_main},
    {"plot", "RESULT.h5", "Pictures of a result file",
     "Draws the relaxation of the temperatures with the averaging window; for a comparison also md, dsmc and the "
     "theories side by side. Draws a snapshot if the file has positions, and one picture for each observable with "
     "curves.",
     gg_cli_plot_main},
    {"export", "RESULT.h5", "Tables and curves as CSV, trajectories as extended XYZ",
     "PREFIX.csv: a line for each quantity with mean, standard error, unit, samples, correlation time and whether the "
     "run was steady; for a comparison both engines, z and the theories.\nPREFIX_<observable>_<curve>.csv: x, mean, "
     "standard error, and the reference law if there is one; for a comparison the file name has the engine before the "
     "observable. PREFIX_numbers.csv: exponents, coefficients and other numbers derived from the curves.\nPREFIX.xyz: "
     "the grains of each frame for OVITO and ASE, with the (under shear: tilted) cell of that instant, peculiar "
     "velocity, spin (omega), radius, mass, momentum and number. The first species is named H, the second He, and so "
     "on. Needs positions: md has them, and dsmc between walls has heights alone (x = z = 0). Without "
     "output.trajectory_every in the scene it is the last state.",
     gg_cli_export_main},
    {"info", "[FILE|WORD]", "Contents of a result or checkpoint, meaning of a scene, definition of a word",
     "FILE is a scene, a result or a checkpoint. WORD is a scene key, a quantity, a theory, a flow or an observable: "
     "graingas info N1 prints its definition in five lines, --all in full. Without an argument: every scene key with "
     "its default and range.",
     gg_cli_info_main},
    {"cite", "[RESULT.h5|WORD]", "References of the program, and of the methods of a result, as BibTeX",
     "WORD is md, dsmc or the name of a theory. Without an argument: the program alone.", gg_cli_cite_main},
    {"init", "[FLOW]", "A scene to begin with: FLOW.yaml, with every key of the flow",
     "Writes a scene of the flow (usf without an argument) that runs as it is. Its other keys are comments with their "
     "defaults and meanings. An existing file is not replaced.",
     gg_cli_init_main},
    {"fingerprint", "SCENE.yaml", "A hash of the grains' state after a number of collisions, to compare machines",
     "Runs the scene's engine, or the one of --engine, from its start and prints a hash of all positions, velocities "
     "and spins. The hash of a scene and seed is the same on every processor, with every compiler and in the browser. "
     "It is taken after --collisions collisions of the whole gas (100 000), in dsmc at the end of that time step.",
     gg_cli_fingerprint_main},
    {"page", "[SCENE.yaml]", "The teaching page: one HTML file with live engines",
     "Writes one HTML file that needs no network and no installation: both engines, the theories and the measurements "
     "as WebAssembly, the box in three dimensions beside live curves, and eleven lessons. The page starts with the "
     "scene. The page is installed with graingas, or is made in the sources by `ninja -C build page` with emscripten, "
     "which ./check --page installs, or is another file (--page FILE).",
     gg_cli_page_main},
    {"bench", "[md|dsmc|observables|error|compare A B]",
     "Speed of the engines: collisions per second by kernel, density and size; run time against error",
     "Without an argument: both engines in uniform shear at e = 0.9, one core, median of "
     "repeats. Then single scenes: walls and baths at three densities, white noise, placing grains. Then two threads, "
     "alone and beside a busy neighbour, which is another thread that spins.\nmd: elastic smooth spheres by size and "
     "density; cost of roughness, shear, walls, gravity, white noise, baths and a second species; "
     "gain of threads within one run.\ndsmc: nanoseconds per accepted collision, also between walls; gain of the block "
     "kernels over the plain loop and of threads within one ensemble.\nobservables: run time that each observable "
     "adds, for both engines and three sizes.\nerror: processor time until means have an error of 1, 0.1 and 0.01 %, a "
     "table a state of uniform shear and free cooling, over engines, numbers of grains, time steps, precision and "
     "replicas. --picture e.svg draws e_<state>.svg: error against time of the best of each engine, theories as bars. "
     "--quick takes two or three minutes, the full run most of an hour. Use an idle machine.\n--json prints a line of "
     "JSON for each row: name, unit, value (the median), lowest and highest of the repeats, threads, machine, version "
     "with commit, instructions and time.\ncompare A B: for each row of two such files the time in B over that in A "
     "with its spread, and which are slower or faster beyond it. With --limit 10 the exit code is 1 if a row is slower "
     "by more than 10 % beyond its spread. The last row of a name counts.",
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
