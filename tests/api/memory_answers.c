/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All that calls answer, as one text. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "memory.h"

static char digest[MOST_SAID];
static size_t digested;

const char *said(void)
{
  return digest;
}

void say_nothing(void)
{
  *digest = 0, digested = 0;
}

void say(const char *format, ...)
{
  va_list list;
  va_start(list, format);
  if (digested < sizeof digest)
    digested += (size_t)vsnprintf(digest + digested, sizeof digest - digested, format, list);
  va_end(list);
}

static void say_result(const gg_result *r)
{
  gg_measurement m;
  gg_curve_data c;
  gg_result_info info;
  size_t n;
  const double *time, *value;
  for (size_t i = 0; gg_result_at(r, i, &m, NULL) == GG_OK; i++)
    say("%s %a %a %a %llu %s\n", m.name, m.mean, m.error, m.correlation_time, (unsigned long long)m.samples,
        m.reason ? m.reason : "");
  for (size_t i = 0; gg_result_curve(r, i, &c, NULL) == GG_OK; i++) {
    say("%s %s %zu", c.name, c.observable, c.n);
    for (size_t k = 0; k < c.n; k++) say(" %a %a %a", c.x[k], c.value[k], c.error[k]);
    for (size_t k = 0; gg_result_curve_number(r, i, k, &m, NULL) == GG_OK; k++)
      say(" %s %a %a", m.name, m.mean, m.error);
    say("\n");
  }
  for (size_t i = 0; gg_result_warning(r, i); i++) say("%s\n", gg_result_warning(r, i));
  if (gg_result_history(r, "temperature", &n, &time, &value, NULL) == GG_OK)
    for (size_t k = 0; k < n; k++) say(" %a %a", time[k], value[k]);
  if (gg_result_get_info(r, &info, NULL) == GG_OK)
    say("%s %d %s %lld %llu %zu\n", info.engine, info.steady, info.verdict, (long long)info.grains,
        (unsigned long long)info.collisions, info.frames);
}

static void say_comparison(const gg_comparison *c)
{
  gg_theory_info t;
  gg_curve_data curve;
  gg_remark remark;
  double value;
  for (int k = 0; k < 2; k++) {
    const char *engine = k ? "dsmc" : "md";
    if (gg_comparison_result(c, engine)) say_result(gg_comparison_result(c, engine));
    if (gg_comparison_refusal(c, engine)) say("%s\n", gg_comparison_refusal(c, engine));
  }
  for (size_t i = 0; gg_comparison_theory(c, i, &t, NULL) == GG_OK; i++) {
    say("%s %s\n", t.name, t.reason ? t.reason : "");
    static const char *const names[] = {"temperature", "pressure", "shear_viscosity", "cooling_rate", "a2"};
    for (size_t k = 0; k < 5; k++)
      if (gg_comparison_theory_value(c, t.name, names[k], &value, NULL, NULL) == GG_OK) say(" %a", value);
    for (size_t k = 0; gg_comparison_theory_curve(c, t.name, k, &curve, NULL) == GG_OK; k++) say(" %s", curve.name);
  }
  for (size_t i = 0; gg_comparison_warning(c, i); i++) say("%s\n", gg_comparison_warning(c, i));
  for (size_t i = 0; gg_comparison_remark(c, i, &remark, NULL) == GG_OK; i++)
    say("%s %s\n", remark.theory ? remark.theory : "", remark.cause ? remark.cause : "");
}

static void say_h5(const char *path)
{
  gg_result *r = NULL;
  gg_comparison *c = NULL;
  if (gg_result_read(path, &r, NULL) == GG_OK)
    say_result(r);
  else if (gg_comparison_read(path, &c, NULL) == GG_OK)
    say_comparison(c);
  else
    say("%s cannot be read\n", path);
  gg_result_free(r);
  gg_comparison_free(c);
}

static void say_bytes(const char *path)
{
  static char buffer[1 << 16];
  size_t got;
  unsigned long sum = 5381;
  FILE *in = fopen(path, "rb");
  if (!in) return;
  while ((got = fread(buffer, 1, sizeof buffer, in)) > 0)
    for (size_t i = 0; i < got; i++) sum = 33 * sum + (unsigned char)buffer[i];
  fclose(in);
  say("%s %lx\n", path, sum);
}

/* JSON less what the clock says. */
static void say_json(const char *text)
{
  for (const char *line = text; line && *line;) {
    const char *end = strchr(line, '\n');
    size_t n = end ? (size_t)(end - line) : strlen(line);
    if (!memmem(line, n, "_seconds", 8)) say("%.*s\n", (int)n, line);
    line = end ? end + 1 : NULL;
  }
}

void say_things(const things *t)
{
  if (t->result) say_result(t->result);
  if (t->comparison) say_comparison(t->comparison);
  for (int i = 0; i < 3; i++) say_json(t->text[i]);
  for (int i = 0; i < 8; i++) say("%a ", t->numbers[i]);
  say("%d\n", t->lines);
}

void say_file(const char *path)
{
  const size_t n = strlen(path);
  n > 3 && strcmp(path + n - 3, ".h5") == 0 ? say_h5(path) : say_bytes(path);
}
