/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Check of scripts for gnuplot: they may only draw. */
#ifndef GG_FUZZ_SCRIPT_H
#define GG_FUZZ_SCRIPT_H

/* Abort if a line of the script can do anything else, and print that line. Allowed: `set`, `unset` and `plot` without
 * file names and commands, quoted texts that end on their line, and blocks of numbers that `plot` draws by name. */
void fuzz_check_script(const char *script);

#endif
