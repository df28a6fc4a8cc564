/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef GG_FUZZ_COMPRESSED_H
#define GG_FUZZ_COMPRESSED_H

#include <hdf5.h>

void fuzz_compress(hid_t file);

#endif
