/* graingas sweep --slurm: an array script in which every task does points of its own. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/sweep.h"

/* Clusters allow about a thousand tasks an array (MaxArraySize). */
enum { MOST_TASKS = 1000 };

/* The longest task, at a quarter of the speed that is expected; whole hours. */
static long hours(const gg_sweep_command *c, size_t tasks)
{
  double longest = 0;
  size_t n = gg_sweep_points(c->sweep);
  gg_sweep_point p;
  for (size_t first = 0; first < tasks; first++) {
    double seconds = 0;
    for (size_t i = first; i < n; i += tasks)
      if (gg_sweep_at(c->sweep, i, &p, NULL) == GG_OK) seconds += p.cpu_seconds;
    longest = fmax(longest, seconds);
  }
  return (long)ceil(4 * longest / 3600 + 1e-9);
}

int gg_cli_sweep_print_slurm(const gg_sweep_command *c)
{
  size_t n = gg_sweep_points(c->sweep), tasks = n < MOST_TASKS ? n : MOST_TASKS;
  long h = hours(c, tasks);
  char *command = gg_cli_command_line_quote(&c->options->typed,
                                            " --point \"$point\" --threads \"${SLURM_CPUS_PER_TASK:-1}\" --quiet");
  if (!command) return gg_cli_fail(GG_FAILED, "out of memory");
  printf("#!/bin/bash\n"
         "# %zu points; those that are done already cost a task a moment.\n"
         "#SBATCH --job-name=graingas-sweep\n"
         "#SBATCH --array=1-%zu\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --time=%ld:00:00\n"
         "status=0\n"
         "for ((point = ${SLURM_ARRAY_TASK_ID:-1}; point <= %zu; point += %zu)); do\n"
         "  %s || status=$?\n"
         "done\n"
         "exit \"$status\"\n",
         n, tasks, h > 0 ? h : 1, n, tasks, command);
  free(command);
  return GG_OK;
}
