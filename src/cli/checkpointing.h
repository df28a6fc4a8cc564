/* Checkpoints of a command that simulates: kept beside its output, read back by --resume. */
#ifndef GG_CLI_CHECKPOINTING_H
#define GG_CLI_CHECKPOINTING_H

#include "cli/options.h"
#include "common/archive.h"

typedef struct gg_checkpointing {
  const gg_options *options;
  const gg_scene *scene;
  char *path;
  bool stored; /* at least once in this run */
} gg_checkpointing;

/* For results in `output`; GG_CLI_GO_ON, or the exit code. */
int gg_checkpointing_start(gg_checkpointing *c, const gg_options *options, const gg_scene *scene, const char *output);
void gg_checkpointing_end(gg_checkpointing *c);
gg_status gg_checkpointing_store(gg_checkpointing *c, const gg_archive *archive, gg_error *err);
/* What --resume names, into an empty archive (left empty without --resume); GG_CLI_GO_ON, or the exit code. */
int gg_checkpointing_read(const gg_options *options, gg_archive *archive);
/* The message of an interrupted run: how to go on. */
void gg_checkpointing_tell_interrupted(const gg_checkpointing *c, gg_error *err);

#endif
