# shellcheck shell=bash
# Sourced by ./run and ./test: makes a bare Debian 12 ready, configures and builds.

# The project's folder.
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*" >&2; }

# Prints the packages of cmake/debian-packages.txt that are not installed.
missing_packages() {
  local -a wanted
  mapfile -t wanted < <(sed 's/#.*//; /^[[:space:]]*$/d' "$root/cmake/debian-packages.txt")
  local installed
  # dpkg-query fails when it does not know one of them; what it knows it prints all the same.
  installed=$(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' "${wanted[@]}" \
    2>/dev/null || true)
  local package
  for package in "${wanted[@]}"; do
    grep -qx "$package installed" <<<"$installed" || printf '%s\n' "$package"
  done
}

install_missing_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This is not Debian: please see to the equivalents of the packages in" \
      "cmake/debian-packages.txt yourself. Going on with what is here."
    return
  fi
  local -a missing
  mapfile -t missing < <(missing_packages)
  ((${#missing[@]} > 0)) || return 0

  local -a as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "Missing Debian packages: ${missing[*]}"
      say "There is no sudo here; as root, please run: apt-get install ${missing[*]}"
      exit 1
    fi
    as_root=(sudo)
  fi
  as_root+=(env DEBIAN_FRONTEND=noninteractive)

  say "Installing missing Debian packages: ${missing[*]}"
  local -a install=("${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}")
  local log
  log=$(mktemp)
  # The lists may be absent or too old to be of use; only then are they fetched.
  if ! "${install[@]}" >"$log" 2>&1; then
    say "Fetching the package lists first"
    if ! { "${as_root[@]}" apt-get update -qq && "${install[@]}"; } >"$log" 2>&1; then
      cat "$log" >&2
      rm -f "$log"
      say "The packages could not be installed, see above."
      exit 1
    fi
  fi
  rm -f "$log"
}

# build PRESET [TARGET…]: configures where that was not done since the presets changed, and builds.
# Quiet unless it fails.
build() {
  local preset=$1
  shift
  local folder=$root/build/$preset
  # Ninja itself sees changes of CMake's files, but knows nothing of presets.
  if [[ ! -f $folder/build.ninja || $root/CMakePresets.json -nt $folder/build.ninja ]]; then
    say "Configuring $preset"
    mkdir -p "$folder"
    if ! (cd "$root" && cmake --preset "$preset") >"$folder/configure.log" 2>&1; then
      cat "$folder/configure.log" >&2
      exit 1
    fi
  fi
  local -a ninja=(ninja -C "$folder" -j "$(nproc)")
  # On a terminal ninja shows one line that changes; elsewhere it would be hundreds.
  if [[ ! -t 1 ]]; then
    ninja+=(--quiet)
    [[ -e $folder/.ninja_log ]] || say "Building $preset, this takes some minutes the first time"
  fi
  if ! "${ninja[@]}" "$@" 1>&2; then
    say "The build of $preset failed, see above."
    exit 1
  fi
}
