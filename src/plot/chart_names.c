/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names on axes and in legends: of scene keys and of methods. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "plot/chart.h"
#include "scene/fields.h"
#include "theory/theory.h"

static const struct {
  const char *key, *symbol;
} symbols[] = {{"collision.e", "e"},
               {"collision.beta", "β"},
               {"collision.mu", "μ"},
               {"phi", "φ"},
               {"particles", "N"},
               {"dsmc.particles", "N"},
               {"walls.e", "e_w"},
               {"walls.beta", "β_w"},
               {"walls.speed", "U_w"},
               {"walls.mu", "μ_w"},
               {"shear_rate", "γ"},
               {"temperature", "T_0"},
               {"dsmc.time_step", "Δt"},
               {"run.seed", "seed"},
               {"inertia", "K"},
               {"diameter", "σ"},
               {"mass", "m"},
               {"fraction", "x"}};

/* Length of "collision.e" in "collision.e.12", a key with an index. */
static size_t stem_of(const char *key)
{
  const char *dot = strrchr(key, '.');
  bool indexed = dot && dot[1] && strspn(dot + 1, "0123456789") == strlen(dot + 1);
  return indexed ? (size_t)(dot - key) : strlen(key);
}

static bool is(const char *key, size_t stem, const char *name)
{
  return strlen(name) == stem && strncmp(key, name, stem) == 0;
}

/* Name a member of species: "species.2.mass". */
static bool find_species(const char *key, char *text, size_t size)
{
  int species, n = 0;
  if (sscanf(key, "species.%d.%n", &species, &n) != 1 || !n) return false;
  for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++)
    if (strcmp(key + n, symbols[i].key) == 0) {
      snprintf(text, size, "%s_{%d}", symbols[i].symbol, species);
      return true;
    }
  return false;
}

void gg_plot_chart_key(const char *key, char *text, size_t size, const char **unit)
{
  size_t stem = stem_of(key);
  if (unit) *unit = "1";
  for (const gg_field *f = gg_scene_fields; unit && f->key; f++)
    if (f->unit && is(key, stem, f->key)) *unit = f->unit;
  if (find_species(key, text, size)) return;
  for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++)
    if (is(key, stem, symbols[i].key)) {
      if (key[stem])
        snprintf(text, size, "%s_{%s}", symbols[i].symbol, key + stem + 1);
      else
        snprintf(text, size, "%s", symbols[i].symbol);
      return;
    }
  gg_plot_text_escape(key, text, size);
}

static const char *const special[][2] = {{"enskog_hermite", "Enskog (Hermite)"},
                                         {"gaussian_closure", "Gaussian closure"},
                                         {"lun1991_lun_savage", "Lun 1991 (Lun–Savage)"},
                                         {"garzo_montanero2003_ms", "Garzó & Montanero 2003 (MS)"}};

/* Name a theory by its authors: "garzo_dufty1999" becomes "Garzó & Dufty 1999". */
static void name_authors(const char *key, char *text, size_t size)
{
  size_t used = 0;
  for (const char *c = key; *c && used + 8 < size; c++) {
    bool first = c == key || c[-1] == '_',
         year = isdigit((unsigned char)*c) && c > key && isalpha((unsigned char)c[-1]);
    const char *between = *c != '_' ? year ? " " : "" : strchr(c + 1, '_') ? ", " : " & ";
    used += (size_t)snprintf(text + used, size - used, "%s", between);
    if (*c == '_') continue;
    bool accent = *c == 'o' && c - key >= 4 && strncmp(c - 4, "garz", 4) == 0;
    if (accent)
      used += (size_t)snprintf(text + used, size - used, "ó");
    else
      text[used++] = (char)(first ? toupper((unsigned char)*c) : *c);
  }
  text[used] = '\0';
}

void gg_plot_method_name(const char *method, char *text, size_t size)
{
  size_t i = 0;
  while (i < sizeof special / sizeof *special && strcmp(special[i][0], method) != 0) i++;
  if (i < sizeof special / sizeof *special)
    snprintf(text, size, "%s", special[i][1]);
  else if (gg_theory_find(method))
    name_authors(method, text, size);
  else
    snprintf(text, size, "%s", method);
}
