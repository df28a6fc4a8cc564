/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checksums of files: they detect damage, not intent. */
#ifndef GG_CHECKSUM_H
#define GG_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

#define GG_CHECKSUM_START UINT64_C(0xcbf29ce484222325)

/* `sum` with `size` bytes more; begin with GG_CHECKSUM_START. A change of any one word of eight bytes shows. */
uint64_t gg_base_checksum(uint64_t sum, const void *data, size_t size);

#endif
