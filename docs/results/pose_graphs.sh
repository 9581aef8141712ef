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

# Wrong loop closures: the RMSE of positions behind each kernel, in the mean over seeds, and its ratio to that without wrong ones.
wrong() { # NAME GRAPH REFERENCE KERNEL SEEDS OPTIONS...
  local name=$1 graph=$2 reference=$3 kernel=$4 seeds=$5 share seed clean= mean row
  shift 5
  row=$(printf '%-24s %-10s %-30s' "$name" "$kernel" "$*")
  for share in 0 0.1 0.3 0.5; do
    mean=$(for seed in $seeds; do
      "$sketchloc" smooth --graph "$graph" --out "$out/wrong" --force --start odometry --kernel "$kernel" \
        --wrong-loops "$share" --seed "$seed" --reference "$reference" "$@" >/dev/null 2>&1
      echo "$(figure wrong rmse_m)" "$(figure wrong seconds)"
    done | awk '{sum += $1; if ($2 > most) most = $2} END {printf "%.3f m (%.1f s)", sum / NR, most}')
    clean=${clean:-$mean}
    row+=" | $share: $mean, ratio $(awk -v a="${mean%% *}" -v b="${clean%% *}" 'BEGIN {printf "%.2f", a / b}')"
  done
  echo "$row"
}

awk '{print "VERTEX_SE2", NR - 1, $0}' "$data/manhattan3500_truth.txt" >"$out/truth.g2o"
manhattan() {
  wrong manhattan3500 "$data/manhattan3500.g2o" "$out/truth.g2o" "$@"
}
manhattan none 1
manhattan cauchy 1
manhattan dcs "${SEEDS:-1 2 3}"
manhattan graduated "${SEEDS:-1 2 3}"
for run in W-1.1 W-2.1; do
  warehouse=$(dirname "$data")/warehouse/$run
  awk '!/^#/ {print "VERTEX_SE2", $1, $2, $3, 2 * atan2($7, $8)}' "$warehouse/gt.tum" >"$out/$run.g2o"
  for graph in 1_manhattan 3_dense; do
    for kernel in none cauchy dcs graduated; do
      wrong "$run $graph" "$warehouse/graph_$graph.g2o" "$out/$run.g2o" "$kernel" "${SEEDS:-1 2 3}"
    done
  done
done

SKETCHLOC_DATA=$(dirname "$data") "$bench" --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
