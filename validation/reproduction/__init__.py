# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of papers, simulated anew: validation/figures/NAME.yaml becomes NAME.csv, NAME_numbers.csv and pictures."""
