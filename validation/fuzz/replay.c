/* SPDX-License-Identifier: GPL-3.0-or-later */
/* replay N PATH...: every input that is kept in these files and folders, and N seeded changes of them: bytes changed,
 * put in, taken out, repeated; pieces of two inputs put together; numbers made large. The same on every machine. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "common/rng.h"
#include "fuzz.h"

typedef struct input {
  uint8_t *data;
  size_t size;
} input;

enum { MOST = 4000, ROOM = 1 << 10 };
static input kept[MOST];
static size_t n_kept;

static void fail(const char *what, const char *path)
{
  fprintf(stderr, "replay: %s: %s\n", path, what);
  exit(2);
}

static void read_file(const char *path, size_t size)
{
  FILE *in = fopen(path, "rb");
  input one = {malloc(size + 1), size};
  if (!in || !one.data || fread(one.data, 1, size, in) != size) fail("cannot be read", path);
  fclose(in);
  if (n_kept == MOST) fail("more inputs than this program takes", path);
  kept[n_kept++] = one;
}

/* In the order of their names, which is the same everywhere. */
static void read_path(const char *path)
{
  struct stat about;
  struct dirent **entry;
  if (stat(path, &about) != 0) fail("is not there", path);
  if (!S_ISDIR(about.st_mode)) {
    read_file(path, (size_t)about.st_size);
    return;
  }
  int n = scandir(path, &entry, NULL, alphasort);
  for (int i = 0; i < n; i++) {
    char *whole = NULL;
    if (entry[i]->d_name[0] != '.' && asprintf(&whole, "%s/%s", path, entry[i]->d_name) >= 0) read_path(whole);
    free(whole);
    free(entry[i]);
  }
  if (n >= 0) free(entry);
}

static size_t draw(gg_rng *rng, size_t below)
{
  return below ? (size_t)(gg_rng_uniform(rng) * (double)below) : 0;
}

static size_t put_in(uint8_t *text, size_t size, size_t at, const uint8_t *piece, size_t length)
{
  memmove(text + at + length, text + at, size - at);
  memcpy(text + at, piece, length);
  return size + length;
}

static size_t take_out(uint8_t *text, size_t size, size_t at, size_t length)
{
  if (length > size - at) length = size - at;
  memmove(text + at, text + at + length, size - at - length);
  return size - length;
}

/* One change; `room` bytes are left behind the text. */
static size_t change(gg_rng *rng, uint8_t *text, size_t size, size_t room)
{
  static const char *const words[] = {
      "1e308", "-1", "nan", ".inf", "9223372036854775807", "1e-308", "0", "\xff\xfe", ": ", "[", "*a",
      "&a ",   "{",  "\n",  "~",    "18446744073709551616"};
  const size_t at = draw(rng, size + 1), length = 1 + draw(rng, 16);
  const input *other = &kept[draw(rng, n_kept)];
  const size_t from = draw(rng, other->size), most = other->size - from;
  const char *word = words[draw(rng, sizeof words / sizeof *words)];
  switch (draw(rng, 7)) {
  case 0: return size && at < size ? (text[at] ^= (uint8_t)(1u << draw(rng, 8)), size) : size;
  case 1: return size && at < size ? (text[at] = (uint8_t)draw(rng, 256), size) : size;
  case 2: return take_out(text, size, at, length);
  case 3: return room >= 32 ? put_in(text, size, at, (const uint8_t *)word, strlen(word)) : size;
  case 4: return most && room >= 16 ? put_in(text, size, at, other->data + from, length < most ? length : most) : size;
  case 5: /* numbers of eight bytes, as files hold them */
    if (size < 8) return size;
    memset(text + at % (size - 7), draw(rng, 2) ? 0xFF : 0, 8);
    return size;
  default: /* the rest of another */
    if (!most || most > room) return size;
    memcpy(text + at, other->data + from, most);
    return at + most;
  }
}

static void replay_changed(gg_rng *rng)
{
  const input *one = &kept[draw(rng, n_kept)];
  const size_t whole = one->size + ROOM;
  uint8_t *text = malloc(whole);
  if (!text) fail("out of memory", "a change");
  if (one->size) memcpy(text, one->data, one->size);
  size_t size = one->size;
  for (size_t k = 1 + draw(rng, 4); k > 0; k--) size = change(rng, text, size, whole - size);
  uint8_t *exact = malloc(size + 1); /* of its own size, for tools that watch memory */
  if (!exact) fail("out of memory", "a change");
  memcpy(exact, text, size);
  free(text);
  LLVMFuzzerTestOneInput(exact, size);
  free(exact);
}

int main(int argc, char **argv)
{
  if (argc < 3) fail("replay N PATH... is how it is used", argv[0]);
  const long n = strtol(argv[1], NULL, 10);
  for (int i = 2; i < argc; i++) read_path(argv[i]);
  if (!n_kept) fail("holds no inputs", argv[2]);
  for (size_t i = 0; i < n_kept; i++) LLVMFuzzerTestOneInput(kept[i].data, kept[i].size);
  gg_rng rng = gg_common_rng_seed(1, 0);
  for (long i = 0; i < n; i++) replay_changed(&rng);
  printf("%zu inputs and %ld changes of them\n", n_kept, n);
  for (size_t i = 0; i < n_kept; i++) free(kept[i].data);
  return 0;
}
