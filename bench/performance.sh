#!/usr/bin/env bash
# Prints the tables of docs/performance.md: what `maggic bench` measures over picture sizes, noise,
# robots, shipped pipelines and clips, and the worst pictures there are. Run it on a machine with
# nothing else to do.
#   bench/performance.sh [CLIP[@PIPELINE]]…
# A clip is run by maggic_3v3 unless a pipeline is named, with the shipped calibration of its name where
# there is one. FRAMES=N measures so many frames each, 300 unless given. Needs the program
# (./run plugins builds it) and, for the worst pictures, the benchmarks:
#   cmake --preset bench && cmake --build --preset bench
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
maggic=$root/build/release/bin/maggic
benchmark=$root/build/bench/bin/pipeline_bench
frames=${FRAMES:-300}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C

# The clips are named from where the script is called, pipelines from the project's folder.
clips=()
for clip in "$@"; do
  pipeline=maggic_3v3
  if [[ $clip == *@* ]]; then
    pipeline=${clip##*@}
    clip=${clip%@*}
  fi
  clips+=("$(realpath -- "$clip")" "$pipeline")
done
cd "$root"

# value KEY: the number behind "KEY" in the last report; value KEY FIGURE: the one within its object.
value() {
  local inner=${2:-$1}
  sed -n "/\"$1\":/,/}/s/.*\"$inner\": *\([-0-9.e]*\).*/\1/p" "$work/report.json" | head -n 1
}

# cell FORMAT VALUE [FACTOR]: '-' where nothing was measured.
cell() {
  if [[ -z $2 ]]; then printf -- '-'; else awk -v f="$1" -v v="$2" -v k="${3:-1}" 'BEGIN { printf f, v * k }'; fi
}

us() { cell '%.1f' "$(value "$1" p50)" 1000; }
ms() { cell '%.2f' "$(value "$1" "${2:-p50}")"; }

# measure TITLE ARGUMENT…: a report, or a row that says why there is none.
measure() {
  local title=$1
  shift
  rm -f "$work/report.json"
  if "$maggic" bench "$@" --frames "$frames" --json "$work/report.json" >"$work/log" 2>&1; then return; fi
  printf '| %s | failed: %s |\n' "$title" "$(grep -m 1 -v '^note: ' "$work/log")"
  return 1
}

frame_path_heading() {
  printf '\n| %s | floor µs | plain table µs | segment µs | blobs µs | track µs | pixels → blobs µs | × floor | pixels → detections µs | p99 µs | ns a pixel | fps, 1 thread | runs | blobs | robots |\n' "$1"
  printf '|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n'
}

frame_path_row() {
  measure "$@" || return 0
  printf '| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n' "$1" \
    "$(us floor_cold_ms)" "$(us plain_table_ms)" "$(us segment_ms)" "$(us blobs_ms)" "$(us track_ms)" \
    "$(us pixels_to_blobs_ms)" "$(cell '%.2f' "$(value ratios_to_floor pixels_to_blobs)")" \
    "$(us pixels_to_detections_ms)" "$(cell '%.1f' "$(value pixels_to_detections_ms p99)" 1000)" \
    "$(cell '%.3f' "$(value ns_per_pixel pixels_to_detections)")" \
    "$(cell '%.0f' "$(value one_thread_fps)")" "$(cell '%.0f' "$(value a_frame runs)")" \
    "$(cell '%.1f' "$(value a_frame blobs)")" "$(cell '%.1f' "$(value a_frame robots)")"
}

# corners WIDTH HEIGHT LENGTH_MM WIDTH_MM: where the synthetic match puts the field's corners.
corners() {
  awk -v w="$1" -v h="$2" -v l="$3" -v b="$4" 'BEGIN {
    margin = 19; s = (w - 2 * margin) / l; t = (h - 2 * margin) / b; if (t < s) s = t
    x = (w - 1) / 2; y = (h - 1) / 2; dx = s * l / 2; dy = s * b / 2
    printf "[[%f, %f], [%f, %f], [%f, %f], [%f, %f]]", x - dx, y - dy, x + dx, y - dy, x + dx, y + dy, x - dx, y + dy
  }'
}

