#!/usr/bin/env bash
# Re-makes the tables and the plot of docs/results/speed.md: every benchmark five times over in
# random order on one core; medians of these (the plot: the least), ratios within one run. Needs jq
# and, for the memory of a real run, the development data in $SKETCHLOC_DATA.
# Usage: docs/results/speed.sh OUT_DIR     what is there already is not measured again
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
data=${SKETCHLOC_DATA:-$here/../shared/data}
out=${1:?usage: speed.sh OUT_DIR}

# The benchmarks that the page needs, by program.
declare -A needed=(
  [beam_kernel]='^(Score|ScoreStrained|ByTraversal)/2000/60/1000/|^Error'
  [range_table]='/1000$|^Error'
  [end_point_kernel]='/(2000|10000)/180/400/'
  [distance_field]='/400$'
  [ray_caster]='^CellByCell/400/|^CastScan/400/./360$'
  [localizer]='.'
)
programs=(beam_kernel range_table end_point_kernel distance_field ray_caster localizer)

measure() { # PROGRAM
  [ -e "$out/$1.json" ] && return
  cat /proc/loadavg >"$out/$1.load"
  taskset --cpu-list 1 "$here/dev" bench "$1" --benchmark_filter="${needed[$1]}" \
    --benchmark_repetitions="${REPETITIONS:-5}" --benchmark_enable_random_interleaving=true \
    --benchmark_min_time=0.1 --benchmark_out="$out/part.json" --benchmark_out_format=json >"$out/$1.txt"
  mv "$out/part.json" "$out/$1.json"
}

# PROGRAM/BENCHMARK, field, median: one line per figure; times in ns of the processor.
medians() {
  local program
  for program in "${programs[@]}"; do
    jq -r --arg program "$program" '.benchmarks[] | select(.aggregate_name == "median") |
      {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}[.time_unit] as $ns |
      ($program + "/" + (.run_name | sub("/iterations:1"; ""))) as $name |
      [$name, "ns", .cpu_time * $ns],
      (to_entries[] | select((.value | type) == "number") | [$name, .key, .value]) | @tsv' \
      "$out/$program.json"
  done
}

peak_memory() {
  [ -e "$out/intel/metrics.json" ] ||
    "$here/build/release/apps/sketchloc" localize --quiet --out "$out/intel" \
      --map "$data/sketches/intel_sketch_3_rot180.png" --log "$data/logs/intel.log.gz" \
      --reference "$data/references/intel_sketch_3_rot180/reference.csv" \
      --start-from-reference >/dev/null
  printf 'localize/intel\tpeak_memory_mb\t%s\n' "$(jq .peak_memory_mb "$out/intel/metrics.json")"
}

