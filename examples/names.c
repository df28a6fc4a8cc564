/* The tables of all names: what a scene may say, what it may measure, and what comes of it, in units of that scene.
 * Build: cc names.c -o names $(pkg-config --cflags --libs graingas) */
#include <graingas.h>
#include <stdio.h>

static void print_table(gg_catalogue list, const char *title, const gg_scene *scene)
{
  static gg_entry entry; /* some kilobytes */
  printf("%s\n", title);
  for (size_t i = 0; gg_catalogue_entry(list, i, scene, &entry, NULL) == GG_OK; i++) {
    printf("  %-28s %s", entry.name, entry.doc);
    if (entry.unit && *entry.unit) printf(" [%s]", entry.unit);
    if (*entry.allowed) printf("; %s", entry.allowed);
    if (*entry.value) printf("; here %s", entry.value);
    printf("\n");
  }
}

int main(void)
{
  gg_error err;
  gg_scene *scene = NULL;
  if (gg_scene_parse("{flow: usf, phi: 0.1}", "scene", &scene, &err)) {
    fprintf(stderr, "%s\n", err.message);
    return err.status;
  }
  print_table(GG_CATALOGUE_KEYS, "keys", scene);
  print_table(GG_CATALOGUE_FLOWS, "flows", scene);
  print_table(GG_CATALOGUE_OBSERVABLES, "observables", scene);
  print_table(GG_CATALOGUE_QUANTITIES, "quantities", scene);
  print_table(GG_CATALOGUE_THEORIES, "theories", scene);
  gg_scene_free(scene);
  return 0;
}
