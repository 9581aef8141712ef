#!/usr/bin/env bash
# Re-makes the figures of docs/results/track.md: how long `sketchloc track` takes for a scan on one core, with
# registrations at 20 Hz and without at 100 Hz. The program runs on one core at real-time priority where that is
# allowed. The real log needs the development data in $SKETCHLOC_DATA. Needs jq.
# Usage: docs/results/track.sh OUT_DIR     what is there already is not measured again
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}
core=${CORE:-0}
out=${1:?usage: track.sh OUT_DIR}
mkdir -p "$out"

alone=(taskset --cpu-list "$core")
if chrt --rr 10 true 2>/dev/null; then
  alone+=(chrt --rr 10)
else
  echo "track.sh: real-time priority is not allowed here; others on the machine disturb" >&2
fi

# An office and a person who draws it, a scan every 2.5 cm or 0.04 rad.
simulated=$out/office
if [ ! -d "$simulated" ]; then
  "$sketchloc" generate --kind office --seed "${SEED:-7}" --drive.scan_spacing_m 0.025 \
    --drive.scan_turn_rad 0.04 --drive.length_m 40 --out "$simulated"
fi

follow() { # NAME MAP LOG RATE OPTIONS...
  local name=$1 map=$2 log=$3 rate=$4
  shift 4
  [ -e "$out/$name.jsonl" ] && return
  cat /proc/loadavg >"$out/$name.load"
  "${alone[@]}" "$sketchloc" track "$map" --replay "$log" --rate "$rate" --out "$out/part.jsonl" --force -q "$@"
  mv "$out/part.jsonl" "$out/$name.jsonl"
}

row() { # WHAT NAME GOAL_MS
  jq -r --arg what "$1" --arg goal "$3" --arg load "$(cut -d ' ' -f 1 "$out/$2.load")" '
    def ms: . * 100 | round / 100;
    .summary | select(.) |
    "| \($what) | \(.latency_ms.count) | \(.latency_ms.p50 | ms) | \(.latency_ms.p99 | ms) | \(.latency_ms.max | ms) | \($goal) | \(
      .deadline.missed) | \(.deadline.with_fewer_particles) | \(.deadline.registrations) | \(.deadline.registrations_held_back) | \(
      .scans.late) | \(.work_ms.odometry.p50 | ms), \(.work_ms.filter.p50 | ms), \(
      if .work_ms.filter_with_registration then .work_ms.filter_with_registration.p50 | ms else "-" end) | \($load) |"' \
    "$out/$2.jsonl"
}

# The --rate that gives so many scans a second in the mean, from a run that did not wait.
rate() { # NAME HZ
  jq -s --argjson wanted "$2" '[.[] | select(.status) | .time_s] | $wanted * (max - min) / (length - 1)' "$out/$1.jsonl"
}

log=$simulated/log.jsonl
follow simulated_free "$simulated" "$log" 0 --start-from-reference --method ours
r20=$(rate simulated_free 20)
r100=$(rate simulated_free 100)
follow simulated_20 "$simulated" "$log" "$r20" --start-from-reference --method ours
follow simulated_20_state "$simulated" "$log" "$r20" --start-from-reference --method ours --state "$out/track.state"
follow simulated_100 "$simulated" "$log" "$r100" --start-from-reference --method mcl --deadline-ms 10
follow simulated_lag "$simulated" "$log" "$r20" --start-from-reference --method ours --lag
follow simulated_tight "$simulated" "$log" "$r20" --start-from-reference --method ours --deadline-ms 10
if [ -d "$data" ]; then
  drawing=$data/sketches/intel_sketch_3_rot180.png
  start=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i }
    NR == 2 { printf "%.1f,%.1f,%.1f,%.2f", $column["sketch_x_px"] + 0.5, h - 0.5 - $column["sketch_y_px"],
              -57.29578 * $column["heading_rigid_rad"], $column["local_scale_px_per_m"] }' \
    h="$(file "$drawing" | sed -E 's/.* x ([0-9]+),.*/\1/')" "$data/references/intel_sketch_3_rot180/reference.csv")
  follow intel_free "$drawing" "$data/logs/intel.log.gz" 0 --start "$start" --method ours
  follow intel_20 "$drawing" "$data/logs/intel.log.gz" "$(rate intel_free 20)" --start "$start" --method ours
  follow intel_100 "$drawing" "$data/logs/intel.log.gz" "$(rate intel_free 100)" --start "$start" --method mcl --deadline-ms 10
else
  echo "track.sh: no $data; the real log is left out" >&2
fi

echo "| what | scans | p50 ms | p99 ms | max ms | goal, p99 | missed | with fewer particles | registrations | held back | left out | work p50: odometry, filter, filter with registration | load |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
row "simulated office, 20 Hz, ours" simulated_20 "≤ 30 ms"
row "the same, keeping states" simulated_20_state "≤ 30 ms"
row "the same, smoothed with a lag" simulated_lag "≤ 30 ms"
row "simulated office, 100 Hz, no registration, deadline 10 ms" simulated_100 "≤ 10 ms"
row "simulated office, 20 Hz, ours, deadline 10 ms" simulated_tight ""
if [ -d "$data" ]; then
  row "Intel, 20 Hz, ours" intel_20 "≤ 30 ms"
  row "Intel, 100 Hz, no registration, deadline 10 ms" intel_100 "≤ 10 ms"
fi
