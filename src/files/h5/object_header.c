/* Headers of objects, version 1: messages in one block, or in several of which one names the next. */
#include <stdlib.h>

#include "files/h5/hdf5_format.h"

enum { PREFIX = 16, MESSAGE = 8 };

typedef struct walk {
  gg_h5_look *look;
  void *context;
  unsigned left;             /* messages */
  uint64_t next, next_bytes; /* the block to follow; 0: none */
  bool done;
} walk;

static bool damaged(gg_h5_in *in)
{
  gg_h5_in_failed(in, "it is damaged: the header of an object in it");
  return false;
}

static bool show_block(gg_h5_in *in, walk *w, const unsigned char *block, uint64_t bytes)
{
  while (bytes >= MESSAGE && w->left > 0 && !w->done) {
    const gg_h5_message m = {(unsigned)gg_h5_word(block, 2), block[4], (unsigned)gg_h5_word(block + 2, 2),
                             block + MESSAGE};
    if (m.size > bytes - MESSAGE) return damaged(in);
    w->left--;
    if (m.kind == GG_H5_CONTINUED) {
      if (m.size < 16 || w->next) return damaged(in);
      w->next = gg_h5_word(m.data, 8);
      w->next_bytes = gg_h5_word(m.data + 8, 8);
    } else {
      w->done = w->look(in, &m, w->context);
    }
    block += MESSAGE + m.size;
    bytes -= MESSAGE + m.size;
  }
  return !in->failed;
}

/* Each block takes a message of those that are left to name it, so that no circle goes on for ever. */
bool gg_h5_messages(gg_h5_in *in, uint64_t header, gg_h5_look *look, void *context)
{
  unsigned char start[PREFIX];
  if (!gg_h5_bytes(in, header, start, sizeof start)) return false;
  if (start[0] == 'O') return gg_h5_in_failed(in, "it is of a form of HDF5 that graingas does not write"), false;
  if (start[0] != 1) return damaged(in);
  walk w = {.look = look, .context = context, .left = (unsigned)gg_h5_word(start + 2, 2)};
  w.next = header + PREFIX;
  w.next_bytes = gg_h5_word(start + 8, 4);
  while (w.next && w.left > 0 && !w.done && !in->failed) {
    const uint64_t at = w.next, bytes = w.next_bytes;
    if (bytes > 16 * GG_H5_MOST_HEADER || bytes > in->size) return damaged(in);
    unsigned char *block = malloc(bytes + 1);
    w.next = 0;
    if (!block)
      gg_h5_in_failed(in, "out of memory");
    else if (gg_h5_bytes(in, at, block, bytes))
      show_block(in, &w, block, bytes);
    free(block);
  }
  return !in->failed;
}
