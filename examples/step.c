/* Step a sheared gas and print its temperature and stress.
 * Build: cc step.c -o step $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>
#include <stdlib.h>

/* How fast do grains meet? */
static void collided(void *context, const gg_collision_event *event)
{
  double *fastest = (double *)context;
  if (event->normal_speed > *fastest) *fastest = event->normal_speed;
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  gg_simulation *simulation = NULL;
  gg_simulation_state s;
  gg_simulation_sums sums;
  gg_grains grains = {NULL, NULL, NULL, NULL};
  double fastest = 0;
  if (gg_scene_parse("{flow: usf, phi: 0.2, particles: 500}", "scene", &scene, &err) ||
      gg_simulation_new(scene, NULL, &simulation, &err) ||
      gg_simulation_on_collision(simulation, collided, &fastest, &err))
    goto failed;
  printf("   time  coll/grain  temperature     P_xy  fastest\n");
  for (int i = 0; i < 10; i++) {
    if (gg_simulation_advance(simulation, 2.0, &err) || gg_simulation_get_state(simulation, &s, &err) ||
        gg_simulation_take_sums(simulation, &sums, &err))
      goto failed;
    printf("%7.2f %11.1f %12.4f %8.4f %8.2f\n", s.time, s.collisions_per_grain, s.temperature,
           s.kinetic_stress[0][1] + sums.collisional_stress[0][1], fastest);
  }
  grains.position = (double *)malloc(3 * s.grains * sizeof(double));
  if (!grains.position || gg_simulation_get_grains(simulation, &grains, &err)) goto failed;
  printf("grain 0 is at %.3f %.3f %.3f\n", grains.position[0], grains.position[1], grains.position[2]);
  free(grains.position);
  gg_simulation_free(simulation);
  gg_scene_free(scene);
  return 0;
failed:
  fprintf(stderr, "%s\n", err.message);
  gg_simulation_free(simulation);
  gg_scene_free(scene);
  return 1;
}
