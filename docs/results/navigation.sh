#!/usr/bin/env bash
# The figures of navigation.md: docs/results/navigation.sh OUT_DIR; goes on where it was stopped
set -euo pipefail
out=${1:?give a folder for the results}
build/release/apps/sketchloc ablate --suite navigation --methods affine,chen20,mcl,ours \
  --navigation_suite.plans 150 --navigation_suite.tps_plans 50 --seed 1 --out "$out/navigation" --force
