/* A struct of the caller's: its size there against its size here. */
#ifndef GG_API_SIZED_H
#define GG_API_SIZED_H

#include <string.h>

#include "api/api.h"

/* text.c: the caller may know less of a struct than the library, not more. */
gg_status gg_api_size_check(const char *function, const char *type, size_t size, size_t own, gg_error *err);

#define GG_SIZE(type, size) GG_TRY(gg_api_size_check(__func__, #type, size, sizeof(type), err))

#endif
