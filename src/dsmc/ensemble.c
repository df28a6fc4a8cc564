#include "dsmc/ensemble.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static gg_block *new_blocks(size_t n, gg_error *err)
{
  gg_block *b = aligned_alloc(64, n * sizeof(gg_block));
  if (!b) {
    gg_fail(err, GG_FAILED, "out of memory for an ensemble of %zu grains: lower dsmc.particles", n * GG_LANES);
    return NULL;
  }
  memset(b, 0, n * sizeof(gg_block));
  return b;
}

gg_status gg_ensemble_new(const gg_model *model, gg_ensemble *e, gg_error *err)
{
  *e = (gg_ensemble){.n_species = model->n_species};
  for (int i = 0; i < e->n_species; i++) {
    gg_population *p = &e->of[i];
    p->n = model->n_of[i];
    p->n_blocks = ((size_t)p->n + GG_LANES - 1) / GG_LANES;
    p->mass = model->mass[i];
    p->inertia = model->inertia[i];
    p->c = new_blocks(p->n_blocks, err);
    if (p->c && model->rule != GG_SMOOTH) p->s = new_blocks(p->n_blocks, err);
    if (!p->c || (model->rule != GG_SMOOTH && !p->s)) {
      gg_ensemble_free(e);
      return GG_FAILED;
    }
  }
  return GG_OK;
}

void gg_ensemble_free(gg_ensemble *e)
{
  for (int i = 0; i < GG_MAX_SPECIES; i++) {
    free(e->of[i].c);
    free(e->of[i].s);
  }
  *e = (gg_ensemble){0};
}

void gg_ensemble_start(const gg_model *model, gg_ensemble *e, gg_rng *rng)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_population *p = &e->of[i];
    double speed = sqrt(model->temperature0 / p->mass), spin = sqrt(model->ratio0 * model->temperature0 / p->mass);
    double mean_spin = model->boltzmann ? 0 : -model->shear_rate * model->diameter[i] / 4; /* s = (d/2) omega */
    for (uint32_t a = 0; a < p->n; a++) {
      gg_block_set(p->c, a, gg_scale(speed, gg_rng_normal_vec(rng)));
      if (!p->s) continue;
      gg_vec s = gg_scale(spin / sqrt(p->inertia), gg_rng_normal_vec(rng));
      s.z += mean_spin;
      gg_block_set(p->s, a, s);
    }
  }
  gg_ensemble_centre(e);
  double factor = sqrt(model->temperature0 / gg_ensemble_moments(e).temperature);
  for (int i = 0; i < e->n_species; i++)
    for (uint32_t a = 0; a < e->of[i].n; a++)
      gg_block_set(e->of[i].c, a, gg_scale(factor, gg_block_get(e->of[i].c, a)));
}

void gg_ensemble_stream(gg_ensemble *e, double drift)
{
  for (int i = 0; i < e->n_species; i++)
    for (size_t b = 0; b < e->of[i].n_blocks; b++) {
      gg_block *c = &e->of[i].c[b];
      for (int l = 0; l < GG_LANES; l++) c->x[l] -= drift * c->y[l];
    }
}

void gg_blocks_scale(gg_block *b, size_t n, double factor)
{
  double *v = (double *)b;
  for (size_t i = 0; b && i < n * sizeof(gg_block) / sizeof(double); i++) v[i] *= factor;
}

void gg_ensemble_scale(gg_ensemble *e, double factor)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_blocks_scale(e->of[i].c, e->of[i].n_blocks, factor);
    gg_blocks_scale(e->of[i].s, e->of[i].n_blocks, factor);
  }
}

