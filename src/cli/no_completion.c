/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program that prints the tables completes nothing. */
#include "cli/options.h"

const char gg_cli_completion_bash[] = "", gg_cli_completion_zsh[] = "", gg_cli_completion_fish[] = "";
