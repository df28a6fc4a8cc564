/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Aligned memory for arrays with random access. */
#ifndef GG_MD_ALIGNED_MEMORY_H
#define GG_MD_ALIGNED_MEMORY_H

#include <stddef.h>

#include "base/error.h"

/* Allocate a zeroed array on cache lines, in huge pages if it is large. Released by free(). */
void *gg_md_new_lines(size_t count, size_t size, gg_error *err);

/* The same at the start of a page, for arrays that are written often: a store across the end of a page is slow. */
void *gg_md_new_pages(size_t count, size_t size, gg_error *err);

#endif
