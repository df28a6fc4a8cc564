/* Which checkpoints can be gone on from. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/h5/checkpoint_file.h"
#include "files/h5/hdf5_reader.h"

/* States are saved as they stand in memory, which another version may have laid out otherwise. The first layout did not
 * say its number. */
void gg_files_checkpoint_check_version(struct gg_h5_in *h)
{
  int64_t layout = 1;
  char *version = gg_h5_read_text(h, "/checkpoint/version"), why[200];
  if (version && gg_h5_has_attribute(h, "/checkpoint/version", "layout"))
    gg_h5_read_attribute(h, "/checkpoint/version", "layout", GG_ITEM_I64, &layout);
  if (version && (strcmp(version, GG_VERSION) != 0 || layout != GG_CHECKPOINT_LAYOUT)) {
    snprintf(
        why, sizeof why,
        "graingas %.20s has written it (layout %lld), and this is graingas %s (layout %d); only the same can go on",
        version, (long long)layout, GG_VERSION, GG_CHECKPOINT_LAYOUT);
    gg_h5_in_failed(h, why);
  }
  free(version);
}
