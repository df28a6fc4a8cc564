/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts of the reference pages around their tables and of --help, made of src/cli/pages/NAME.md. */
extern const char gg_cli_page_scene[], gg_cli_page_scene_notes[], gg_cli_page_quantities[],
    gg_cli_page_quantities_notes[], gg_cli_page_help_sweep[], gg_cli_page_help_validate[], gg_cli_page_help_export[],
    gg_cli_page_help_bench[], gg_cli_page_help_run[], gg_cli_page_help_page[];
