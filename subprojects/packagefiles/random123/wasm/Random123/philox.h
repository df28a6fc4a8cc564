/* Random123 knows no WebAssembly and stops there; nothing in Philox depends on the machine but 128-bit products, which
 * its compiler has. */
#ifndef __s390x__
#define __s390x__
#define R123_USE_GNU_UINT128 1
#include_next <Random123/philox.h>
#undef __s390x__
#endif
