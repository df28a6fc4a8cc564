/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run/default_size.h"

#include <math.h>
#include <stdio.h>

#include "common/model.h"
#include "scene/fields.h"
#include "scene/model_of_scene.h"
#include "theory/goldhirsch_zanetti1993.h"

/* At phi = 0.3 boxes of 500 are 9.6 d long: in shorter ones grains meet their own images. */
enum { LEAST_SIZE = 500, LEAST_SIZE_SHEARED = 200 };
/* Shear waves grow without limit towards the instability: cooling, phi = 0.2, e = 0.85, they are 4.4(4) times those of
 * an elastic gas in a box of 0.99 of the stable volume, 3.0(2) at 0.88, 2.3(1) at 0.64. */
#define SHARE_OF_STABLE 0.86
/* These waves respond to shear, too. Viscosity at phi = 0.2, e = 0.8: 2.403(32) at 0.99 of the stable volume, 1.985(25)
 * at 0.5, 1.958(27) at 0.3. */
#define SHARE_OF_STABLE_SHEARED 0.4

static bool responds(const gg_scene *s)
{
  return gg_flow_of(s->flow)->linear_response;
}

static double least_size(const gg_scene *s)
{
  return responds(s) ? LEAST_SIZE_SHEARED : LEAST_SIZE;
}

/* Up to how many grains the box stays homogeneous; NaN: always, or unknown. A law e(g), which may be the user's, has no
 * such length, and is not called here. */
static double stable_size(const gg_scene *s)
{
  gg_scene usual = *s;
  gg_model m;
  usual.particles = gg_scene_defaults().particles;
  const bool sheared = gg_flow_is_sheared(s->flow) && !responds(s);
  if (sheared || gg_flow_is_walled(s->flow) || !(s->phi > 0)) return NAN;
  if (gg_scene_has_law(s) || gg_common_extension_law(s->extension).e) return NAN;
  return gg_scene_model_make(&usual, GG_MD, &m, NULL) == GG_OK ? gg_theory_stable_grains(&m) : NAN;
}

/* True if a box with the usual number of grains is too large for a homogeneous gas. */
static bool shrinks(const gg_scene *s, double stable)
{
  return (responds(s) ? SHARE_OF_STABLE_SHEARED : 1) * stable < (double)gg_scene_defaults().particles;
}

int64_t gg_run_default_size(const gg_scene *s)
{
  const double stable = stable_size(s), share = responds(s) ? SHARE_OF_STABLE_SHEARED : SHARE_OF_STABLE;
  if (!shrinks(s, stable)) return gg_scene_defaults().particles;
  return (int64_t)fmax(least_size(s), 10 * floor(share * stable / 10));
}

void gg_run_default_size_reason(const gg_scene *s, char *text, size_t size)
{
  const double stable = gg_scene_is_given(s, "particles") ? NAN : stable_size(s);
  *text = 0;
  if (!shrinks(s, stable)) return;
  if (stable >= least_size(s))
    snprintf(text, size, "automatic: the box stays homogeneous, as it does up to about %.0f grains", stable);
  else
    snprintf(text, size,
             "automatic, the smallest: vortices and clusters grow beyond about %.0f grains, and boxes below %.0f are "
             "too narrow",
             stable, least_size(s));
}

void gg_run_scene_fill_in(gg_scene *s)
{
  gg_scene_fill_in(s);
  if (!gg_scene_is_given(s, "particles")) s->particles = gg_run_default_size(s);
}

gg_status gg_run_scene_finish(gg_scene *s, gg_error *err)
{
  gg_run_scene_fill_in(s);
  return gg_scene_finish(s, err);
}