/* Sum over grains, lane by lane so that every processor adds in the same order. */
static gg_vec total(const gg_population *p)
{
  gg_block sum = {{0}, {0}, {0}};
  for (size_t b = 0; b < p->n_blocks; b++)
    for (int l = 0; l < GG_LANES; l++) {
      sum.x[l] += p->c[b].x[l];
      sum.y[l] += p->c[b].y[l];
      sum.z[l] += p->c[b].z[l];
    }
  gg_vec v = {0, 0, 0};
  for (int l = 0; l < GG_LANES; l++) v = gg_add(v, (gg_vec){sum.x[l], sum.y[l], sum.z[l]});
  return v;
}

static void shift_blocks(gg_population *p, gg_vec by)
{
  for (size_t b = 0; b < p->n_blocks; b++)
    for (int l = 0; l < GG_LANES; l++) {
      p->c[b].x[l] -= by.x;
      p->c[b].y[l] -= by.y;
      p->c[b].z[l] -= by.z;
    }
  for (size_t a = (size_t)p->n; a < p->n_blocks * GG_LANES; a++) gg_block_set(p->c, (uint32_t)a, (gg_vec){0, 0, 0});
}

void gg_ensemble_centre(gg_ensemble *e)
{
  double mass = 0;
  gg_vec momentum = {0, 0, 0};
  for (int i = 0; i < e->n_species; i++) {
    mass += e->of[i].mass * (double)e->of[i].n;
    momentum = gg_axpy(e->of[i].mass, total(&e->of[i]), momentum);
  }
  gg_vec centre = gg_scale(1 / mass, momentum);
  for (int i = 0; i < e->n_species; i++) shift_blocks(&e->of[i], centre);
}

gg_moments gg_ensemble_moments(const gg_ensemble *e)
{
  gg_moments m = {0};
  double n = 0, energy = 0, largest = 0;
  for (int i = 0; i < e->n_species; i++) {
    const gg_population *p = &e->of[i];
    double sum[GG_LANES] = {0}, most[GG_LANES] = {0}, all = 0;
    for (size_t b = 0; b < p->n_blocks; b++) {
      const gg_block *c = &p->c[b];
      for (int l = 0; l < GG_LANES; l++) {
        double c2 = c->x[l] * c->x[l] + c->y[l] * c->y[l] + c->z[l] * c->z[l];
        sum[l] += c2;
        most[l] = c2 > most[l] ? c2 : most[l];
      }
    }
    for (int l = 0; l < GG_LANES; l++) {
      all += sum[l];
      largest = most[l] > largest ? most[l] : largest;
    }
    n += (double)p->n;
    energy += p->mass * all;
    m.partial[i] = p->mass * all / (3 * (double)p->n);
  }
  m.temperature = energy / (3 * n);
  m.fastest = sqrt(largest);
  return m;
}

static const char *const velocity_items[] = {"dsmc/velocity_1", "dsmc/velocity_2"};
static const char *const spin_items[] = {"dsmc/spin_1", "dsmc/spin_2"};

gg_status gg_ensemble_save(const gg_ensemble *e, gg_archive *archive, gg_error *err)
{
  for (int i = 0; i < e->n_species; i++) {
    const gg_population *p = &e->of[i];
    size_t n = p->n_blocks * sizeof(gg_block) / sizeof(double);
    GG_TRY(gg_archive_put(archive, velocity_items[i], GG_ITEM_F64, p->c, n, err));
    if (p->s) GG_TRY(gg_archive_put(archive, spin_items[i], GG_ITEM_F64, p->s, n, err));
  }
  return GG_OK;
}

gg_status gg_ensemble_restore(gg_ensemble *e, const gg_archive *archive, gg_error *err)
{
  for (int i = 0; i < e->n_species; i++) {
    gg_population *p = &e->of[i];
    size_t n = p->n_blocks * sizeof(gg_block) / sizeof(double);
    GG_TRY(gg_archive_get(archive, velocity_items[i], GG_ITEM_F64, p->c, n, err));
    if (p->s) GG_TRY(gg_archive_get(archive, spin_items[i], GG_ITEM_F64, p->s, n, err));
  }
  return GG_OK;
}
