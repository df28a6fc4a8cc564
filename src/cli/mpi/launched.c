#include <stdlib.h>

#include "cli/mpi/mpi.h"

static bool is_above_one(const char *name)
{
  const char *value = getenv(name);
  return value && strtol(value, NULL, 10) > 1;
}

bool gg_mpi_is_one_of_several(void)
{
  if (is_above_one("OMPI_COMM_WORLD_SIZE") || is_above_one("PMI_SIZE")) return true; /* mpirun of Open MPI, of MPICH */
  return getenv("PMIX_RANK") && is_above_one("SLURM_STEP_NUM_TASKS");                /* srun --mpi=pmix */
}
