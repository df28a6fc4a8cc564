#include "common/memory_note.h"

#include <stdlib.h>

#include "common/error.h"

static _Thread_local bool lacked; /* between a begin and its end; never read without */

bool gg_memory_begin(void)
{
  bool before = lacked;
  lacked = false;
  return before;
}

bool gg_memory_end(bool before)
{
  bool now = lacked;
  lacked = before || now;
  return now;
}

void gg_memory_lacked(void)
{
  lacked = true;
}

gg_status gg_memory_check(bool before, gg_status status, gg_error *err)
{
  return gg_memory_end(before) && status == GG_OK ? gg_fail(err, GG_FAILED, "out of memory") : status;
}

/* Volatile: a compiler may leave out what is asked for and given back. */
bool gg_memory_is_room(void)
{
  void *volatile reserve = malloc(1 << 22);
  const bool room = reserve != NULL;
  free(reserve);
  return room;
}
