/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Machine and time of a run, for records. */
#ifndef GG_MACHINE_H
#define GG_MACHINE_H

#include <stddef.h>

/* "AMD EPYC 7B13"; "unknown processor" where the system does not name it. */
void gg_base_machine_processor(char *text, size_t size);
long gg_base_machine_cores(void); /* in use; hardware threads count */
/* The time in UTC: "2024-05-31T12:00:00Z". */
void gg_base_machine_date(char *text, size_t size);

#endif
