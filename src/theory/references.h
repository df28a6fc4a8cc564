/* SPDX-License-Identifier: GPL-3.0-or-later */
/* References of the program and of its methods, as BibTeX. */
#ifndef GG_THEORY_REFERENCES_H
#define GG_THEORY_REFERENCES_H

#include <stddef.h>

/* Entries of references.bib, after its first comment; NULL after the last. */
extern const char *const gg_theory_references_text[];

/* Entries of the program and of methods: names of engines, theories and laws, with blanks or commas between them. An
 * entry that two methods share appears once. *n, which may be NULL, is the number of words that have an entry. From
 * malloc; NULL: out of memory. */
char *gg_theory_references(const char *words, size_t *n);

#endif
