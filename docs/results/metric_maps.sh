#!/usr/bin/env bash
# Re-makes the tables of docs/results/metric_maps.md: true maps of simulated buildings, a robot in
# each, localized with several seeds. What is done is not repeated. Needs jq. JOBS=N runs at once,
# BUILDINGS="SEEDS" others than those of the page.
# Usage: docs/results/metric_maps.sh OUT_DIR [SEEDS]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
out=${1:?usage: metric_maps.sh OUT_DIR [SEEDS]}
seeds=${2:-10}
kinds=(office home warehouse)
read -ra buildings <<<"${BUILDINGS:-900 901 902 903 904 905}"

localize() { # KIND BUILDING ROW SEED OPTIONS...
  local set=$out/$1_$2 dir=$out/runs/$3/$1_$2/$4
  shift 3
  [ -e "$dir/metrics.json" ] && return
  while [ "$(jobs -rp | wc -l)" -ge "${JOBS:-1}" ]; do wait -n; done
  "$sketchloc" localize --quiet --map "$set/drawing.yaml" --log "$set/log.jsonl" \
    --reference "$set/reference.csv" --start-from-reference --out "$dir" --seed "$@" >/dev/null &
}

two_thousand=(--localizer.particles.min_particles 2000 --localizer.particles.max_particles 2000)
# What the simulated wheels do, their biases included (datasets/sim/odometry_model.hpp).
noise=--localizer.predict.odometry
wheel_noise=("$noise.slip_m_per_m" 0.06 "$noise.slip_m_per_rad" 0.02
             "$noise.turn_rad_per_m" 0.06 "$noise.turn_rad_per_rad" 0.15)

runs_of() { # SEED
  local kind building
  for kind in "${kinds[@]}"; do
    for building in "${buildings[@]}"; do
      [ -d "$out/${kind}_$building" ] || "$sketchloc" generate --quiet --kind "$kind" \
        --person none --seed "$building" --out "$out/${kind}_$building" >/dev/null
      localize "$kind" "$building" mcl "$1"
      localize "$kind" "$building" mcl_2000 "$1" "${two_thousand[@]}"
      localize "$kind" "$building" wheels "$1" --odometry raw "${wheel_noise[@]}"
      [ "$1" -le 3 ] || continue
      localize "$kind" "$building" wheels_default_noise "$1" --odometry raw
      [ "$1" = 1 ] || continue
      localize "$kind" "$building" odometry_matched 1 --method odometry
      localize "$kind" "$building" odometry_raw 1 --method odometry --odometry raw
    done
  done
  wait
}

# Kind, building, errors in cm and deg, whether lost: one line per run.
figures() { # ROW
  local dir
  for dir in "$out/runs/$1"/*/*/; do
    jq -r --arg set "$(basename "$(dirname "$dir")")" '[($set | sub("_[0-9]+$"; "")), $set,
      100 * .translation_error_m.rmse, 100 * .translation_error_m.median,
      100 * .translation_error_m.p90,
      .heading_error_deg.rmse, .heading_error_deg.median, .heading_error_deg.p90,
      if .lost_at_end then 1 else 0 end] | @tsv' "$dir/metrics.json"
  done
}

# Means over buildings of the means over seeds; the 95 % interval is over the six buildings (2.57:
# Student, 5 degrees of freedom); `worst` is the largest RMSE of a single run.
summarise() { # ROW
  figures "$1" | awk -F '\t' -v row="$1" -v kinds="${kinds[*]}" '
    { n[$2]++; kind[$2] = $1; runs[$1]++; lost[$1] += $9
      for (i = 3; i <= 8; i++) sum[$2, i] += $i
      if ($3 > worst[$1]) worst[$1] = $3 }
    END {
      count = split(kinds, names, " ")
      for (k = 1; k <= count; k++) {
        name = names[k]
        sets = square = 0
        split("", mean)
        for (set in n) if (kind[set] == name) {
          sets++
          for (i = 3; i <= 8; i++) mean[i] += sum[set, i] / n[set]
          square += (sum[set, 3] / n[set]) ^ 2
        }
        if (!sets) continue
        half = sets > 1 ? 2.57 * sqrt((square - mean[3] ^ 2 / sets) / (sets - 1) / sets) : 0
        printf "| %s | %s | %d | %.2f ± %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %d |\n",
          name, row, runs[name], mean[3] / sets, half, worst[name], mean[4] / sets, mean[5] / sets,
          mean[6] / sets, mean[7] / sets, mean[8] / sets, lost[name]
      }
    }'
}

# Processor time of the whole command per scan, reading, matching and report included: median of
# five runs. Not the wall clock, which tells how busy the machine is.
time_of() { # ROW OPTIONS...
  local row=$1 kind set seed ms TIMEFORMAT=%U
  shift
  for kind in "${kinds[@]}"; do
    set=$out/${kind}_${buildings[0]}
    ms=$(for seed in 1 2 3 4 5; do
      { time "$sketchloc" localize --quiet --map "$set/drawing.yaml" --log "$set/log.jsonl" \
        --reference "$set/reference.csv" --start-from-reference --seed "$seed" --force \
        --out "$out/time" "$@" >/dev/null; } 2>&1
    done | sort -g | sed -n 3p)
    awk -v kind="$kind" -v row="$row" -v s="$ms" \
      'END { printf "| %s | %s | %.1f |\n", kind, row, 1000 * s / NR }' "$set/log.jsonl"
  done
}

for seed in $(seq "$seeds"); do runs_of "$seed"; done

echo '| building | row | runs | RMSE cm (95 % interval) | worst run cm | median cm | p90 cm | heading RMSE deg | median deg | p90 deg | lost |'
echo '|---|---|---|---|---|---|---|---|---|---|---|'
for row in mcl mcl_2000 wheels wheels_default_noise odometry_matched odometry_raw; do
  summarise "$row"
done
[ "${TIMES:-yes}" = yes ] || exit 0
printf '\n| building | row | processor ms per scan |\n|---|---|---|\n'
time_of mcl
time_of mcl_2000 "${two_thousand[@]}"
time_of wheels --odometry raw "${wheel_noise[@]}"
