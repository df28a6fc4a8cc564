#include "cli/checkpointing.h"

#include <stdio.h>
#include <stdlib.h>

#include "io/h5/checkpoint_file.h"

int gg_checkpointing_start(gg_checkpointing *c, const gg_options *options, const gg_scene *scene, const char *output)
{
  *c = (gg_checkpointing){options, scene, gg_checkpoint_path(output), false};
  return c->path ? GG_CLI_GO_ON : gg_cli_fail(GG_FAILED, "out of memory");
}

void gg_checkpointing_end(gg_checkpointing *c)
{
  free(c->path);
  c->path = NULL;
}

gg_status gg_checkpointing_store(gg_checkpointing *c, const gg_archive *archive, gg_error *err)
{
  GG_TRY(gg_checkpoint_write(c->path, archive, c->scene, err));
  c->stored = true;
  return GG_OK;
}

int gg_checkpointing_read(const gg_options *o, gg_archive *archive)
{
  gg_error err;
  bool older;
  if (!o->resume) return GG_CLI_GO_ON;
  if (gg_checkpoint_read(o->resume, archive, &older, &err) != GG_OK) return gg_cli_report(&err);
  if (older) fprintf(stderr, "warning: %s cannot be read; going on from the one before, %s.1\n", o->resume, o->resume);
  return GG_CLI_GO_ON;
}

void gg_checkpointing_tell_interrupted(const gg_checkpointing *c, gg_error *err)
{
  if (!c->stored)
    gg_fail(err, GG_INTERRUPTED, "interrupted; nothing was written%s",
            c->scene->output.checkpoint_every > 0 ? "" : " (output.checkpoint_every above 0 keeps a checkpoint)");
  else if (c->options->resume)
    gg_fail(err, GG_INTERRUPTED, "interrupted; go on with the same command and --resume %s", c->path);
  else
    gg_fail(err, GG_INTERRUPTED, "interrupted; go on with: %.700s --resume %s", c->options->command_line, c->path);
}
