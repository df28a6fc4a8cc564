/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A folder of its own for a test that writes files: it is entered before, and gone afterwards. */
#ifndef OWN_FOLDER_H
#define OWN_FOLDER_H

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

static char folder[] = "/tmp/graingas-files-XXXXXX";

static inline int enter(void **state)
{
  (void)state;
  signal(SIGXFSZ, SIG_IGN);
  return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static inline void remove_all(void)
{
  DIR *d = opendir(".");
  for (struct dirent *e; (e = readdir(d));)
    if (e->d_name[0] != '.') unlink(e->d_name);
  closedir(d);
}

static inline int leave(void **state)
{
  (void)state;
  remove_all();
  return chdir("/") == 0 ? rmdir(folder) : -1;
}

static inline int count_files(void)
{
  int n = 0;
  DIR *d = opendir(".");
  for (struct dirent *e; (e = readdir(d));) n += e->d_name[0] != '.';
  closedir(d);
  return n;
}

#endif
