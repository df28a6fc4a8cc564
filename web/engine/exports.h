/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions that a page calls: graingas.h with arguments that JavaScript can pass, and results that it can read.
 * Handles are addresses, results are arrays of doubles in the order that engines.js names, texts are NUL-terminated
 * UTF-8, to be freed if they are `char *`. A call that fails returns 0 or NULL, and page_error returns the reason. */
#ifndef GG_PAGE_EXPORTS_H
#define GG_PAGE_EXPORTS_H

#include <emscripten.h>
#include <graingas.h>

#define PAGE EMSCRIPTEN_KEEPALIVE
#pragma clang diagnostic ignored "-Wmissing-prototypes" /* the callers are in engines.js */

extern gg_error page_why; /* error of the last call that failed */

/* Set an error of the page itself; returns NULL. */
void *page_fail(const char *message);

#endif
