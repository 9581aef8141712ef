#!/usr/bin/env bash
# Re-makes the tables of docs/results/topology.md: recorded warehouses, from the development data in $SKETCHLOC_DATA, and 40
# simulated ones.
# Usage: docs/results/topology.sh FOLDER [SEEDS]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}/warehouse
out=${1:?a folder for the results}
seeds=${2:-20}
mkdir -p "$out"

"$sketchloc" generate --kind warehouse --drive.length_m 160 --count 40 --seed 2001 --out "$out/warehouses" --force --quiet
logs=()
for run in "$out"/warehouses/seed_*; do
  logs+=(--set "$run/log.jsonl,$run/labels.csv,$run/truth.tum,warehouses")
done
"$sketchloc" ablate --suite topology "${logs[@]}" --out "$out/logs" --force

if [ ! -d "$data" ]; then
  echo "topology.sh: no $data; the recorded warehouses are left out" >&2
  exit
fi
sets=()
for run in W-1.1 W-2.1; do
  sets+=(--set "$data/$run/unopt.tum,$data/$run/labels.csv,$data/$run/gt.tum,$run")
done
"$sketchloc" ablate --suite topology "${sets[@]}" --seeds "$seeds" --out "$out/suite" --force
for run in W-1.1 W-2.1; do
  for mode in "" --incremental; do
    "$sketchloc" topology --trajectory "$data/$run/unopt.tum" --labels "$data/$run/labels.csv" \
      --reference "$data/$run/gt.tum" --out "$out/$run$mode" --force $mode
    cat "$out/$run$mode/metrics.json"
  done
done
