/* A campaign in an archive: everything needed to go on bit for bit, and enough of the scene to refuse another one. */
#include <stdio.h>
#include <string.h>

#include "run/campaign.h"
#include "run/clock.h"

enum { N_FINGERPRINT = 20 };

/* Numbers that fix the trajectory. */
static void fingerprint(const gg_campaign *c, double *f)
{
  const gg_model *m = &c->model;
  const double list[N_FINGERPRINT] = {(double)m->flow,
                                      (double)c->scene.engine,
                                      (double)m->n,
                                      m->phi,
                                      m->e[0],
                                      m->beta[0],
                                      m->mu[0],
                                      m->e[3],
                                      m->beta[3],
                                      m->mu[3],
                                      (double)m->n_species,
                                      m->inertia[0],
                                      m->box[0],
                                      m->box[1],
                                      m->contact_time,
                                      m->time_step,
                                      m->temperature0,
                                      m->wall_speed,
                                      (double)c->n,
                                      (double)c->scene.run.seed};
  memcpy(f, list, sizeof list);
}

static const char *const fingerprint_names[N_FINGERPRINT] = {"flow",
                                                             "engine",
                                                             "particles",
                                                             "phi",
                                                             "collision.e",
                                                             "collision.beta",
                                                             "collision.mu",
                                                             "collision.e (22)",
                                                             "collision.beta (22)",
                                                             "collision.mu (22)",
                                                             "species",
                                                             "inertia",
                                                             "box",
                                                             "box",
                                                             "md.contact_time",
                                                             "dsmc.time_step",
                                                             "start temperature",
                                                             "walls.speed",
                                                             "run.replicas",
                                                             "run.seed"};

gg_status gg_campaign_save(const gg_campaign *c, gg_archive *a, gg_error *err)
{
  double f[N_FINGERPRINT];
  fingerprint(c, f);
  struct gg_campaign_state state = c->state;
  state.wall += gg_wall_now() - c->started;
  GG_TRY(gg_archive_put(a, "campaign/fingerprint", GG_ITEM_F64, f, N_FINGERPRINT, err));
  GG_TRY(gg_archive_put(a, "campaign/state", GG_ITEM_U8, &state, sizeof state, err));
  for (int i = 0; i < c->n; i++) {
    gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    gg_status status = gg_replica_save(&c->replicas[i], &one, err);
    if (status == GG_OK) status = gg_archive_nest(a, prefix, &one, err);
    gg_archive_clear(&one);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}

static gg_status same_scene(const gg_campaign *c, const gg_archive *a, gg_error *err)
{
  double here[N_FINGERPRINT], there[N_FINGERPRINT];
  fingerprint(c, here);
  GG_TRY(gg_archive_get(a, "campaign/fingerprint", GG_ITEM_F64, there, N_FINGERPRINT, err));
  for (int i = 0; i < N_FINGERPRINT; i++)
    if (memcmp(&here[i], &there[i], sizeof *here) != 0)
      return gg_fail(err, GG_BAD_INPUT, "the checkpoint was made by another scene: its %s is %.17g, the scene's %.17g",
                     fingerprint_names[i], there[i], here[i]);
  return GG_OK;
}

gg_status gg_campaign_restore(gg_campaign *c, const gg_archive *a, gg_error *err)
{
  GG_TRY(same_scene(c, a, err));
  GG_TRY(gg_archive_get(a, "campaign/state", GG_ITEM_U8, &c->state, sizeof c->state, err));
  for (int i = 0; i < c->n; i++) {
    gg_archive one = {0};
    char prefix[24];
    snprintf(prefix, sizeof prefix, "replica%d", i);
    gg_status status = gg_archive_unnest(&one, prefix, a, err);
    if (status == GG_OK) status = gg_replica_restore(&c->replicas[i], &one, &c->scene, &c->model, err);
    gg_archive_clear(&one);
    if (status != GG_OK) return status;
  }
  return GG_OK;
}
