/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "md/aligned_memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/memory.h"

#define PAGE ((size_t)4096)
#define HUGE_PAGE ((size_t)2 << 20)

/* Allocate `bytes` of zeros at a multiple of `alignment`. */
static void *new_block(size_t bytes, size_t alignment, gg_error *err)
{
  void *block = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (!block) {
    gg_base_out_of_memory_for(err, "%zu bytes", bytes);
    return NULL;
  }
#ifdef MADV_HUGEPAGE
  if (alignment == HUGE_PAGE)
    madvise(block, bytes / HUGE_PAGE * HUGE_PAGE, MADV_HUGEPAGE); /* a hint; failure is harmless */
#endif
  memset(block, 0, bytes);
  return block;
}

/* Events access these arrays at random: with pages of 4 KiB nearly every access in a large system would miss the TLB,
 * too.
 */
void *gg_md_new_lines(size_t count, size_t size, gg_error *err)
{
  size_t bytes = (count * size + 63) / 64 * 64 + 64;
  return new_block(bytes, bytes >= 2 * HUGE_PAGE ? HUGE_PAGE : 64, err);
}

void *gg_md_new_pages(size_t count, size_t size, gg_error *err)
{
  return new_block(count * size, PAGE, err);
}
