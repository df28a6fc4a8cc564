#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static _Thread_local unsigned failures;

unsigned gg_base_memory_failures(void)
{
  return failures;
}

void gg_base_memory_lacked(void)
{
  failures++;
}

gg_status gg_base_memory_check(unsigned before, gg_status status, gg_error *err)
{
  return failures != before && status == GG_OK ? gg_base_out_of_memory(err) : status;
}

gg_status gg_base_out_of_memory(gg_error *err)
{
  gg_base_memory_lacked();
  return gg_base_fail(err, GG_FAILED, "out of memory");
}

gg_status gg_base_out_of_memory_for(gg_error *err, const char *format, ...)
{
  gg_error what;
  va_list args;
  va_start(args, format);
  vsnprintf(what.message, sizeof what.message, format, args);
  va_end(args);
  gg_base_memory_lacked();
  return gg_base_fail(err, GG_FAILED, "out of memory for %s", what.message);
}

void *gg_base_array_new(size_t count, size_t size, gg_error *err)
{
  void *block = calloc(count ? count : 1, size);
  if (!block) gg_base_out_of_memory_for(err, "%zu items of %zu bytes", count, size);
  return block;
}

/* Volatile: a compiler may leave out what is asked for and given back. */
bool gg_base_memory_is_room(void)
{
  void *volatile reserve = malloc(1 << 22);
  const bool room = reserve != NULL;
  free(reserve);
  return room;
}
