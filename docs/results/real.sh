#!/usr/bin/env bash
# Re-makes the tables of docs/results/real.md: whole runs on the real drawings, 20 seeds each.
# Needs the development data in $SKETCHLOC_DATA. Usage: docs/results/real.sh OUT_DIR [SEEDS]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/dev/apps/sketchloc}
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

# Mean and spread over the seeds of a row.
summarise() { # drawing row
  cat "$out/$1/$2"/*/metrics.json | tr -d ' ",{}' | awk -F: -v row="$2" '
    $1 == "share_within_1_m" { n++; one += $2 }
    $1 == "share_within_2_m" { two += $2; square += $2 * $2; low = n == 1 || $2 < low ? $2 : low }
    $1 == "translation_error_m" { part = "t" }
    $1 == "heading_error_deg" { part = "h" }
    $1 == "median" && part == "t" { t[n + 0] = $2; tm += $2; part = "" }
    $1 == "median" && part == "h" { hm += $2; part = "" }
    $1 == "lost_at_end" { lost += $2 == "true" }
    $1 == "first_loss_s" && $2 != "null" { losses++; first += $2 }
    END {
      error = n > 1 ? 1.96 * sqrt((square - two * two / n) / (n - 1) / n) : 0
      printf "| %s | %d | %.1f | %.1f ± %.1f | %.1f | %.2f | %.1f | %s | %d/%d |\n", row, n,
        100 * one / n, 100 * two / n, 100 * error, 100 * low, tm / n, hm / n,
        losses ? sprintf("%.0f (%d/%d)", first / losses, losses, n) : "never", lost, n
    }'
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
  echo '| method | runs | within 1 m % | within 2 m % (95 % interval) | worst run % | median m | median heading deg | first loss s (runs) | lost at end |'
  echo '|---|---|---|---|---|---|---|---|---|'
  local row
  for row in odometry_raw odometry_matched end_points similarity_only mcl_raw_odometry mcl mcl_global_start; do
    summarise "$1" "$row"
  done
}

# DRAWINGS=intel or DRAWINGS=belgioioso makes one of the two tables only.
case ${DRAWINGS:-both} in both | intel) table intel_sketch_3_rot180 intel "" ;; esac
case ${DRAWINGS:-both} in both | belgioioso) table belgioioso_sketch belgioioso \
  "--alternative $data/references/belgioioso_sketch/reference_alternative_B.csv" ;; esac
