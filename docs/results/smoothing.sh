#!/usr/bin/env bash
# Re-makes the figures of docs/results/smoothing.md: the filter, and the same runs smoothed with a lag and
# afterwards. The real drawings need the development data in $SKETCHLOC_DATA.
# Usage: docs/results/smoothing.sh OUT_DIR [SEEDS [OPTIONS OF ABLATE FOR THE SIMULATED...]]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
out=${1:?usage: smoothing.sh OUT_DIR [SEEDS [OPTIONS...]]}
seeds=${2:-2}
mkdir -p "$out"
methods=ours,ours+lag,ours+smooth

if [ -d "$data" ]; then
  intel=$data/sketches/intel_sketch_3_rot180.png,$data/logs/intel.log.gz
  intel+=,$data/references/intel_sketch_3_rot180/reference.csv,Intel
  belgioioso=$data/sketches/belgioioso_sketch.png,$data/logs/belgioioso.log.gz
  belgioioso+=,$data/references/belgioioso_sketch/reference.csv,Belgioioso
  belgioioso+=,$data/references/belgioioso_sketch/reference_alternative_B.csv
  "$sketchloc" ablate --suite real --set "$intel" --set "$belgioioso" --seeds "$seeds" \
    --methods "$methods" --out "$out/real" --force
else
  echo "smoothing.sh: no $data; the real drawings are left out" >&2
fi
"$sketchloc" ablate --suite filter --seeds "$seeds" --drives.drawings 1 --methods "$methods" \
  --out "$out/filter" --force "${@:3}"
