#!/usr/bin/env bash
# Re-makes the tables of docs/results/pose_graphs.md. Needs the development data in $SKETCHLOC_DATA.
# Usage: docs/results/pose_graphs.sh FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
bench=${BENCH:-$here/build/release/eval/bench/pose_graph_bench}
data=${SKETCHLOC_DATA:-$here/../shared/data}/pose_graphs
out=${1:?a folder for the results}
mkdir -p "$out"

figure() { # FOLDER KEY
  sed -n "s/^  \"$2\": \"\\{0,1\\}\\([^\",]*\\)\"\\{0,1\\},\\{0,1\\}\$/\\1/p" "$out/$1/metrics.json"
}

smooth() { # NAME GRAPH OPTIONS...
  local name=$1 graph=$2
  shift 2
  "$sketchloc" smooth --graph "$data/$graph" --out "$out/$name" --force "$@" >/dev/null
  printf '%-44s chi2 %-10s start %-14s %s iterations %s s rmse %s\n' "$name" "$(figure "$name" chi2)" \
    "$(figure "$name" start_chi2)" "$(figure "$name" iterations)" "$(figure "$name" seconds)" \
    "$(figure "$name" rmse_m)"
}

for graph in manhattan3500.g2o city10000.g2o.gz intel.g2o ring.g2o; do
  for start in given odometry; do
    smooth "${graph%%.*}-$start" "$graph" --start "$start"
    smooth "${graph%%.*}-$start-begun-there" "$graph" --start "$start" --optimise.initial given
  done
done

for graph in manhattan3500.g2o city10000.g2o.gz; do
  smooth "${graph%%.*}-incremental" "$graph" --start odometry --incremental
  for key in mean_update_ms worst_update_ms batches chi2_before_finish; do
    printf '  %s %s\n' "$key" "$(figure "${graph%%.*}-incremental" "$key")"
  done
done

awk '{print "VERTEX_SE2", NR - 1, $0}' "$data/manhattan3500_truth.txt" >"$out/truth.g2o"
for kernel in ${KERNELS:-huber cauchy dcs graduated}; do
  for share in 0 0.1 0.2 0.3 0.4 0.5; do
    for seed in ${SEEDS:-1 2 3 4 5}; do
      smooth "wrong-$kernel-$share-$seed" manhattan3500.g2o --start odometry --kernel "$kernel" \
        --wrong-loops "$share" --seed "$seed" --reference "$out/truth.g2o"
    done
  done
done

SKETCHLOC_DATA=$(dirname "$data") "$bench" --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
