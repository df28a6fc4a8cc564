/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A folder made anew from another, some 200 000 times: a shell for each took a third of the time. */
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include "memory.h"

static const char *copy; /* where to; nftw takes nothing along */
static size_t root;      /* letters of the folder it is of */

static int take_away(const char *path, const struct stat *about, int kind, struct FTW *where)
{
  (void)about, (void)kind, (void)where;
  return remove(path);
}

static int put_there(const char *path, const struct stat *about, int kind, struct FTW *where)
{
  char there[600];
  (void)where;
  snprintf(there, sizeof there, "%s%s", copy, path + root);
  if (kind == FTW_D) return mkdir(there, 0777);
  int in = open(path, O_RDONLY), out = open(there, O_WRONLY | O_CREAT | O_EXCL, 0666);
  ssize_t got = 1;
  for (off_t left = about->st_size; in >= 0 && out >= 0 && left > 0 && got > 0; left -= got)
    got = sendfile(out, in, NULL, (size_t)left);
  return in < 0 || out < 0 || got <= 0 || close(in) != 0 || close(out) != 0;
}

void make_copy(const char *from, const char *to)
{
  copy = to;
  root = strlen(from);
  if (access(to, F_OK) == 0 && nftw(to, take_away, 8, FTW_DEPTH | FTW_PHYS) != 0) abort();
  if (nftw(from, put_there, 8, FTW_PHYS) != 0) abort();
}
