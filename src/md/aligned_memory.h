/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory for what events jump all over. */
#ifndef GG_MD_ALIGNED_MEMORY_H
#define GG_MD_ALIGNED_MEMORY_H

#include <stddef.h>

#include "base/error.h"

/* A zeroed array on cache lines, in huge pages if it is large. Released by free(). */
void *gg_md_new_lines(size_t count, size_t size, gg_error *err);

/* The same at the start of a page, for what is written all the time: a store across the end of a page is slow. */
void *gg_md_new_pages(size_t count, size_t size, gg_error *err);

#endif
