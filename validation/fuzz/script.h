/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Can a script for gnuplot do anything but draw? */
#ifndef GG_FUZZ_SCRIPT_H
#define GG_FUZZ_SCRIPT_H

/* Prints the line that could and aborts. It may hold: `set`, `unset` and `plot` with words that set no file and run
 * nothing, texts that end on their line, and blocks of numbers that `plot` draws by name. */
void fuzz_check_script(const char *script);

#endif
