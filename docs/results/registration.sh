#!/usr/bin/env bash
# Re-makes the figures of docs/results/registration.md. The real drawings need the development data in
# $SKETCHLOC_DATA; without them only the simulated ones are asked.
# Usage: docs/results/registration.sh OUT_DIR [OPTIONS OF ABLATE...]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
out=${1:?usage: registration.sh OUT_DIR [OPTIONS OF ABLATE...]}
shift
mkdir -p "$out"

sets=()
recorded() { # NAME DRAWING LOG
  sets+=(--set "$data/sketches/$2.png,$data/logs/$3.log.gz,$data/references/$2/reference.csv,$1")
}
# A simulated robot in the true layout, the drawing's reference from both annotators' places.
annotated() { # DRAWING.png
  local name number
  name=$(basename "$1" .png)
  number=$((10#$name + 1))
  [ -d "$out/kth/$name" ] || "$sketchloc" generate --quiet --map "$data/sketches/kth/model.png" \
    --cell-m 0.05 --drawing "$1" --correspondences "$data/sketches/kth/gt_a/gt_$name.csv" \
    --correspondences "$data/sketches/kth/gt_b/gt_$name.csv" --seed "$number" --out "$out/kth/$name" >/dev/null
  sets+=(--set "$1,$out/kth/$name/log.jsonl,$out/kth/$name/reference.csv,kth/$name")
}

if [ -d "$data" ]; then
  recorded intel intel_sketch_3_rot180 intel
  recorded belgioioso belgioioso_sketch belgioioso
  mkdir -p "$out/kth"
  for drawing in "$data"/sketches/kth/[0-9][0-9].png; do annotated "$drawing"; done
else
  echo "registration.sh: no $data; the real drawings are left out" >&2
fi
"$sketchloc" ablate --suite registration "${sets[@]}" --out "$out/registration" --force "$@"
