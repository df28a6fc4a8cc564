#include "cli/options.h"

/* The subcommands; a new one is a file and an entry here. */
enum {
  SIMULATES = GG_OPT_SET | GG_OPT_OUTPUT | GG_OPT_JSON | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_QUIET | GG_OPT_ALL
};
const gg_command gg_cli_commands[] = {
    {"compare", "SCENE.yaml", "Both engines and the theories: one table, with standard errors and z-scores",
     "Runs event-driven molecular dynamics (md) and Enskog Monte Carlo (dsmc) on the scene, evaluates every theory "
     "that applies, and prints them side by side. Writes an HDF5 result file and a picture. Checkpoints and --resume "
     "as for run.",
     SIMULATES | GG_OPT_PICTURE | GG_OPT_RESUME, gg_cli_compare_main},
    {"run", "SCENE.yaml", "One engine: the scene's, or that of --engine",
     "With output.checkpoint_every above 0 in the scene, a checkpoint is kept beside the result (of usf.h5 "
     "usf.checkpoint.h5) until the run is done; --resume goes on from it bit for bit.\n"
     "mpirun -n 4 graingas run SCENE.yaml shares the replicas among four processes, to the same bits; compare, too.",
     SIMULATES | GG_OPT_ENGINE | GG_OPT_RESUME, gg_cli_run_main},
    {"theory", "SCENE.yaml", "The theories alone", NULL, GG_OPT_SET | GG_OPT_JSON | GG_OPT_ALL | GG_OPT_QUIET,
     gg_cli_theory_main},
    {"sweep", "SWEEP.yaml", "A grid of scenes: run, compare or theory at every point of it",
     "The file is a scene with two more maps. vary says which keys take which values: {phi: 0.1:0.5:0.1, collision.e: "
     "[0.7, 0.9]} is every combination; a list of maps, in which keys of one map change together, is every combination "
     "of these; {random: {points: 100}, phi: 0.1..0.5} draws. sweep says what is done: {does: run}, compare or theory. "
     "Any scene and --vary do as well.\n"
     "Results are a folder with a file a point, named by a hash of its scene: it is there when the point is done. A "
     "sweep that was stopped, in whatever way, goes on with the same command; several processes may share the folder. "
     "With output.checkpoint_every, points in progress go on from where they were.",
     GG_OPT_SWEEP | GG_OPT_SET | GG_OPT_PICTURE | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_JSON | GG_OPT_QUIET,
     gg_cli_sweep_main},
    {"reproduce", "FIGURE|list|all", "A figure of the papers: data, theory lines, picture",
     "Figures of Gayen's thesis and of Montanero's review, simulated anew: \"thesis 3.5\", \"review 3\"; 3.5 alone "
     "where "
     "only one of them has it. Leaves thesis-3.05.h5, .csv, .svg and .png in the current folder, and the numbers that "
     "the paper states beside ours in thesis-3.05_numbers.csv. list: all of them, with what they need, how long it "
     "takes "
     "here, and the verdict.\n"
     "Results of the runs lie in figures.sweep, where figures that show the same find them: interrupted, the same "
     "command goes on. Twice at once, unlike a sweep, a figure wants two folders (--output): of two in one, one could "
     "not write it in the end. docs/appendix/reproduction.md says what came out.",
     GG_OPT_QUICK | GG_OPT_FOLDER | GG_OPT_JSON | GG_OPT_THREADS | GG_OPT_QUIET, gg_cli_reproduce_main},
    {"plot", "RESULT.h5", "A picture of what a result file holds",
     "Relaxation of the temperatures with the averaging window; for a comparison also md, dsmc and the theories side "
     "by side. Beside it a snapshot, if there are positions, and a page for each observable that left curves.",
     GG_OPT_OUTPUT | GG_OPT_FORMAT | GG_OPT_QUIET, gg_cli_plot_main},
    {"export", "RESULT.h5", "Tables and curves as CSV, trajectories as extended XYZ",
     "PREFIX.csv: a line a quantity with mean, standard error, unit, samples, correlation time and whether the run was "
     "steady; of a comparison with both engines, z and the theories.\n"
     "PREFIX_<observable>_<curve>.csv: x, mean, standard error, and the law beside it if there is one; of a comparison "
     "with the engine's name before the observable's. PREFIX_numbers.csv: exponents, coefficients and other numbers "
     "read off the curves.\n"
     "PREFIX.xyz: the grains of each frame, which OVITO and ASE open, with the cell of that instant, leaning under "
     "shear; velocity (peculiar), spin (omega), radius, mass, number. The first species is called H, the second He, "
     "and so on. Needs positions, which md has; without output.trajectory_every in the scene it is the last state.",
     GG_OPT_PREFIX | GG_OPT_ONLY | GG_OPT_QUIET, gg_cli_export_main},
    {"info", "[FILE]", "What a result or a checkpoint holds, or every key of a scene and what it switches on and off",
     "Without a file: every key that a scene may have, with its default and what it takes.",
     GG_OPT_SET | GG_OPT_JSON | GG_OPT_QUIET, gg_cli_info_main},
    {"fingerprint", "SCENE.yaml", "One number for the grains' state after so many collisions, to compare machines by",
     "Simulates the scene's engine, or that of --engine, from its start, and prints a hash of all positions, "
     "velocities "
     "and spins. The same scene and seed have the same on every processor, from every compiler, and in the browser; "
     "after --collisions of the whole gas (100 000), for dsmc the first end of a step beyond.",
     GG_OPT_SET | GG_OPT_ENGINE | GG_OPT_COLLISIONS | GG_OPT_SEED | GG_OPT_JSON | GG_OPT_QUIET,
     gg_cli_fingerprint_main},
    {"page", "[SCENE.yaml]", "The teaching page: one file for a browser, with the engines live in it",
     "Writes one HTML file that needs no network and no installation: both engines, the theories and the measurements "
     "as "
     "WebAssembly, the box in three dimensions beside live curves, and six lessons. It begins with the scene. The page "
     "has "
     "to be built once from the sources of graingas: ./check-page does it.",
     GG_OPT_SET | GG_OPT_OUTPUT | GG_OPT_SEED | GG_OPT_QUIET, gg_cli_page_main},
    {"bench", "[md|dsmc|observables|error]",
     "How fast the engines are: collisions per second by kernel, density and size; run time against error",
     "Without a word: both engines in uniform shear at e = 0.9 with the stress measured, one core, the median of "
     "repeats.\n"
     "md: elastic smooth spheres by size and density, and what roughness, shear, walls, gravity, a second species and "
     "measuring the stress cost, scenes timed in turn.\n"
     "dsmc: the same for Enskog Monte Carlo, as nanoseconds per accepted collision; what its blocks gain over the "
     "plain loop, and threads within one ensemble over one.\n"
     "observables: what each observable adds to a run's time, both engines, three sizes.\n"
     "error: how wrong means of uniform shear are after so many seconds, warm-up included, by engine, number of "
     "grains, "
     "step, precision and replicas, with the seconds to 1, 0.1 and 0.01 %; --picture draws it. --quick takes two or "
     "three minutes, else most of an hour. Run it on an idle machine.",
     GG_OPT_PICTURE | GG_OPT_JSON | GG_OPT_SEED | GG_OPT_THREADS | GG_OPT_QUICK | GG_OPT_QUIET, gg_cli_bench_main},
    {0},
};
