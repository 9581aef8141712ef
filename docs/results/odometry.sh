#!/usr/bin/env bash
# Re-makes the tables of docs/results/odometry.md. Needs the development data in $SKETCHLOC_DATA.
# Usage: docs/results/odometry.sh
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sketchloc=${SKETCHLOC:-$here/build/release/apps/sketchloc}
data=${SKETCHLOC_DATA:-$here/../shared/data}

evaluate() { # LOG OPTIONS...
  local log=$1
  shift
  printf '\n## %s\n' "$log"
  "$sketchloc" evaluate --log "$data/logs/$log.log.gz" "$@"
}

evaluate intel --relations "$data/relations/intel.relations" --max-gap 0.001
evaluate fr079 --relations "$data/relations/fr079.relations" --max-gap 0.12 # its clocks differ
for log in belgioioso fr101 csail; do
  evaluate "$log"
done
