#!/usr/bin/env bash
# Re-makes the tables of docs/results/real.md: whole runs on the real drawings, 20 seeds each.
# Needs the development data in $SKETCHLOC_DATA. Usage: docs/results/real.sh OUT_DIR [SEEDS]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
out=${1:?usage: real.sh OUT_DIR [SEEDS]}
seeds=${2:-20}

# One run; results that are there already are kept, so that an interrupted table goes on.
run() { # drawing log alternative-or-empty row seed options...
  local drawing=$1 log=$2 alternative=$3 row=$4 seed=$5
  shift 5
  local dir=$out/$drawing/$row/$seed
  [ -e "$dir/metrics.json" ] && return
  mkdir -p "$(dirname "$dir")"
  # shellcheck disable=SC2086
  "$sketchloc" localize --map "$data/sketches/$drawing.png" --log "$data/logs/$log.log.gz" \
    --reference "$data/references/$drawing/reference.csv" $alternative \
    --seed "$seed" --out "$dir" "$@" >/dev/null 2>"$out/last_messages.txt"
}

table() { # drawing log alternative-or-empty
  local seed
  run "$1" "$2" "$3" odometry_raw 1 --start-from-reference --method odometry --odometry raw
  run "$1" "$2" "$3" odometry_matched 1 --start-from-reference --method odometry
  for seed in $(seq "$seeds"); do
    run "$1" "$2" "$3" mcl "$seed" --start-from-reference
  done
  for seed in $(seq "$seeds"); do
    run "$1" "$2" "$3" similarity_only "$seed" --start-from-reference \
      --localizer.predict.deformation.strain 0 --localizer.start.strain 0
    run "$1" "$2" "$3" end_points "$seed" --start-from-reference --localizer.measurement end_points
    run "$1" "$2" "$3" mcl_raw_odometry "$seed" --start-from-reference --odometry raw
    run "$1" "$2" "$3" mcl_global_start "$seed" --global
  done
  printf '\n%s\n\n' "$1"
  local rows=(odometry_raw odometry_matched end_points similarity_only mcl_raw_odometry mcl
    mcl_global_start)
  "$sketchloc" evaluate --runs "${rows[@]/#/$out/$1/}" --against "$out/$1/mcl"
}

# DRAWINGS=intel or DRAWINGS=belgioioso makes one of the two tables only.
case ${DRAWINGS:-both} in both | intel) table intel_sketch_3_rot180 intel "" ;; esac
case ${DRAWINGS:-both} in both | belgioioso) table belgioioso_sketch belgioioso \
  "--alternative $data/references/belgioioso_sketch/reference_alternative_B.csv" ;; esac
