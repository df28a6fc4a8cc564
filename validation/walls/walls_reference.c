/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Enskog's equation between two rough walls that move against each other, solved by a plain Monte Carlo method.
 * Shares no code and no method with src/dsmc/walls, to check the engine there.
 *
 * Spheres (m = d = 1) are uniform along x and z over an area A. Spheres i and j at heights y_i and y_j can touch only
 * if k_y = y_j - y_i, |k_y| < 1, with k the unit vector from i to j. Integrating Enskog's rate
 *     chi g_n dk,   dk = dk_y dpsi,
 * over relative positions gives each pair the rate (chi/A) int (k.g)_+ dpsi, psi the azimuth of k about y. So pairs are
 * drawn by their actual heights: there are no cells in the collision term. Splitting flights from collisions is the
 * only approximation.
 *
 * chi is that of Carnahan and Starling for the share of the volume that spheres fill about the point of contact,
 *     phi(y) = int n(y') pi (1/4 - (y - y')^2) dy',   |y - y'| < 1/2.
 * n is a mean over `memory` of time, which has to be short: if chi answers late to waves of density, these grow.
 *
 * walls_reference KEY VALUE ... prints quantities and profiles as CSV: [height,] name, value, standard error. Keys and
 * their defaults are in main. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCKS = 16, MAX_SLABS = 200, MAX_GRID = 2000, MAX_BINS = 512 };
static const double pi = 3.14159265358979323846;
static double K;                 /* 4 I / (m d^2) */
static const double GRID = 0.02; /* spacing of the tables of density and chi */
static const double BIN = 0.1;   /* bins only list the spheres within one diameter: no physics */

typedef struct {
  double y, v[3], w[3];
} grain;

typedef struct {
  double n, y, yy, vx, vxy, vy, v2, wz, wzy, w2;
  double vxvy, transfer; /* flux of x momentum upwards: kinetic, collisional */
} sums;

typedef struct {
  int count, slabs, grid, bins;
  double L, A, e, beta, wall_e, wall_beta, U, step, memory, time;
  grain *grains;
  int *order, *first; /* grains by bin: order[first[b]] ... order[first[b+1] - 1] */
  double density[MAX_GRID], weight, chi[MAX_GRID + 1], majorant[MAX_BINS];
  uint64_t rng[4];
  sums slab[MAX_SLABS];
  double samples, started, wall_x[2], wall_y[2];
  long collisions, overflows, candidates;
} gas;

static uint64_t rotl(uint64_t x, int k)
{
  return x << k | x >> (64 - k);
}

/* Uniform in [0, 1): xoshiro256+ */
static double uniform(gas *s)
{
  uint64_t *r = s->rng, out = r[0] + r[3], t = r[1] << 17;
  r[2] ^= r[0], r[3] ^= r[1], r[1] ^= r[2], r[0] ^= r[3], r[2] ^= t, r[3] = rotl(r[3], 45);
  return (double)(out >> 11) * 0x1p-53;
}

static double normal(gas *s)
{
  return sqrt(-2 * log(1 - uniform(s))) * cos(2 * pi * uniform(s));
}

