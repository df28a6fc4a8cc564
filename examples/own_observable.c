/* A user-defined observable: how unequal the normal stresses of a sheared gas are, and how hard its grains collide.
 * Build: cc own_observable.c -o own_observable $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

struct impacts {
  double sum, count; /* since the last sample */
};

static void collide(void *context, void *state, const gg_collision_view *c)
{
  struct impacts *sums = (struct impacts *)state;
  (void)context;
  for (int a = 0; a < 3; a++) sums->sum += c->normal[a] * c->relative_velocity[a];
  sums->count++;
}

static void sample(void *context, void *state, const gg_sample *s, double *values)
{
  struct impacts *sums = (struct impacts *)state;
  double x = 0, y = 0;
  (void)context;
  for (size_t i = 0; i < s->n; i++)
    x += s->velocity[3 * i] * s->velocity[3 * i], y += s->velocity[3 * i + 1] * s->velocity[3 * i + 1];
  values[0] = x / y;
  values[1] = sums->count > 0 ? sums->sum / sums->count : 0;
  sums->sum = sums->count = 0;
}

int main(void)
{
  const gg_quantity_definition quantities[] = {{"anisotropy", "1", "<C_x^2>/<C_y^2>"},
                                               {"impact_speed", "d gamma", "mean normal speed of collisions"}};
  const gg_observable_definition mine = {"impacts", NULL, 2, quantities, sizeof(struct impacts), sample, collide, NULL};
  gg_error err;
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  double mean, error;
  if (gg_scene_parse("{flow: usf, phi: 0.1, particles: 500, run: {collisions: 200}}", "scene", &scene, &err) ||
      gg_scene_add_observable(scene, &mine, &err) || gg_run(scene, NULL, &result, &err))
    fprintf(stderr, "%s\n", err.message);
  for (int k = 0; k < 2 && gg_result_get(result, quantities[k].name, &mean, &error, &err) == GG_OK; k++)
    printf("%s = %.4g +- %.2g %s\n", quantities[k].name, mean, error, quantities[k].unit);
  gg_result_free(result);
  gg_scene_free(scene);
  return 0;
}
