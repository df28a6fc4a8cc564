/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bytes of a file that is read. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "files/h5/checksum_trailer.h"
#include "files/h5/hdf5_format.h"

void gg_h5_in_failed(gg_h5_in *in, const char *why)
{
  if (in->failed) return;
  in->failed = true;
  if (errno == ENOMEM) gg_base_memory_lacked();
  snprintf(in->why, sizeof in->why, "%s", errno == ENOMEM ? "out of memory" : why);
}

bool gg_h5_refuse(gg_h5_in *in, const char *what, const char *why)
{
  char text[256];
  snprintf(text, sizeof text, "%.100s: %s", what, why);
  gg_h5_in_failed(in, text);
  return false;
}

gg_status gg_h5_in_status(const gg_h5_in *in, const char *path, gg_error *err)
{
  return in->failed ? gg_base_fail(err, GG_BAD_FILE, "%s: cannot be read: %s", path, in->why) : GG_OK;
}

uint64_t gg_h5_word(const unsigned char *from, int bytes)
{
  uint64_t word = 0;
  for (int i = bytes - 1; i >= 0; i--) word = word << 8 | from[i];
  return word;
}

static bool read_at(gg_h5_in *in, uint64_t at, unsigned char *to, uint64_t n)
{
  while (n > 0) {
    ssize_t got = pread(in->fd, to, n, (off_t)at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return gg_h5_in_failed(in, strerror(errno)), false;
    if (got == 0) return gg_h5_in_failed(in, "it was shortened while graingas read it"), false;
    to += got, at += (uint64_t)got, n -= (uint64_t)got;
  }
  return true;
}

bool gg_h5_bytes(gg_h5_in *in, uint64_t at, void *to, uint64_t n)
{
  if (in->failed) return false;
  if (n > in->size || at > in->size - n) {
    gg_h5_in_failed(in, "it is damaged: an address in it lies beyond its end");
    return false;
  }
  if (in->whole) return memcpy(to, in->whole + at, n), true;
  if (n > sizeof in->window / 4) return read_at(in, at, to, n);
  if (at < in->window_at || at - in->window_at > in->window_n || n > in->window_n - (at - in->window_at)) {
    const uint64_t left = in->size - at;
    in->window_at = at;
    in->window_n = left < sizeof in->window ? left : sizeof in->window;
    if (!read_at(in, at, in->window, in->window_n)) return in->window_n = 0, false;
  }
  memcpy(to, in->window + (at - in->window_at), n);
  return true;
}

static const char cut_off[] = "its checksum is missing: it is cut off or damaged, or another program changed it (the "
                              "manual page says how to vouch for a changed one)";

/* Version 0, and 1, which says one number more; of both the addresses and lengths that everybody has. */
static void read_superblock(gg_h5_in *in)
{
  unsigned char s[100];
  if (!gg_h5_bytes(in, 0, s, in->size < sizeof s ? in->size : sizeof s)) return;
  if (in->size < sizeof s || memcmp(s, "\x89HDF\r\n\x1a\n", 8) != 0) {
    gg_h5_in_failed(in, "it is not an HDF5 file, or a damaged one");
    return;
  }
  const int more = s[8] == 1 ? 4 : 0;
  if (s[8] > 1 || s[13] != 8 || s[14] != 8 || gg_h5_word(s + 24 + more, 8) != 0)
    gg_h5_in_failed(in, "it is of a form of HDF5 that graingas does not write");
  in->root = gg_h5_word(s + 64 + more, 8);
  if (in->changed && gg_h5_word(s + 40 + more, 8) != in->size) gg_h5_in_failed(in, cut_off);
}

void gg_h5_open(gg_h5_in *in, const char *path, bool any)
{
  *in = (gg_h5_in){.fd = -1};
  errno = 0;
  const char *broken = gg_files_checksum_trailer_open(path, &in->fd, &in->size, &in->own, &in->changed);
  in->whole = in->own;
  if (!broken && in->changed && !any) broken = cut_off;
  broken ? gg_h5_in_failed(in, broken) : read_superblock(in);
}

void gg_h5_open_bytes(gg_h5_in *in, const void *bytes, size_t size)
{
  *in = (gg_h5_in){.fd = -1, .whole = bytes};
  errno = 0;
  const char *broken = gg_files_checksum_trailer_check(bytes, size, &in->size);
  broken ? gg_h5_in_failed(in, broken) : read_superblock(in);
}

void gg_h5_in_close(gg_h5_in *in)
{
  if (in->fd >= 0) close(in->fd);
  free(in->own);
  in->fd = -1;
  in->whole = in->own = NULL;
}