static void cross(const double a[3], const double b[3], double out[3])
{
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Impulse of a contact: its normal and its tangential part are proportional to those of the contact velocity. */
static void impulse(const double g[3], const double k[3], double normal_part, double tangential_part, double J[3])
{
  double gn = g[0] * k[0] + g[1] * k[1] + g[2] * k[2];
  for (int a = 0; a < 3; a++) J[a] = normal_part * gn * k[a] + tangential_part * (g[a] - gn * k[a]);
}

static void collide(gas *s, grain *p, grain *q, const double k[3])
{
  double w[3] = {p->w[0] + q->w[0], p->w[1] + q->w[1], p->w[2] + q->w[2]}, turn[3], g[3], J[3], kJ[3];
  cross(k, w, turn);
  for (int a = 0; a < 3; a++) g[a] = p->v[a] - q->v[a] - turn[a] / 2;
  impulse(g, k, (1 + s->e) / 2, (1 + s->beta) / 2 * K / (1 + K), J);
  cross(k, J, kJ);
  for (int a = 0; a < 3; a++) {
    p->v[a] -= J[a], q->v[a] += J[a];
    p->w[a] -= 2 / K * kJ[a], q->w[a] -= 2 / K * kJ[a];
  }
  /* The x momentum J_x passes from p to q: through every slab between them, in proportion to the height there. */
  double low = fmin(p->y, q->y), high = fmax(p->y, q->y), width = s->L / s->slabs;
  for (int b = (int)(low / width); b <= (int)(high / width) && b < s->slabs; b++) {
    double part = fmin(high, (b + 1) * width) - fmax(low, b * width);
    s->slab[b].transfer += J[0] * (q->y > p->y ? part : -part);
  }
  s->collisions++;
}

static void hit_wall(gas *s, grain *p, int upper)
{
  double n[3] = {0, upper ? 1 : -1, 0}, turn[3], g[3], J[3], nJ[3];
  cross(n, p->w, turn);
  for (int a = 0; a < 3; a++) g[a] = p->v[a] - turn[a] / 2;
  g[0] -= upper ? s->U : -s->U;
  impulse(g, n, 1 + s->wall_e, (1 + s->wall_beta) * K / (1 + K), J);
  cross(n, J, nJ);
  for (int a = 0; a < 3; a++) p->v[a] -= J[a], p->w[a] -= 2 / K * nJ[a];
  s->wall_x[upper] += J[0], s->wall_y[upper] += fabs(J[1]);
}

static void fly(gas *s, double t)
{
  for (int i = 0; i < s->count; i++) {
    grain *p = &s->grains[i];
    double left = t;
    for (;;) {
      double to = p->v[1] > 0 ? s->L - 0.5 : 0.5, y = p->y + p->v[1] * left;
      if (p->v[1] > 0 ? y < to : y > to) {
        p->y = y;
        break;
      }
      if (p->v[1] == 0) break;
      left -= fmax((to - p->y) / p->v[1], 0);
      p->y = to;
      hit_wall(s, p, p->v[1] > 0);
      if (left <= 0) break;
    }
  }
  s->time += t;
}

static int bin_of(const gas *s, double y)
{
  int b = (int)((y - 0.5) / BIN);
  return b < 0 ? 0 : b >= s->bins ? s->bins - 1 : b;
}

static void sort(gas *s)
{
  int *first = s->first;
  memset(first, 0, sizeof *first * (size_t)(s->bins + 1));
  for (int i = 0; i < s->count; i++) first[bin_of(s, s->grains[i].y) + 1]++;
  for (int b = 0; b < s->bins; b++) first[b + 1] += first[b];
  int next[MAX_BINS];
  memcpy(next, first, sizeof *next * (size_t)s->bins);
  for (int i = 0; i < s->count; i++) s->order[next[bin_of(s, s->grains[i].y)]++] = i;
}

/* Mean density over the memory */
static void add_density(gas *s)
{
  double keep = fmax(1 - s->step / s->memory, 0);
  s->weight = keep * s->weight + 1;
  for (int c = 0; c < s->grid; c++) s->density[c] *= keep;
  for (int i = 0; i < s->count; i++) s->density[(int)(s->grains[i].y / GRID)] += 1;
}

/* chi at each point of the grid: the density of a cell counts by the exact integral of pi (1/4 - z^2) over the cell. */
static void contact_values(gas *s)
{
  enum { REACH = 25 }; /* GRID times REACH is the radius of the sphere */
  double part[REACH];
  for (int c = 0; c < REACH; c++) {
    double z0 = c * GRID, z1 = (c + 1) * GRID;
    part[c] = pi * ((z1 - z0) / 4 - (z1 * z1 * z1 - z0 * z0 * z0) / 3) / (GRID * s->A * s->weight);
  }
  for (int a = 0; a <= s->grid; a++) {
    double phi = 0;
    for (int c = 0; c < REACH; c++) {
      if (a + c < s->grid) phi += s->density[a + c] * part[c];
      if (a - c > 0) phi += s->density[a - c - 1] * part[c];
    }
    phi = fmin(phi, 0.63);
    s->chi[a] = (1 - phi / 2) / ((1 - phi) * (1 - phi) * (1 - phi));
  }
}

static double chi_at(const gas *s, double y)
{
  double x = y / GRID;
  int c = (int)x;
  return s->chi[c] + (x - c) * (s->chi[c + 1] - s->chi[c]);
}

/* One candidate of grain p: a partner among the `n` spheres from order[first] on */
static void candidate(gas *s, grain *p, int first, int n, double *majorant)
{
  grain *q = &s->grains[s->order[first + (int)(uniform(s) * n)]];
  double ky = q->y - p->y;
  s->candidates++;
  if (q == p || fabs(ky) >= 1) return;
  double chi = chi_at(s, (p->y + q->y) / 2), least = uniform(s) * *majorant / chi, g[3], g2 = 0;
  for (int a = 0; a < 3; a++) g[a] = p->v[a] - q->v[a], g2 += g[a] * g[a];
  if (g2 < least * least) return; /* whatever the azimuth */
  double psi = 2 * pi * uniform(s), r = sqrt(1 - ky * ky), k[3] = {r * cos(psi), ky, r * sin(psi)};
  double gn = k[0] * g[0] + k[1] * g[1] + k[2] * g[2];
  if (gn > *majorant / chi) *majorant = 1.1 * gn * chi, s->overflows++;
  if (gn > least) collide(s, p, q, k);
}

/* Every ordered pair has half of its rate, 2 pi chi g_n / A for a uniform azimuth. */
static void collisions(gas *s)
{
  int stride, a, b;
  do { /* a random order of grains: a stride without common divisor with their number */
    stride = 1 + (int)(uniform(s) * (s->count - 1));
    for (a = stride, b = s->count; b;) {
      int rest = a % b;
      a = b, b = rest;
    }
  } while (a != 1);
  for (int c = 0; c < s->bins; c++) s->majorant[c] *= 1 - 5e-5; /* the start's are too high */
  int reach = (int)(1 / BIN) + 1;
  long i = (long)(uniform(s) * s->count);
  for (int n = 0; n < s->count; n++, i = (i + stride) % s->count) {
    grain *p = &s->grains[i];
    int at = bin_of(s, p->y), low = at > reach ? at - reach : 0, high = at + reach + 1;
    if (high > s->bins) high = s->bins;
    int first = s->first[low], near = s->first[high] - first;
    double mean = near * pi * s->majorant[at] * s->step / s->A;
    for (int c = (int)(mean + uniform(s)); c > 0; c--) candidate(s, p, first, near, &s->majorant[at]);
  }
}

static void sample(gas *s)
{
  for (int i = 0; i < s->count; i++) {
    const grain *p = &s->grains[i];
    sums *b = &s->slab[(int)(p->y / s->L * s->slabs)];
    double y = p->y - s->L / 2;
    b->n += 1, b->y += y, b->yy += y * y;
    b->vx += p->v[0], b->vxy += p->v[0] * y, b->vy += p->v[1];
    b->v2 += p->v[0] * p->v[0] + p->v[1] * p->v[1] + p->v[2] * p->v[2];
    b->wz += p->w[2], b->wzy += p->w[2] * y;
    b->w2 += p->w[0] * p->w[0] + p->w[1] * p->w[1] + p->w[2] * p->w[2];
    b->vxvy += p->v[0] * p->v[1];
  }
  s->samples += 1;
}

enum { PHI, VELOCITY, T, THETA, SPIN, RATIO, STRESS, ROWS };
typedef struct {
  double of[ROWS][MAX_SLABS], mean_T, mean_theta, wall_x, wall_y;
} profile;

static double variance_of_line(double n, double y, double yy, double f, double fy)
{
  double var = yy / n - y / n * y / n, cov = fy / n - y / n * f / n;
  return f / n * f / n + (var > 0 ? cov * cov / var : 0);
}

/* Profiles of a block. Folding: the half turn about z maps the flow onto itself. */
static profile evaluate(const gas *s)
{
  profile r = {0};
  double width = s->L / s->slabs, t = s->time - s->started;
  for (int b = 0; b < s->slabs; b++) {
    const sums *l = &s->slab[b], *m = &s->slab[s->slabs - 1 - b];
    double n = l->n + m->n, y = l->y - m->y, yy = l->yy + m->yy, vx = l->vx - m->vx, vxy = l->vxy + m->vxy;
    double wz = l->wz + m->wz, wzy = l->wzy - m->wzy;
    r.of[PHI][b] = n / 2 * pi / 6 / (s->samples * s->A * width);
    r.of[VELOCITY][b] = vx / n;
    r.of[T][b] = ((l->v2 + m->v2) / n - variance_of_line(n, y, yy, vx, vxy)) / 3;
    r.of[THETA][b] = K / 12 * ((l->w2 + m->w2) / n - variance_of_line(n, y, yy, wz, wzy));
    r.of[RATIO][b] = r.of[THETA][b] / r.of[T][b];
    r.of[SPIN][b] = wz / n;
    r.of[STRESS][b] = ((l->vxvy + m->vxvy) / 2 / s->samples + (l->transfer + m->transfer) / 2 / t) / (s->A * width);
    r.mean_T += n / 2 * r.of[T][b] / (s->samples * s->count);
    r.mean_theta += n / 2 * r.of[THETA][b] / (s->samples * s->count);
  }
  r.wall_x = (s->wall_x[1] - s->wall_x[0]) / 2 / (s->A * t);
  r.wall_y = (s->wall_y[1] + s->wall_y[0]) / 2 / (s->A * t);
  return r;
}

static void clear(gas *s)
{
  memset(s->slab, 0, sizeof s->slab);
  s->samples = s->wall_x[0] = s->wall_x[1] = s->wall_y[0] = s->wall_y[1] = 0;
  s->started = s->time;
}

static void run(gas *s, double until, int measure)
{
  for (int n = 0; s->time < until; n++) {
    fly(s, s->step / 2);
    sort(s);
    add_density(s);
    if (n % 10 == 0) contact_values(s);
    collisions(s);
    fly(s, s->step / 2);
    if (measure) sample(s); /* at the end of the symmetric step: within it, errors are of first order */
  }
}

static void begin(gas *s, double temperature, uint64_t seed)
{
  for (int a = 0; a < 4; a++) { /* splitmix64 */
    uint64_t z = (seed += 0x9e3779b97f4a7c15u);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u, z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    s->rng[a] = z ^ z >> 31;
  }
  s->bins = (int)ceil((s->L - 1) / BIN), s->grid = (int)ceil(s->L / GRID);
  s->grains = calloc((size_t)s->count, sizeof *s->grains);
  s->order = calloc((size_t)s->count, sizeof *s->order);
  s->first = calloc((size_t)s->bins + 1, sizeof *s->first);
  if (!s->grains || !s->order || !s->first || s->bins >= MAX_BINS || s->grid >= MAX_GRID) exit(3);
  for (int b = 0; b < s->bins; b++) s->majorant[b] = 6 * sqrt(temperature);
  for (int i = 0; i < s->count; i++) {
    grain *p = &s->grains[i];
    p->y = 0.5 + (s->L - 1) * uniform(s);
    for (int a = 0; a < 3; a++)
      p->v[a] = sqrt(temperature) * normal(s), p->w[a] = sqrt(4 * temperature / K) * normal(s);
    p->v[0] += s->U * (2 * p->y / s->L - 1);
  }
}

static double argument(int argc, char **argv, const char *key, double value)
{
  for (int a = 1; a + 1 < argc; a += 2)
    if (!strcmp(argv[a], key)) return strtod(argv[a + 1], NULL);
  return value;
}

static void row(const char *name, const profile *r, const double *x)
{
  double m = 0, v = 0;
  for (int b = 0; b < BLOCKS; b++) m += x[b * (int)(sizeof *r / sizeof *x)] / BLOCKS;
  for (int b = 0; b < BLOCKS; b++) v += pow(x[b * (int)(sizeof *r / sizeof *x)] - m, 2) / (BLOCKS * (BLOCKS - 1));
  printf("%s,%.6g,%.3g", name, m, sqrt(v));
}

/* `box` grains fill a cube as wide as the gap; by default the walls, of speed L/2, shear the gap at the rate 1. */
int main(int argc, char **argv)
{
  static gas s;
  K = argument(argc, argv, "inertia", 0.4); /* of smooth grains, which do not spin: infinite */
  double phi = argument(argc, argv, "phi", 0.3), box = argument(argc, argv, "box", 1000);
  s.count = (int)argument(argc, argv, "grains", 3000);
  s.L = argument(argc, argv, "gap", cbrt(box * pi / (6 * phi)));
  s.A = s.count * pi / (6 * phi * s.L);
  s.slabs = (int)argument(argc, argv, "slabs", floor(2 * s.L));
  s.e = argument(argc, argv, "e", 0.9), s.beta = argument(argc, argv, "beta", 0);
  s.wall_e = argument(argc, argv, "wall_e", 0.9), s.wall_beta = argument(argc, argv, "wall_beta", 1);
  s.U = argument(argc, argv, "speed", s.L / 2);
  s.step = argument(argc, argv, "step", 0.04), s.memory = argument(argc, argv, "memory", 1);
  begin(&s, argument(argc, argv, "temperature", 0.1), (uint64_t)argument(argc, argv, "seed", 1));
  double warm = argument(argc, argv, "warm", 600), span = argument(argc, argv, "time", 1600);
  run(&s, warm, 0);
  s.collisions = s.overflows = s.candidates = 0;
  static profile r[BLOCKS];
  for (int b = 0; b < BLOCKS; b++) {
    clear(&s);
    run(&s, warm + span * (b + 1) / BLOCKS, 1);
    r[b] = evaluate(&s);
  }
  printf("# N %d L %.5f slabs %d; %.4g collisions, per grain and time %.4g, candidates %.3g, overflows %ld\n", s.count,
         s.L, s.slabs, (double)s.collisions, 2.0 * (double)s.collisions / s.count / span,
         (double)s.candidates / (double)s.collisions, s.overflows);
  row("temperature", r, &r[0].mean_T), printf("\n");
  row("rotational_temperature", r, &r[0].mean_theta), printf("\n");
  row("wall_P_yx", r, &r[0].wall_x), printf("\n");
  row("wall_P_yy", r, &r[0].wall_y), printf("\n");
  static const char *const names[ROWS] = {
      "solid_fraction", "velocity", "temperature", "rotational_temperature", "spin_z", "temperature_ratio", "P_yx"};
  for (int q = 0; q < ROWS; q++)
    for (int b = 0; b < (s.slabs + 1) / 2; b++) {
      printf("%.4f,", (b + 0.5) * s.L / s.slabs);
      row(names[q], r, &r[0].of[q][b]);
      printf("\n");
    }
}
