/* A state of a simulation as one number, to compare trajectories by. */
#include <stdlib.h>
#include <string.h>

#include "api/simulation.h"
#include "base/memory.h"

/* Every bit of the word turns half of those of the hash: the finaliser of MurmurHash3 (A. Appleby, public domain). */
static uint64_t with_word(uint64_t hash, uint64_t word)
{
  hash = (hash ^ word) + 0x9e3779b97f4a7c15u;
  hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdu;
  hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53u;
  return hash ^ hash >> 33;
}

static uint64_t with_numbers(uint64_t hash, const double *x, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    uint64_t bits;
    memcpy(&bits, &x[i], sizeof bits);
    hash = with_word(hash, bits);
  }
  return hash;
}

/* Not the time: it is a sum over stretches, whose last bits depend on where a simulation was cut. */
static uint64_t hash_of(const gg_simulation_state *state, const gg_grains *grains)
{
  const size_t n = state->grains;
  uint64_t hash = with_word(0, state->collisions);
  if (grains->position) hash = with_numbers(hash, grains->position, 3 * n);
  hash = with_numbers(hash, grains->velocity, 3 * n);
  hash = with_numbers(hash, grains->spin, 3 * n);
  for (size_t i = 0; i < n; i++) hash = with_word(hash, (uint64_t)grains->species[i]);
  return hash;
}

gg_status gg_simulation_hash(const gg_simulation *simulation, uint64_t *hash, gg_error *err)
{
  GG_NEED(simulation, hash);
  gg_simulation_state state;
  GG_TRY(gg_simulation_get_state(simulation, &state, err));
  double *numbers = gg_base_array_new(9 * state.grains, sizeof *numbers, err);
  if (!numbers) return GG_FAILED;
  int *species = gg_base_array_new(state.grains, sizeof *species, err);
  const gg_grains grains = {.position = simulation->model.homogeneous ? NULL : numbers,
                            .velocity = numbers + 3 * state.grains,
                            .spin = numbers + 6 * state.grains,
                            .species = species};
  gg_status status = species ? gg_simulation_get_grains(simulation, &grains, err) : GG_FAILED;
  if (status == GG_OK) *hash = hash_of(&state, &grains);
  free(species);
  free(numbers);
  return status;
}
