/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Print the best set of instructions of this machine, when the build is configured. Same tests as in dispatch.c. */
#include <stdio.h>

#include "levels.h"

int main(void)
{
  puts(gg_has_avx512() ? "avx512" : gg_has_avx2() ? "avx2" : "baseline");
  return 0;
}
