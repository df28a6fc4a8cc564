#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# All long runs, one after the other: every solid fraction, restitution and start of the clock.
#   tests/md/soak.sh build/tests/md/md_soak [COLLISIONS [N]]     (10^9 collisions each: hours)
# Prints a line for each; the exit status is not 0 if one fails.
soak=$1 collisions=${2:-1e9} n=${3:-1000} worst=0
for phi in 0.01 0.3 0.5; do
  for e_beta in "1 -1" "1 1" "0.9 -1" "0.9 0" "0.5 -1" "0.5 0"; do
    for start in 0 1e8; do
      # shellcheck disable=SC2086
      "$soak" $phi $e_beta "$collisions" $start "$n" 1 || worst=$?
    done
  done
done
exit $worst
