/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The part of zlib that checksums of files need, under zlib's names. */
#ifndef GG_PAGE_ZLIB_H
#define GG_PAGE_ZLIB_H

typedef unsigned char Bytef;
typedef unsigned int uInt;
typedef unsigned long uLong;

/* CRC-32 of ISO 3309 and Ethernet, of `sum` and so many bytes more; NULL: of none. */
uLong crc32(uLong sum, const Bytef *bytes, uInt size);

#endif
