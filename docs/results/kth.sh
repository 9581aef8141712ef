#!/usr/bin/env bash
# Re-makes the table of docs/results/kth.md: data sets from the drawings, runs on each, one row per
# drawing. Needs the development data in $SKETCHLOC_DATA. What is done is not repeated.
# Usage: docs/results/kth.sh OUT_DIR [SEEDS]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
kth=${SKETCHLOC_DATA:-$here/../shared/data}/sketches/kth
work=${1:?usage: kth.sh OUT_DIR [SEEDS]}
seeds=${2:-5}

generate() { # NAME DRAWING SEED CORRESPONDENCES...
  local name=$1 drawing=$2 seed=$3 pairs=()
  shift 3
  for csv in "$@"; do pairs+=(--correspondences "$csv"); done
  [ -d "$work/$name" ] || "$sketchloc" generate --quiet --map "$kth/model.png" --cell-m 0.05 \
    --drawing "$drawing" "${pairs[@]}" --seed "$seed" --out "$work/$name" >/dev/null
}

localize() { # SET DRAWING METHOD SEED
  local out=$work/runs/$3/$1/seed_$4
  [ -d "$out" ] || "$sketchloc" localize --quiet --map "$2" --log "$work/both/$1/log.jsonl" \
    --reference "$work/both/$1/reference.csv" --start-from-reference --method "$3" --seed "$4" \
    --out "$out" >/dev/null
}

# RMS distance of the references that each annotator's places give alone, local metres; "-" where
# one of them is not enough.
disagreement() { # SET
  [ -d "$work/a/$1" ] && [ -d "$work/b/$1" ] || { printf -- - && return; }
  paste -d, "$work/a/$1/reference.csv" "$work/b/$1/reference.csv" "$work/both/$1/reference.csv" |
    awk -F, 'NR > 1 && $37 && $38 { n++; s += (($3 - $16) ^ 2 + ($4 - $17) ^ 2) / $33 ^ 2 }
             END { printf "%.2f", n ? sqrt(s / n) : 0 }'
}

value() { awk -v key="$2:" '$1 == key { print $2 }' "$work/both/$1/reference.yaml"; }

# Means over the seeds: within 1 m, 2 m, 2 sigma (%), median m, median heading, runs lost at the end.
means() { # SET METHOD
  cat "$work/runs/$2/$1"/seed_*/metrics.json | tr -d ' ",{}' | awk -F: '
    $1 == "share_within_1_m" { n++; one += $2 }
    $1 == "share_within_2_m" { two += $2 }
    $1 == "share_within_reference_2_sigma" { sigma += $2 }
    $1 == "translation_error_m" || $1 == "heading_error_deg" { part = $1 }
    $1 == "median" && part != "" { sum[part] += $2; part = "" }
    $1 == "lost_at_end" { lost += $2 == "true" }
    END { printf "%f\t%f\t%f\t%f\t%f\t%d", 100 * one / n, 100 * two / n, 100 * sigma / n,
                 sum["translation_error_m"] / n, sum["heading_error_deg"] / n, lost }'
}

row() { # SET
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$1" "$(value "$1" map)" "$(value "$1" left_out_m)" \
    "$(disagreement "$1")" "$(value "$1" scored_share)" "$(value "$1" scored_in_free_space_share)" \
    "$(means "$1" mcl)" "$(means "$1" odometry | cut -f 2,4)"
}

mkdir -p "$work"
sets=()
for drawing in "$kth"/[0-9][0-9].png; do
  set=$(basename "$drawing" .png)
  sets+=("$set")
  a=$kth/gt_a/gt_$set.csv b=$kth/gt_b/gt_$set.csv
  generate "both/$set" "$drawing" "$((10#$set + 1))" "$a" "$b"
  generate "a/$set" "$drawing" "$((10#$set + 1))" "$a" || echo "kth: $set: not from a alone" >&2
  generate "b/$set" "$drawing" "$((10#$set + 1))" "$b" || echo "kth: $set: not from b alone" >&2
  for seed in $(seq "$seeds"); do localize "$set" "$drawing" mcl "$seed"; done
  localize "$set" "$drawing" odometry 1
  echo "kth: $set done" >&2
done

for set in "${sets[@]}"; do row "$set"; done | awk -F '\t' -v seeds="$seeds" '
  BEGIN {
    print "| drawing | fit | left out, m | a - b, m | scored | in free | within 1 m | within 2 m | within 2 sigma | median, m | heading, deg | lost at end | odometry within 2 m | odometry median, m |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  }
  { printf "| %s | %s | %.2f | %s | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %.2f | %.1f | %d of %d | %.0f %% | %.2f |\n",
           $1, $2, $3, $4, 100 * $5, 100 * $6, $7, $8, $9, $10, $11, $12, seeds, $13, $14
    for (i = 3; i <= 14; i++) { sum[i] += $i; square[i] += $i * $i }
    compared += $4 != "-" }
  # 95 % interval of the mean over drawings; 2.11: Student, 17 degrees of freedom.
  function mean(i) { return sum[i] / NR }
  function half(i) { return 2.11 * sqrt((square[i] - sum[i] ^ 2 / NR) / (NR - 1) / NR) }
  END {
    printf "| mean | | %.2f | %.2f | %.0f %% | %.0f %% | %.0f ± %.0f %% | %.0f ± %.0f %% | %.0f ± %.0f %% | %.2f ± %.2f | %.1f ± %.1f | %d of %d | %.0f ± %.0f %% | %.2f ± %.2f |\n",
           mean(3), sum[4] / compared, 100 * mean(5), 100 * mean(6), mean(7), half(7), mean(8), half(8),
           mean(9), half(9), mean(10), half(10), mean(11), half(11), sum[12], seeds * NR,
           mean(13), half(13), mean(14), half(14)
  }'
