#include "md/lines.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define HUGE_PAGE ((size_t)2 << 20)

/* Events jump all over these arrays: with pages of 4 KiB nearly every jump in a large system would miss the TLB, too.
 */
void *gg_md_new_lines(size_t count, size_t size, gg_error *err)
{
  size_t bytes = (count * size + 63) / 64 * 64 + 64;
  bool huge = bytes >= 2 * HUGE_PAGE;
  void *block = aligned_alloc(huge ? HUGE_PAGE : 64, huge ? (bytes + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE : bytes);
  if (!block) {
    gg_fail(err, GG_FAILED, "out of memory: %zu items of %zu bytes were asked for", count, size);
    return NULL;
  }
#ifdef MADV_HUGEPAGE
  if (huge) madvise(block, bytes / HUGE_PAGE * HUGE_PAGE, MADV_HUGEPAGE); /* a wish: no matter if it is not granted */
#endif
  memset(block, 0, bytes);
  return block;
}