source=source.synthetic_match

measure 'the machine' maggic_3v3 || exit 1
printf '%s, %s cores, vector instructions %s; %s frames each.\n' \
  "$(sed -n 's/.*"cpu": *"\(.*\)".*/\1/p' "$work/report.json")" "$(value cores)" \
  "$(sed -n 's/.*"simd_target": *"\(.*\)".*/\1/p' "$work/report.json")" "$frames"

frame_path_heading 'picture size (synthetic 3v3)'
for size in '320 240' '640 480' '800 600' '1280 720' '1920 1080'; do
  read -r width height <<<"$size"
  frame_path_row "$width × $height" maggic_3v3 \
    --set "$source.width=$width" --set "$source.height=$height" \
    --set "field.image_size_px=[$width, $height]" \
    --set "field.corners_px=$(corners "$width" "$height" 1500 1300)"
done

frame_path_heading 'sensor noise, standard deviation in 8-bit steps'
for noise in 0 2 4 8 16; do
  frame_path_row "$noise" maggic_3v3 --set "$source.noise=$noise" --set "$source.shot_noise=0"
done

frame_path_heading 'robots a team (maggic_5v5)'
for robots in 1 3 5 8 10; do
  frame_path_row "$robots" maggic_5v5 --set "$source.robots_per_team=$robots"
done

if ((${#clips[@]} > 0)); then
  frame_path_heading 'clip, pipeline'
  for ((i = 0; i < ${#clips[@]}; i += 2)); do
    clip=${clips[i]}
    pipeline=${clips[i + 1]}
    name=$(basename "${clip%.*}")
    calibration=()
    if [[ -f pipelines/calibrations/$name.yaml ]]; then calibration=(--calibration "$name"); fi
    frame_path_row "$name, $pipeline" "$pipeline" --source "$clip" "${calibration[@]}"
  done
fi

threads=$(value threads)
printf '\n| pipeline | compile ms, 1 thread | compile ms, %s threads | update ms | what is updated | copy of 16 MiB ms | fps, 1 thread | fps, %s threads | fps, %s pipelines | latency p50 ms | latency p99 ms |\n' \
  "$threads" "$threads" "$threads"
printf '|---|--:|--:|--:|---|--:|--:|--:|--:|--:|--:|\n'
for file in pipelines/*.yaml; do
  pipeline=$(basename "$file" .yaml)
  measure "$pipeline" "$pipeline" --source synthetic || continue
  printf '| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n' "$pipeline" "$(ms table_compile_ms)" \
    "$(ms table_compile_threads_ms)" "$(ms table_update_ms)" \
    "$(sed -n 's/.*"table_update": *"\(.*\)".*/\1/p' "$work/report.json")" "$(ms memcpy_16mib_ms)" \
    "$(cell '%.0f' "$(value one_thread_fps)")" "$(cell '%.0f' "$(value threads_fps)")" "$(cell '%.0f' "$(value pipelines_fps)")" \
    "$(ms capture_to_detection_ms)" "$(ms capture_to_detection_ms p99)"
done

if [[ ! -x $benchmark ]]; then
  printf '\n(The worst pictures are left out: %s is not built.)\n' "${benchmark#"$root"/}"
  exit 0
fi
printf '\n| picture, caches as they come | size | pixels → detections µs | ns a pixel | runs | blobs |\n'
printf '|---|---|--:|--:|--:|--:|\n'
"$benchmark" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true --benchmark_format=csv 2>/dev/null |
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) { gsub(/"/, "", $i); at[$i] = i }; next }
    $1 ~ /_median/ {
      gsub(/"/, ""); split($1, part, /[:\/_]/)
      printf "| %s | %s × %s | %.1f | %.3f | %d | %d |\n", $at["label"], part[5], part[7], $at["real_time"], $at["s/pixel"] * 1e9, $at["runs"], $at["blobs"]
    }'
