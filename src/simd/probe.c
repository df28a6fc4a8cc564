/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run when the build is configured: the best set of instructions that this machine has. The same tests as dispatch.c.
 */
#include <stdio.h>

#include "levels.h"

int main(void)
{
  puts(gg_has_avx512() ? "avx512" : gg_has_avx2() ? "avx2" : "baseline");
  return 0;
}
