#!/usr/bin/env bash
# Re-makes the tables of docs/results/simulator.md: simulated drawings, then real ones. The real
# ones need the development data in $SKETCHLOC_DATA. Usage: docs/results/simulator.sh [COUNT]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
count=${1:-200}

for person in human tps; do
  for kind in home office warehouse; do
    printf '\n## %s, drawn by %s\n' "$kind" "$person"
    "$sketchloc" generate --quiet --statistics --count "$count" --kind "$kind" --person "$person"
  done
done

[ -d "$data" ] || exit 0
real() { # DRAWING LOG
  printf '\n## %s\n' "$1"
  "$sketchloc" evaluate --log "$data/logs/$2.log.gz" --map "$data/sketches/$1.png" \
    --reference "$data/references/$1/reference.csv"
}
real intel_sketch_3_rot180 intel
real belgioioso_sketch belgioioso

for drawing in "$data"/sketches/kth/[0-9][0-9].png; do
  set=$(basename "$drawing" .png)
  printf '\n## kth %s, a simulated robot in the true layout\n' "$set"
  "$sketchloc" generate --quiet --statistics --map "$data/sketches/kth/model.png" --cell-m 0.05 \
    --drawing "$drawing" --correspondences "$data/sketches/kth/gt_a/gt_$set.csv" \
    --correspondences "$data/sketches/kth/gt_b/gt_$set.csv" --count 5
done
