#!/usr/bin/env bash
# The figures of planning.md: docs/results/planning.sh OUT_DIR
set -euo pipefail
out=${1:?give a folder for the results}
build/release/apps/sketchloc ablate --suite planning --seed 1 --jobs 1 --out "$out/planning" --force
