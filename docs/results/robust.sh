#!/usr/bin/env bash
# Re-makes the figures of docs/results/robust.md: noise, missing walls, dropouts, global starts, kidnapped robots and
# wrong drawings in simulated buildings; global starts on the real drawings, from $SKETCHLOC_DATA.
# Usage: docs/results/robust.sh OUT_DIR [SEEDS_REAL [OPTIONS OF ABLATE...]]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
out=${1:?usage: robust.sh OUT_DIR [SEEDS_REAL [OPTIONS...]]}
mkdir -p "$out"

"$sketchloc" ablate --suite robust --methods mcl,ours --out "$out/robust" --force "${@:3}"

# One real run from a start, tracked or global.
run() { # drawing log alternative-or-empty row seed start-option
  # shellcheck disable=SC2086
  "$sketchloc" localize --map "$data/sketches/$1.png" --log "$data/logs/$2.log.gz" \
    --reference "$data/references/$1/reference.csv" $3 --method ours "$6" \
    --seed "$5" --out "$out/$2/$4/$5" --force >/dev/null
}

if [ -d "$data" ]; then
  belgioioso="--alternative $data/references/belgioioso_sketch/reference_alternative_B.csv"
  for seed in $(seq "${2:-20}"); do
    run intel_sketch_3_rot180 intel "" tracked "$seed" --start-from-reference
    run intel_sketch_3_rot180 intel "" global "$seed" --global
    run belgioioso_sketch belgioioso "$belgioioso" tracked "$seed" --start-from-reference
    run belgioioso_sketch belgioioso "$belgioioso" global "$seed" --global
  done
  for log in intel belgioioso; do
    "$sketchloc" evaluate --runs "$out/$log/tracked" "$out/$log/global"
  done
else
  echo "robust.sh: no $data; the real drawings are left out" >&2
fi
