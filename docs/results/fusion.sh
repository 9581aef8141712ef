#!/usr/bin/env bash
# Re-makes the figures of docs/results/fusion.md: the filter with and without registrations, beside single
# registrations in a chain. The real drawings need the development data in $SKETCHLOC_DATA.
# Usage: docs/results/fusion.sh OUT_DIR [SEEDS_REAL [SEEDS_SIMULATED [OPTIONS OF ABLATE FOR THE SIMULATED...]]]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
out=${1:?usage: fusion.sh OUT_DIR [SEEDS_REAL [SEEDS_SIMULATED [OPTIONS...]]]}
mkdir -p "$out"

if [ -d "$data" ]; then
  intel=$data/sketches/intel_sketch_3_rot180.png,$data/logs/intel.log.gz
  intel+=,$data/references/intel_sketch_3_rot180/reference.csv,Intel
  belgioioso=$data/sketches/belgioioso_sketch.png,$data/logs/belgioioso.log.gz
  belgioioso+=,$data/references/belgioioso_sketch/reference.csv,Belgioioso
  belgioioso+=,$data/references/belgioioso_sketch/reference_alternative_B.csv
  "$sketchloc" ablate --suite real --set "$intel" --set "$belgioioso" --seeds "${2:-20}" \
    --out "$out/real" --force
else
  echo "fusion.sh: no $data; the real drawings are left out" >&2
fi
"$sketchloc" ablate --suite filter --seeds "${3:-5}" --out "$out/filter" --force "${@:4}"
