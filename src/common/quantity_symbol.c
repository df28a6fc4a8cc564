/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symbols of quantities as gnuplot's enhanced text, from their LaTeX. */
#include <string.h>

#include "base/text.h"
#include "common/quantity.h"

/* The LaTeX commands in symbols. A star is high by itself, and braces without a script are dropped. */
static const char *const marks[][2] = {
    {"\\gamma", "γ"},  {"\\zeta", "ζ"},   {"\\eta", "η"},   {"\\theta", "θ"}, {"\\kappa", "κ"}, {"\\lambda", "λ"},
    {"\\mu", "μ"},     {"\\nu", "ν"},     {"\\xi", "ξ"},    {"\\omega", "ω"}, {"\\Psi", "Ψ"},   {"\\Omega", "Ω"},
    {"\\langle", "<"}, {"\\rangle", ">"}, {"\\cos", "cos"}, {"^*", "*"},      {"^{*k}", "*^k"}, {"\\mathrm{Kn}", "Kn"}};
enum { MARKS = sizeof marks / sizeof *marks };

/* A subscript with a superscript above it: "P_{xx}^k". A star stands behind it. */
static bool is_stacked(const char *c)
{
  if (*c != '_') return false;
  c += c[1] == '{' ? strcspn(c, "}") : 1;
  return *c && c[1] == '^' && c[2] != '*' && strncmp(c + 2, "{*", 2) != 0;
}

const char *gg_common_quantity_enhanced(gg_quantity q, char *text, size_t size)
{
  char latex[48];
  const char *c = gg_common_quantity_symbol(q, latex, sizeof latex);
  *text = '\0';
  while (*c) {
    size_t k = 0;
    while (k < MARKS && strncmp(c, marks[k][0], strlen(marks[k][0])) != 0) k++;
    if (k < MARKS)
      gg_base_text_append(text, size, "%s", marks[k][1]);
    else
      gg_base_text_append(text, size, "%s%c", is_stacked(c) ? "@" : "", *c);
    c += k < MARKS ? strlen(marks[k][0]) : 1;
  }
  return text;
}
