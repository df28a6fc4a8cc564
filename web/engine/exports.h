/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a page calls: graingas.h with arguments that JavaScript can give, and answers that it can read. Handles are
 * addresses, answers are arrays of doubles in the order that engines.js names, texts are NUL-terminated UTF-8, to be
 * freed where they are `char *`. A call that fails returns 0 or NULL, and page_error says why. */
#ifndef GG_PAGE_EXPORTS_H
#define GG_PAGE_EXPORTS_H

#include <emscripten.h>
#include <graingas.h>

#define PAGE EMSCRIPTEN_KEEPALIVE
#pragma clang diagnostic ignored "-Wmissing-prototypes" /* their callers are in engines.js */

extern gg_error page_why; /* of the last call that failed */

/* A failure of the page's own: NULL. */
void *page_fail(const char *message);

#endif