goals() {
  awk -F '\t' '
    { value[$1, $2] = $3 }
    function get(name, field) {
      if ((name, field) in value) return value[name, field]
      print "speed.sh: no figure " name " " field >"/dev/stderr"
      exit 1
    }
    function row(what, measured, goal, holds) {
      printf "| %s | %s | %s | %s |\n", what, measured, goal, goal == "" ? "" : holds ? "yes" : "**no**"
    }
    function rate(what, name, field, goal) {
      r = get(name, field) / 1e6
      row(what, sprintf("%.0f M/s", r), goal ? sprintf("≥ %d M/s", goal) : "", r >= goal)
    }
    function ratio(what, fast, slow, field, goal, wish) {
      r = get(fast, field) / get(slow, field)
      row(what, sprintf(r < 100 ? "%.1f" : "%.0f", r), sprintf("≥ %d%s", goal, wish), r >= goal)
    }
    function at_most(what, v, unit, goal) {
      row(what, sprintf("%.3g %s", v, unit), sprintf("≤ %g %s", goal, unit), v <= goal)
    }
    function ns_each(what, name) {
      row(what, sprintf("%.2f ns", 1e9 * get(name, "s_per_point")), "", 1)
    }
    function head(title) {
      printf "\n%s\n\n| what | measured | goal | reached |\n|---|---|---|---|\n", title
    }
    END {
      where[0] = "tracking"; where[1] = "spread"
      head("Beam kernel, 2000 particles x 60 beams, drawing of 1000 x 1000")
      for (s = 1; s >= 0; s--) {
        name = "beam_kernel/Score/2000/60/1000/" s
        base = "beam_kernel/ByTraversal/2000/60/1000/" s
        rate("rays, " where[s], name, "rays", 150)
        rate("the same with strained particles", "beam_kernel/ScoreStrained/2000/60/1000/" s, "rays", 0)
        rate("scalar traversal", base, "rays", 0)
        ratio("kernel / traversal", name, base, "rays", 10)
      }
      head("Range table, 1000 x 1000")
      at_most("memory", get("range_table/Build/1000", "MB"), "MB", 200)
      at_most("time to build", get("range_table/Build/1000", "ns") / 1e9, "s", 2)
      drawn[0] = "thin strokes"; drawn[1] = "rooms"
      for (s = 0; s <= 1; s++) {
        name = "range_table/ErrorAgainstTraversal/" s
        row("error of log range, " drawn[s], sprintf("median %.3f, p95 %.3f, RMS %.3f, largest %.2f; %.1f %% beyond 0.3",
            get(name, "median"), get(name, "p95"), get(name, "rms"), get(name, "max"), 100 * get(name, "beyond_0.3")), "", 1)
      }
      for (s = 1; s >= 0; s--) {
        name = "beam_kernel/ErrorAgainstTraversal/10000/60/1000/" s
        row("error of the score per beam, " where[s], sprintf("RMS %.3f, largest %.3f", get(name, "rms"), get(name, "max")), "", 1)
      }
      head("End-point kernel, 180 beams, map of 400 x 400")
      for (s = 0; s <= 1; s++) {
        name = "end_point_kernel/Score/2000/180/400/" s
        base = "end_point_kernel/ByLookUp/2000/180/400/" s
        rate("particle-beams, 2000 particles, " where[s], name, "points", 0)
        rate("scalar, table of log-likelihoods", base, "points", 0)
        rate("scalar, distance, exponential, logarithm", "end_point_kernel/ByDistance/2000/180/400/" s, "points", 0)
        ratio("kernel / table of log-likelihoods", name, base, "points", 5, ", better 10")
        ratio("the same with 10 000 particles", "end_point_kernel/Score/10000/180/400/" s, "end_point_kernel/ByLookUp/10000/180/400/" s, "points", 5, ", better 10")
        ratio("kernel / distance, exponential, logarithm", name, "end_point_kernel/ByDistance/2000/180/400/" s, "points", 5, ", better 10")
        ns_each("each particle-beam", name)
        ns_each("limit: look-ups alone by the gather instruction", "end_point_kernel/LimitOfGather/2000/180/400/" s)
        ns_each("limit: look-ups alone by single loads", "end_point_kernel/LimitOfLoads/2000/180/400/" s)
      }
      head("Distance field and LIDAR")
      at_most("distance field 400 x 400, rooms", get("distance_field/Rooms/400", "ns") / 1e6, "ms", 3)
      at_most("distance field 400 x 400, thin strokes", get("distance_field/ThinStrokes/400", "ns") / 1e6, "ms", 3)
      rate("LIDAR, 400 x 400, 360 beams, a drive", "ray_caster/CastScan/400/1/360", "rays", 20)
      rate("LIDAR, 400 x 400, 360 beams, from anywhere", "ray_caster/CastScan/400/0/360", "rays", 20)
      rate("cell by cell, from anywhere", "ray_caster/CellByCell/400/0", "rays", 0)
      head("Whole updates, map of 1000 x 1000")
      at_most("end points, 2000 x 180", get("localizer/EndPointsOnMetricMap/2000/180/1000", "ns") / 1e6, "ms", 1)
      at_most("end points, 10 000 x 180", get("localizer/EndPointsOnMetricMap/10000/180/1000", "ns") / 1e6, "ms", 5)
      at_most("beams in a drawing, 2000 x 60", get("localizer/BeamsInDrawing/2000/60/1000", "ns") / 1e6, "ms", 3)
      at_most("peak memory of localize, Intel", get("localize/intel", "peak_memory_mb"), "MB", 300)
    }' "$out/medians.tsv"
}

# One line per point of the plot: panel, model, x, milliseconds; the least of the repetitions, since
# whatever else the machine does can only add.
cost_points() {
  jq -r '.benchmarks[] | select(.run_type == "iteration") | "\(.run_name)/\(.cpu_time / 1000)"' \
    "$out/localizer.json" | awk -F / '
    !($1 FS $2 FS $3 FS $4 in least) || $5 < least[$1 FS $2 FS $3 FS $4] {
      least[$1 FS $2 FS $3 FS $4] = $5
    }
    END {
      for (key in least) {
        split(key, part, FS)
        model = part[1] == "BeamsInDrawing" ? "beams" : "end points"
        usual = part[1] == "BeamsInDrawing" ? 60 : 180
        rest = "\t" model "\t%d\t%.4f\n"
        if (part[3] == usual && part[4] == 1000) printf "1\tparticles" rest, part[2], least[key]
        if (part[2] == 2000 && part[4] == 1000) printf "2\tbeams" rest, part[3], least[key]
        if (part[2] == 2000 && part[3] == usual)
          printf "3\tside of the drawing, px" rest, part[4], least[key]
      }
    }' | sort -t "$(printf '\t')" -k1,1 -k3,3 -k4,4g | cut -f 2-
}

