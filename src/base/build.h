/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Identity of this build: its version with the commit ("0.1.0+g156f34b3", scripts/version), and a hash of the sources
 * that decide numbers (scripts/build-identity). Builds of one identity give the same numbers. */
#ifndef GG_BUILD_H
#define GG_BUILD_H

extern const char gg_base_build_version[], gg_base_build_identity[];

#endif
