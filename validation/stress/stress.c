/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stability suite runs each corner (a row of corners.c) on both engines, which are right or reject the scene with
 * the reason. Checks: no NaN or infinity; time and collisions only grow; no two grains overlap, none leaves the box or
 * enters a wall; momentum; the energy budget, collision by collision; each collision beside the rule; the first
 * collisions of md beside its reference path; means of both engines and of the solved Enskog equation.
 *
 * stress [--quick] [--list] [--tap] [NAME ...] runs all corners but those that take long, the quick ones, or those
 * whose name contains NAME. It prints a table (Markdown), or TAP for a test. Exit code 0; 1: a corner is neither right
 * nor rejected as it should be; 2: the command line is wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "corner.h"

static const char *const engines[2] = {"md", "dsmc"};

typedef struct options {
  bool quick, list, tap;
  int n_names;
  char **name;
} options;

typedef struct tally {
  int right, refused, wrong, reported;
} tally;

static bool is_selected(const options *o, const corner *c)
{
  if (c->subject || (o->quick && c->when != QUICK)) return false;
  bool named = o->n_names == 0 && c->when != ONLY_BY_NAME;
  for (int i = 0; i < o->n_names; i++) named |= strstr(c->name, o->name[i]) != NULL;
  return named;
}

static bool is_section_selected(const options *o, const corner *head)
{
  for (const corner *c = head + 1; c->name; c++)
    if (is_selected(o, c)) return true;
  return false;
}

static void format_number(char text[16], double x)
{
  if (isnan(x))
    text[0] = 0;
  else
    snprintf(text, 16, x == 0 ? "0" : "%.0e", x);
}

static void print_row(const corner *c, const char *engine, const finding *f, const char *wrong)
{
  char overlap[16], momentum[16], energy[16], rule[16], pairs[32] = "", z[32] = "", gap[16];
  const bool ran = !f->refused && !f->ended;
  format_number(overlap, strcmp(engine, "md") == 0 && ran ? f->overlap : NAN);
  format_number(momentum, ran ? f->momentum : NAN);
  format_number(energy, ran ? f->energy : NAN);
  format_number(rule, ran && strcmp(engine, "md") == 0 ? f->rule : NAN);
  format_number(gap, f->departure);
  if (f->compared_pairs) snprintf(pairs, sizeof pairs, "%d of %d", f->same_pairs, f->compared_pairs);
  if (!isnan(f->z)) snprintf(z, sizeof z, "%+.1f", f->z);
  if (!isnan(f->departure)) snprintf(gap, sizeof gap, "%+.1f", f->departure);
  printf("| %s | %s | %.2g | %s | %zu | %s | %s | %s | %s | %s | %s | %s | ", c->name, engine, f->collisions, overlap,
         f->escapes, momentum, energy, rule, ran ? (f->monotone ? "yes" : "no") : "", pairs, z, gap);
  if (wrong)
    printf("**wrong: %s** |\n", wrong);
  else if (ran)
    printf("right |\n");
  else
    printf("%s: %.160s |\n", f->refused ? "refused" : "ended", f->reason);
}

static void report(const options *o, const corner *c, const char *engine, const finding *f, tally *t)
{
  char text[256];
  const char *wrong = corner_wrong(c, engine, f, text);
  t->reported++;
  if (wrong)
    t->wrong++;
  else if (f->refused || f->ended)
    t->refused++;
  else
    t->right++;
  if (o->tap)
    printf("%sok %d - %s, %s (%.1f s)%s%s\n", wrong ? "not " : "", t->reported, c->name, engine, f->seconds,
           wrong ? ": " : "", wrong ? wrong : "");
  else
    print_row(c, engine, f, wrong);
  fflush(stdout);
}

static bool runs(const corner *c, int engine)
{
  const char *reason = engine ? c->dsmc : c->md;
  return !(reason && strcmp(reason, NOT_RUN) == 0);
}

static void run_on_both(const options *o, const corner *c, tally *t)
{
  finding f[2];
  if (o->list) {
    printf("%s%s\n    %s\n", c->name, c->when == QUICK ? " (quick)" : "", c->scene);
    return;
  }
  for (int k = 0; k < 2; k++)
    if (runs(c, k)) corner_run(c, engines[k], &f[k]);
  if (c->agrees) corner_compare_means(c, &f[0], &f[1]);
  for (int k = 0; k < 2; k++)
    if (runs(c, k)) report(o, c, engines[k], &f[k], t);
}

static bool read_options(int argc, char **argv, options *o)
{
  int i = 1;
  for (; i < argc && strncmp(argv[i], "--", 2) == 0; i++)
    if (strcmp(argv[i], "--quick") == 0)
      o->quick = true;
    else if (strcmp(argv[i], "--list") == 0)
      o->list = true;
    else if (strcmp(argv[i], "--tap") == 0)
      o->tap = true;
    else
      return false;
  o->n_names = argc - i;
  o->name = argv + i;
  return true;
}

int main(int argc, char **argv)
{
  options o = {0};
  tally t = {0};
  if (!read_options(argc, argv, &o)) {
    fprintf(stderr, "stress [--quick] [--list] [--tap] [NAME ...]\n");
    return 2;
  }
  for (const corner *c = corners; c->subject || c->name; c++)
    if (is_selected(&o, c))
      run_on_both(&o, c, &t);
    else if (c->subject && !o.tap && !o.list && is_section_selected(&o, c))
      printf(
          "\n%s\n\n| corner | engine | collisions | overlap | escapes | momentum | energy | rule | time grows | as "
          "reference | z | to solution | verdict |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- "
          "| --- | --- |\n",
          c->subject);
  if (o.tap) printf("1..%d\n", t.reported);
  if (!o.tap && !o.list)
    printf("\n%d right, %d refused or ended as they should be, %d wrong\n", t.right, t.refused, t.wrong);
  return t.wrong > 0;
}