# Straight lines by least squares of the relative errors, and how far the points are off them at most.
cost_table() {
  cost_points | awk -F '\t' '
    { key = $1 " | " $2
      if (!(key in n)) order[++keys] = key
      n[key]++; x[key, n[key]] = $3; y[key, n[key]] = $4 }
    END {
      print "| against | model | ms at each | fixed ms | ms per 1000 | farthest from the line |"
      print "|---|---|---|---|---|---|"
      for (k = 1; k <= keys; k++) {
        key = order[k]; s = sx = sy = sxx = sxy = 0; list = ""
        for (i = 1; i <= n[key]; i++) {
          w = 1 / y[key, i] ^ 2
          s += w; sx += w * x[key, i]; sy += w * y[key, i]
          sxx += w * x[key, i] ^ 2; sxy += w * x[key, i] * y[key, i]
          list = list sprintf("%s%d: %.2f", i > 1 ? ", " : "", x[key, i], y[key, i])
        }
        slope = (s * sxy - sx * sy) / (s * sxx - sx * sx)
        fixed = (sy - slope * sx) / s
        worst = 0
        for (i = 1; i <= n[key]; i++) {
          off = (fixed + slope * x[key, i]) / y[key, i] - 1
          if (off < 0) off = -off
          if (off > worst) worst = off
        }
        printf "| %s | %s | %.2f | %.3f | %.0f %% |\n", key, list, fixed, 1000 * slope, 100 * worst
      }
    }'
}

# Three panels side by side, linear axes from zero.
plot() {
  cost_points | awk -F '\t' '
    function px(p, v) { return 60 + 300 * p + 220 * v / x_high[p] }
    function py(p, v) { return 220 - 170 * v / y_high[p] }
    function round_up(v,   unit, i) {
      unit = 10 ^ int(log(v) / log(10) + (v < 1 ? -1 : 0))
      for (i = 1; i < count; i++) if (v <= step[i] * unit) return step[i] * unit
      return 10 * unit
    }
    BEGIN { panels = 0; count = split("1 1.2 1.6 2 2.4 3.2 4 5 6 8 10", step, " ") }
    { if (!($1 in panel)) { title[panels] = $1; panel[$1] = panels++ }
      p = panel[$1]; n++; at[n] = p; model[n] = $2; x[n] = $3; y[n] = $4
      if ($3 > largest_x[p]) largest_x[p] = $3
      if ($4 > largest_y[p]) largest_y[p] = $4 }
    END {
      colour["beams"] = "#1b6ca8"; colour["end points"] = "#c1440e"
      print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 900 280\" font-family=\"sans-serif\" font-size=\"12\">"
      print "<rect width=\"900\" height=\"280\" fill=\"white\"/>"
      for (p = 0; p < panels; p++) {
        x_high[p] = round_up(largest_x[p]); y_high[p] = round_up(largest_y[p])
        for (i = 0; i <= 4; i++) {
          v = y_high[p] * i / 4
          printf "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#dddddd\"/>\n", px(p, 0), py(p, v), px(p, x_high[p])
          printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\" fill=\"#444444\">%g</text>\n", px(p, 0) - 6, py(p, v) + 4, v
          if (i % 2 == 0) printf "<text x=\"%.1f\" y=\"237\" text-anchor=\"middle\" fill=\"#444444\">%g</text>\n", px(p, x_high[p] * i / 4), x_high[p] * i / 4
        }
        printf "<text x=\"%.1f\" y=\"258\" text-anchor=\"middle\">%s</text>\n", px(p, x_high[p] / 2), title[p]
        printf "<text x=\"%.1f\" y=\"36\">ms per update</text>\n", px(p, 0) - 40
        for (m in colour) {
          line = ""
          for (i = 1; i <= n; i++) if (at[i] == p && model[i] == m) {
            line = line sprintf("%s%.1f %.1f", line == "" ? "M" : "L", px(p, x[i]), py(p, y[i]))
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", px(p, x[i]), py(p, y[i]), colour[m]
          }
          printf "<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", line, colour[m]
        }
      }
      printf "<text x=\"60\" y=\"16\" fill=\"%s\">end points, 180 beams</text>\n", colour["end points"]
      printf "<text x=\"220\" y=\"16\" fill=\"%s\">beams in a drawing, 60 beams</text>\n", colour["beams"]
      print "<text x=\"420\" y=\"16\" fill=\"#444444\">2000 particles, 1000 x 1000 px where nothing else is said</text>"
      print "</svg>"
    }' >"$1"
}

mkdir -p "$out"
for program in "${programs[@]}"; do measure "$program"; done
{ medians; peak_memory; } >"$out/medians.tsv"
goals
printf '\nCost of a whole update, least of the repetitions\n\n'
cost_table
plot "$here/docs/results/speed.svg"
