/* Two simulations of one scene in two threads: independent copies of one seed.
 * Build: cc threads.c -o threads -pthread $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <pthread.h>
#include <stdio.h>

typedef struct part {
  const gg_scene *scene; /* read by both at once: it is const */
  uint64_t stream;
  gg_status status;
  gg_error err;
  gg_simulation_state end;
} part;

static void *run(void *argument)
{
  part *p = (part *)argument;
  const gg_start_options options = {sizeof options, p->stream, NULL, NULL};
  gg_simulation *simulation = NULL;
  p->status = gg_simulation_new(p->scene, &options, &simulation, &p->err);
  if (p->status == GG_OK) p->status = gg_simulation_collide(simulation, 50000, &p->err);
  if (p->status == GG_OK) p->status = gg_simulation_get_state(simulation, &p->end, &p->err);
  gg_simulation_free(simulation);
  return NULL;
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  static part parts[2];
  pthread_t other;
  if (gg_scene_parse("{flow: hcs, phi: 0.1, particles: 500, collision: {e: 0.8}}", "scene", &scene, &err)) {
    fprintf(stderr, "%s\n", err.message);
    return err.status;
  }
  for (int i = 0; i < 2; i++) parts[i].scene = scene, parts[i].stream = (uint64_t)i;
  if (pthread_create(&other, NULL, run, &parts[1])) return 1;
  run(&parts[0]);
  pthread_join(other, NULL);
  for (int i = 0; i < 2; i++)
    if (parts[i].status)
      fprintf(stderr, "%s\n", parts[i].err.message);
    else
      printf("stream %d: T = %.3e after %g collisions a grain\n", i, parts[i].end.temperature,
             parts[i].end.collisions_per_grain);
  gg_scene_free(scene);
  return parts[0].status ? parts[0].status : parts[1].status;
}
