/* Hostile input: each target is one function of some bytes, which must come back from it without an error of memory,
 * an overflow or a leak, whatever they are. libFuzzer drives it where it is built so:
 *
 *   CC=clang meson setup build-fuzz -Dfuzz=true -Db_lundef=false -Dmpi=disabled -Dinstructions=baseline
 * --buildtype=debugoptimized ninja -C build-fuzz fuzzers validation/fuzz/campaign scene 10000000          # 10^7
 * executions, gone on with where it was left
 *
 * Everywhere else replay.c gives it the kept inputs (corpus/<target>, regressions/<target>) and seeded changes of them:
 * tests of the suite `fuzz`. A finding is mended in src, and its input is kept under regressions/<target>. */
#ifndef GG_FUZZ_H
#define GG_FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
