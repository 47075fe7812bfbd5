#!/usr/bin/env bash
# Prints the tables of docs/accuracy.md: every pipeline calibrated by `maggic calibrate` alone, then
# scored. Needs ./run to have built the program.
#   bench/accuracy.sh [FOOTAGE_FOLDER]   footage with an annotation NAME.json beside each NAME.mp4 or
#                                        NAME.jpg; left out: the synthetic part alone
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
maggic=$root/build/release/bin/maggic
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root"

# figure NAME: its value in the last score, rounded.
figure() {
  local value
  value=$(grep -m 1 -o "\"$1\": *[-0-9.e]*" "$work/score.json" 2>/dev/null | sed 's/.*: *//') || true
  if [[ -z $value ]]; then printf -- '-'; else LC_ALL=C printf '%.2f' "$value"; fi
}

# row TITLE CALIBRATE_ARGUMENTS… -- SCORE_ARGUMENTS…
row() {
  local title=$1
  shift
  local -a calibrate=()
  while [[ $1 != -- ]]; do
    calibrate+=("$1")
    shift
  done
  shift
  local started=$EPOCHREALTIME
  if ! "$maggic" calibrate "${calibrate[@]}" -o "$work/found.yaml" >"$work/log" 2>&1; then
    printf '| %s | calibrate failed: %s |\n' "$title" "$(grep -m 1 'error' "$work/log" || tail -n 1 "$work/log")"
    return
  fi
  local seconds
  seconds=$(LC_ALL=C awk "BEGIN { printf \"%.1f\", $EPOCHREALTIME - $started }")
  rm -f "$work/score.json"
  # A score below what is required exits with 1; its figures are still there.
  "$maggic" score "$@" --calibration "$work/found.yaml" --json "$work/score.json" >"$work/log" 2>&1 || true
  printf '| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n' "$title" "$(figure seen)" "$(figure identity)" \
    "$(figure within_tolerance)" "$(figure false)" "$(figure ball_seen)" "$(figure false_balls)" \
    "$(figure position_p95_px)" "$(figure corners_px)" "$seconds"
}

heading() {
  printf '\n| %s | seen %% | identity %% | within tolerance %% | false a frame | ball seen %% | false balls a frame | place p95 px | corners px | calibrate s |\n' "$1"
  printf '|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n'
}

pipelines_for() {
  case $1 in
    all_tags* | tags_*) echo maggic_3v3_three_tag ;;
    vsssdk*) echo diagonal_tags ;;
    *) echo maggic_3v3 legacy_3v3 ;;
  esac
}

if (($# > 0)); then
  heading 'footage, pipeline'
  for truth in "$1"/*.json; do
    name=$(basename "$truth" .json)
    media=$(ls "$1/$name".* | grep -v '\.json$')
    for pipeline in $(pipelines_for "$name"); do
      row "$name, $pipeline" "$pipeline" --source "$media" -- "$pipeline" --source "$media" --truth "$truth"
    done
  done
fi

heading 'synthetic, 60 frames to calibrate, 1,000 others'
for pipeline in maggic_3v3 maggic_5v5 legacy_3v3; do
  for light in ideal normal challenging; do
    for seed in 1 2; do
      set_light=(--set "source.synthetic_match.light=$light" --set "source.synthetic_match.seed=$seed")
      row "$light, seed $seed, $pipeline" "$pipeline" "${set_light[@]}" --frames 60 -- \
        "$pipeline" "${set_light[@]}" --set source.synthetic_match.skip=60 --frames 1000
    done
  done
done

drift='source.synthetic_match.drift=[{time_s: 0}, {time_s: 10, brightness: 0.4, color_temperature_k: 4000}, {time_s: 20}]'
heading 'light falling to 40 % and 4000 K and back, 1,200 frames'
for pipeline in maggic_3v3 maggic_5v5 legacy_3v3; do
  for follow in true false; do
    set_light=(--set source.synthetic_match.light=normal)
    row "$pipeline, light.follow $follow" "$pipeline" "${set_light[@]}" --frames 60 -- \
      "$pipeline" "${set_light[@]}" --set "$drift" --set "light.follow=$follow" --frames 1200
  done
done
