#!/usr/bin/env bash
# Installs what is missing, builds, and runs the demo or the tests, on a fresh Debian 12/13 or Ubuntu 24.04.
# Everything this script itself says goes to stderr; stdout is the program's.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: ./build.sh COMMAND [ARGUMENT…]

  demo [OPTION…]     install what is missing, build, run `rockfold demo` with the options
  test [PRESET]      install what is missing, build, run the tests (all but the slow ones)
  build [PRESET]     install what is missing, build
  bench [OPTION…]    build, run every benchmark in perf/ with the options of Google Benchmark
  format             lay out the C++ files with clang-format
  packages           list the packages of the distribution that are needed, those that are missing, and optional ones
  kokkos             find or build Kokkos, print its prefix
  kokkos-source      fetch the sources of the pinned Kokkos release, print where they are (for the preset cuda)
  clean              remove build/ (the cached Kokkos stays)
  help               this text

PRESET is release (the default), debug or asan (CMakePresets.json); build/PRESET is its build tree.
Example: ./build.sh demo --json > demo.json

environment:
  Kokkos_ROOT        prefix of an installed Kokkos to use (3.4 or newer, with OpenMP)
  KOKKOS_RUNG        1…4: use this rung of the Kokkos ladder alone (see README.md)
  ROCKFOLD_JOBS      compilations at a time (default: by cores and memory)
  ROCKFOLD_WERROR    ON: warnings are errors (ON where CI is set)
  XDG_CACHE_HOME     where the built Kokkos is kept (default ~/.cache), in the folder rockfold/
TEXT
}

# What CMake, the compiler and the tests need. The names are the same in Debian 12, 13 and Ubuntu 24.04.
packages=(
  g++ cmake ninja-build ccache dpkg-dev ca-certificates
  libcgal-dev libmpfr-dev libgmp-dev libeigen3-dev libmetis-dev coinor-libclp-dev libhdf5-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libmuparser-dev
  libgtest-dev libbenchmark-dev python3 python3-h5py python3-tomli-w
)

# The page of `rockfold view` is made with npm. Without it, or where it cannot be installed, everything else is built.
optional_packages=(npm)

# The pinned release of Kokkos. The checksum is the published one of the release's own archive; package collections
# (Spack, Homebrew) pin the same.
kokkos_version=5.1.1
kokkos_url="https://github.com/kokkos/kokkos/releases/download/$kokkos_version/kokkos-$kokkos_version.tar.gz"
kokkos_sha256=8bdbee0f0ac383436743ad8a9e3e928705b34b31a25a92dc5179c52a3aa98519
kokkos_options=(
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_STANDARD=20 -DCMAKE_CXX_EXTENSIONS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON
  -DBUILD_SHARED_LIBS=OFF -DCMAKE_INSTALL_LIBDIR=lib
  -DKokkos_ENABLE_SERIAL=ON -DKokkos_ENABLE_OPENMP=ON -DKokkos_ENABLE_TESTS=OFF -DKokkos_ENABLE_EXAMPLES=OFF
)

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
logs=$root/build/logs
scratch=

say() { printf '%s\n' "$*" >&2; }

fail() {
  say "build.sh: $1"
  shift
  local line
  for line in "$@"; do say "  $line"; done
  exit 1
}

cleanup() { if [[ -n $scratch ]]; then rm -rf -- "$scratch"; fi; }
trap cleanup EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# logged NAME COMMAND…: the output goes to build/logs/NAME.log; the end of it is shown when the command fails.
logged() {
  local name=$1 log=$logs/$1.log
  shift
  mkdir -p "$logs"
  if "$@" >"$log" 2>&1 </dev/null; then return 0; fi
  say "build.sh: failed: $name"
  tail -n 20 -- "$log" | cut -c 1-200 | sed 's/^/  | /' >&2
  say "  (the whole of it: $log)"
  return 1
}

# ---------------------------------------------------------------------------------------------------------------------
# Packages

missing_packages() {
  local installed package
  # dpkg-query fails where it does not know one of the names; what it prints counts.
  installed=$(LC_ALL=C dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
  for package in "${packages[@]}"; do
    grep -qxF "installed $package" <<<"$installed" || printf '%s\n' "$package"
  done
}

distribution() { (. /etc/os-release 2>/dev/null && printf '%s' "${PRETTY_NAME:-$ID}") || uname -s; }

install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || fail \
    "this is $(distribution); packages are installed here with apt alone (Debian 12 or 13, Ubuntu 24.04)." \
    "Install a C++20 compiler, CMake 3.25, Ninja, CGAL 5.5, Eigen 3.4, METIS 5.1, HDF5, CLI11, toml++ 3.3, nlohmann-json 3.11, fmt," \
    "GoogleTest, Google Benchmark and Kokkos 4.5 with OpenMP by your system's own means; then:" \
    "cmake --preset release && cmake --build --preset release"
  local missing
  mapfile -t missing < <(missing_packages)
  [[ ${#missing[@]} -gt 0 ]] || return 0

  local as_root=()
  if [[ $(id -u) -ne 0 ]]; then
    if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 0 ]]; }; then
      as_root=(sudo)
    else
      fail "packages are missing, and installing them needs root (or sudo). Ask an administrator for:" \
        "apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    fi
  fi
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  [[ ${#as_root[@]} -eq 0 ]] || "${as_root[@]}" true  # asks for the password here, not into the log
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -y -o DPkg::Lock::Timeout=300
    -o Acquire::Retries=2 -o Acquire::http::Timeout=20 -o Acquire::https::Timeout=20)
  logged apt-update "${apt[@]}" update || fail "apt-get update failed: see above."
  if ! logged apt-install "${apt[@]}" install --no-install-recommends "${missing[@]}"; then
    if grep -qE "Could not (resolve|connect)|Temporary failure|Failed to fetch|Connection (failed|timed out)|unreachable" \
      "$logs/apt-update.log" "$logs/apt-install.log"; then
      fail "the packages could not be fetched: is there a network? These are missing:" "${missing[*]}"
    fi
    if grep -q "Unable to locate package\|no installation candidate" "$logs/apt-install.log"; then
      fail "this release ($(distribution)) does not have all packages (on Ubuntu, is the component 'universe' on?)." \
        "Debian 12, Debian 13 and Ubuntu 24.04 have them."
    fi
    fail "apt-get could not install: ${missing[*]}"
  fi
  mapfile -t missing < <(missing_packages)
  [[ ${#missing[@]} -eq 0 ]] || fail "apt-get reported success, but these are still missing: ${missing[*]}"
}

# Never fails: says what will be missing.
install_npm() {
  command -v npm >/dev/null && return 0
  say "Installing npm, for the page of rockfold view …"
  local as_root=()
  if [[ $(id -u) -ne 0 ]]; then
    if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 0 ]]; }; then as_root=(sudo); fi
  fi
  logged apt-npm "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -y -o DPkg::Lock::Timeout=300 \
    -o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o Acquire::https::Timeout=20 \
    install --no-install-recommends "${optional_packages[@]}" ||
    say "npm could not be installed: the program is built without the page of \`rockfold view\`."
}

check_tools() {
  local found
  found=$(cmake --version 2>/dev/null | sed -n '1s/[^0-9]*\([0-9.]*\).*/\1/p')
  [[ -n $found ]] || fail "cmake does not run; it is needed in version 3.25 or newer."
  [[ $(printf '3.25\n%s\n' "$found" | sort -V | head -n 1) == 3.25 ]] ||
    fail "cmake $found ($(command -v cmake)) is too old: 3.25 or newer is needed."
}

# ---------------------------------------------------------------------------------------------------------------------
# Kokkos: the first rung that serves.
#   1  an installed one: Kokkos_ROOT, or 4.5 or newer where CMake looks by itself; with OpenMP
#   2  one that an earlier run built, in the cache folder
#   3  the pinned release, by its SHA256
#   4  the distribution's own source package, by apt's signatures

cache_folder() {
  local base=${XDG_CACHE_HOME:-}
  if [[ -z $base ]]; then
    local home=${HOME:-$(getent passwd "$(id -u)" 2>/dev/null | cut -d: -f6)}
    base=${home:+$home/.cache}
  fi
  # Without a home that can be written: inside the build folder.
  if [[ -z $base ]] || ! mkdir -p -- "$base/rockfold" 2>/dev/null || [[ ! -w $base/rockfold ]]; then
    base=$root/build/cache
    mkdir -p -- "$base/rockfold"
  fi
  printf '%s' "$base/rockfold"
}

compiler() { command -v "${CXX:-c++}" || fail "no C++ compiler: '${CXX:-c++}' was not found."; }

# A Kokkos fits the options and the compiler that built it.
kokkos_key() {
  local cxx
  cxx=$(compiler)
  { printf '%s\n' "${kokkos_options[@]}" "$cxx"; "$cxx" -dumpmachine; "$cxx" --version | head -n 1; } |
    sha256sum | cut -c 1-12
}

config_folder() {  # of a prefix
  local folder
  for folder in "$1"/lib*/cmake/Kokkos "$1"/lib/*/cmake/Kokkos; do
    if [[ -f $folder/KokkosConfig.cmake ]]; then printf '%s' "$folder"; return 0; fi
  done
  return 1
}

# Asks CMake for an installed Kokkos; prints the folder of its configuration, or says why it does not serve.
kokkos_rung_1() {
  local probe=$scratch/probe answer
  mkdir -p "$probe"
  cat >"$probe/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(probe LANGUAGES CXX)
set(CMAKE_CXX_EXTENSIONS OFF)
find_package(Kokkos CONFIG QUIET)
set(least 4.5)
if(DEFINED ENV{Kokkos_ROOT})
  set(least 3.4)  # asked for by name
endif()
if(NOT Kokkos_FOUND)
  message(STATUS "answer:none is installed")
elseif(Kokkos_VERSION VERSION_LESS least)
  message(STATUS "answer:${Kokkos_DIR} is ${Kokkos_VERSION}, ${least} is needed")
elseif(NOT "OPENMP" IN_LIST Kokkos_DEVICES)
  message(STATUS "answer:${Kokkos_DIR} (${Kokkos_VERSION}) has no OpenMP, only ${Kokkos_DEVICES}")
else()
  message(STATUS "answer:yes ${Kokkos_VERSION} ${Kokkos_DIR}")
endif()
CMAKE
  logged kokkos-find cmake -S "$probe" -B "$probe/build" -G Ninja || return 1
  answer=$(sed -n 's/^-- answer://p' "$logs/kokkos-find.log")
  if [[ $answer == yes\ * ]]; then
    answer=${answer#yes }
    kokkos_found="${answer#* }"
    say "Kokkos: rung 1, the installed ${answer%% *} in $kokkos_found"
    return 0
  fi
  if [[ -n ${Kokkos_ROOT:-} ]]; then
    fail "the Kokkos asked for by Kokkos_ROOT=$Kokkos_ROOT does not serve: ${answer:-no answer}."
  fi
  [[ $answer == "none is installed" ]] || say "Kokkos: an installed one is passed over: $answer"
  return 1
}

kokkos_rung_2() {
  local prefix newest=
  while IFS= read -r prefix; do
    if config_folder "$prefix" >/dev/null; then newest=$prefix; fi
  done < <(printf '%s\n' "$1"/kokkos-*-"$2" | sort -V)
  [[ -n $newest ]] || return 1
  kokkos_found=$(config_folder "$newest")
  say "Kokkos: rung 2, the one built before in $newest"
}

# fetch URL FILE SECONDS [SHA256]: through CMake, so that no other tool is needed. Only the first bytes without a SHA256.
fetch() {
  local check='RANGE_START 0 RANGE_END 1023'
  if [[ -n ${4:-} ]]; then check="EXPECTED_HASH SHA256=$4"; fi
  cat >"$scratch/fetch.cmake" <<CMAKE
file(DOWNLOAD "$1" [==[$2]==] TIMEOUT $3 INACTIVITY_TIMEOUT 15 TLS_VERIFY ON STATUS status $check)
list(GET status 0 code)
if(code)
  message(FATAL_ERROR "$1: \${status}")
endif()
CMAKE
  timeout -k 2 "$(($3 + 2))" cmake -P "$scratch/fetch.cmake"
}

# The pinned release, unpacked to $scratch/source.
fetch_release() {
  say "Kokkos: looking for the release $kokkos_version on the network …"
  if ! fetch "$kokkos_url" "$scratch/first-bytes" 8 >"$scratch/fetch.log" 2>&1; then
    say "Kokkos: the release cannot be had: ${kokkos_url%%/kokkos/*} is out of reach."
    return 1
  fi
  logged kokkos-fetch fetch "$kokkos_url" "$scratch/kokkos.tar.gz" 300 "$kokkos_sha256" || return 1
  mkdir "$scratch/source"
  logged kokkos-unpack tar -xzf "$scratch/kokkos.tar.gz" -C "$scratch/source" --strip-components=1
}

kokkos_rung_3() {
  fetch_release || return 1
  kokkos_build "$1" "$2" "$kokkos_version" || return 1
  say "Kokkos: rung 3, the release $kokkos_version (SHA256 verified), built in $kokkos_found"
}

# Where apt may fetch the source package from, one "URI suite" a line: the mirrors that this machine's apt uses.
apt_sites() {
  local VERSION_CODENAME=''
  . /etc/os-release
  LC_ALL=C apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' 2>/dev/null |
    grep -E " $VERSION_CODENAME$" | awk '!seen[$0]++' || true
}

# The distribution's source package `trilinos` holds Kokkos in packages/kokkos. Its upstream archive is enough.
kokkos_rung_4() {
  command -v apt-get >/dev/null || return 1
  say "Kokkos: fetching the distribution's source package trilinos (some 170 MB) …"
  local site archive='' version='' part
  while IFS= read -r site; do
    if fetch_source_package "$site" trilinos; then
      archive=$(printf '%s\n' "$scratch"/apt/download/*.orig.tar.*)
      break
    fi
    say "Kokkos: not to be had from $site"
  done < <(apt_sites)
  [[ -f $archive ]] || return 1

  mkdir "$scratch/source"
  logged kokkos-unpack tar -xf "$archive" -C "$scratch/source" --strip-components=3 --wildcards '*/packages/kokkos/*' ||
    return 1
  for part in MAJOR MINOR PATCH; do
    version+=.$(sed -n "s/^ *set *(Kokkos_VERSION_$part \([0-9]*\)).*/\1/Ip" "$scratch/source/CMakeLists.txt" | head -n 1)
  done
  # CMake's numbers have no leading zeros where the release's name has: 3.4.1 is 3.4.01.
  [[ $version =~ ^\.([0-9]+)\.([0-9]+)\.([0-9]+)$ ]] || { say "Kokkos: its version was not understood: $version"; return 1; }
  version=$(printf '%d.%d.%02d' "$((10#${BASH_REMATCH[1]}))" "$((10#${BASH_REMATCH[2]}))" "$((10#${BASH_REMATCH[3]}))")
  kokkos_build "$1" "$2" "$version" || return 1
  say "Kokkos: rung 4, $version from ${archive##*/} (by apt's signed index), built in $kokkos_found"
}

# fetch_source_package "URI SUITE" NAME: its upstream archive, into $scratch/apt/download. apt checks the Release file's
# signature with the distribution's keys, the index of sources by the Release file, and the archive by the index; the
# archive is summed once more here. Nothing of the machine's own apt state is touched.
fetch_source_package() {
  local apt=$scratch/apt keys='' components=main file sums
  rm -rf -- "$apt"
  mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/download"
  if [[ $1 == *ubuntu* ]]; then components="main universe"; fi
  for file in /usr/share/keyrings/"$(. /etc/os-release && printf '%s' "$ID")"-archive-keyring.{gpg,pgp}; do
    if [[ -f $file && -z $keys ]]; then keys="[signed-by=$file] "; fi
  done
  printf 'deb-src %s%s %s\n' "$keys" "$1" "$components" >"$apt/sources.list"
  local options=(-o "Dir::Etc::sourcelist=$apt/sources.list" -o Dir::Etc::sourceparts=/dev/null
    -o Dir::Etc::preferencesparts=/dev/null -o "Dir::State::lists=$apt/lists" -o "Dir::Cache=$apt/cache"
    -o APT::Sandbox::User=root -o Acquire::AllowInsecureRepositories=false -o APT::Get::AllowUnauthenticated=false
    -o APT::Update::Error-Mode=any -o Acquire::Retries=1 -o Acquire::http::Timeout=15 -o Acquire::https::Timeout=15)
  logged kokkos-apt-update env LC_ALL=C apt-get -q "${options[@]}" update || return 1
  (
    cd "$apt/download" || exit 1
    logged kokkos-apt-source env LC_ALL=C apt-get -q "${options[@]}" source --download-only --tar-only "$2" || exit 1
    # The sums in the index, "SUM  FILE" each.
    sums=$(LC_ALL=C apt-cache "${options[@]}" showsrc "$2" | sed -n 's/^ \([0-9a-f]\{64\}\) [0-9]* \(.*\)/\1  \2/p')
    for file in *.orig.tar.*; do
      grep -F "  $file" <<<"$sums" | sort -u >>SHA256SUMS || { say "Kokkos: apt's index has no sum of $file"; exit 1; }
    done
    logged kokkos-sums sha256sum --check --strict SHA256SUMS
  )
}

# kokkos_build CACHE KEY VERSION: builds $scratch/source and moves the whole prefix into place at once.
kokkos_build() {
  local prefix=$1/kokkos-$3-$2
  local flags="-ffp-contract=off"
  # 3.4 leans on older standard libraries to include <cstdint>, and warns under C++20 by the thousand.
  if [[ $3 == 3.* ]]; then flags+=" -include cstdint -w"; fi
  say "Kokkos: building $3 with OpenMP …"
  logged kokkos-configure cmake -S "$scratch/source" -B "$scratch/build" -G Ninja "-DCMAKE_CXX_COMPILER=$(compiler)" \
    "-DCMAKE_INSTALL_PREFIX=$prefix" "-DCMAKE_CXX_FLAGS=$flags" "${kokkos_options[@]}" || return 1
  logged kokkos-build cmake --build "$scratch/build" -j "$(jobs_at_a_time)" || return 1
  logged kokkos-install cmake --install "$scratch/build" --prefix "$scratch/prefix" || return 1
  config_folder "$scratch/prefix" >/dev/null || { say "Kokkos: the built prefix has no configuration."; return 1; }
  rm -rf -- "$prefix"
  mv -T -- "$scratch/prefix" "$prefix"
  kokkos_found=$(config_folder "$prefix")
}

# One run at a time builds; the others wait and then find what it built. What a killed run left is removed.
lock_cache() {
  exec 9>"$1/lock"
  if ! flock -n 9; then
    say "Kokkos: another run is at it; waiting …"
    flock 9
  fi
  rm -rf -- "$1"/tmp.*
  scratch=$(mktemp -d "$1/tmp.XXXXXX")
}

unlock_cache() {
  rm -rf -- "$scratch"
  scratch=
  exec 9>&-
}

# The pinned release's sources in the cache folder, for the preset cuda; prints where.
kokkos_source() {
  local cache folder
  cache=$(cache_folder)
  folder=$cache/kokkos-$kokkos_version-source
  lock_cache "$cache"
  if [[ ! -d $folder ]]; then
    fetch_release || fail "the sources of Kokkos $kokkos_version could not be had: $kokkos_url"
    mv -T -- "$scratch/source" "$folder"
  fi
  unlock_cache
  printf '%s\n' "$folder"
}

# Sets kokkos_found to the folder of KokkosConfig.cmake, and leaves its prefix in build/kokkos-prefix.txt.
find_kokkos() {
  local cache key rung
  cache=$(cache_folder)
  key=$(kokkos_key)
  kokkos_found=
  lock_cache "$cache"
  for rung in ${KOKKOS_RUNG:-1 2 3 4}; do
    case $rung in
      1) kokkos_rung_1 && break ;;
      2) kokkos_rung_2 "$cache" "$key" && break ;;
      3) kokkos_rung_3 "$cache" "$key" && break ;;
      4) kokkos_rung_4 "$cache" "$key" && break ;;
      *) fail "KOKKOS_RUNG is '$rung'; it can be 1, 2, 3 or 4." ;;
    esac
    rm -rf -- "$scratch"/*
  done
  unlock_cache
  [[ -n $kokkos_found ]] || fail "no Kokkos with OpenMP was found or could be built (see above; logs in $logs)." \
    "With a network, run this again. Without: install Kokkos 4.5 or newer with OpenMP, and set Kokkos_ROOT to its prefix."
  mkdir -p "$root/build"
  printf '%s\n' "${kokkos_found%/lib*/cmake/Kokkos}" >"$root/build/kokkos-prefix.txt.$$"
  mv -- "$root/build/kokkos-prefix.txt.$$" "$root/build/kokkos-prefix.txt"
}

# ---------------------------------------------------------------------------------------------------------------------
# Build

# A file of exact geometry takes up to 1.7 GB to compile.
jobs_at_a_time() {
  local cores memory jobs
  if [[ -n ${ROCKFOLD_JOBS:-} ]]; then printf '%s' "$ROCKFOLD_JOBS"; return; fi
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ {print int($2 / 1800000)}' /proc/meminfo)
  jobs=$((memory < cores ? memory : cores))
  printf '%s' "$((jobs > 0 ? jobs : 1))"
}

configure() {  # PRESET
  case $1 in
    release | debug | asan) ;;
    *) fail "there is no preset '$1'; release, debug and asan are built here (cuda: see README.md)." ;;
  esac
  install_packages
  install_npm
  check_tools
  find_kokkos
  local werror=${ROCKFOLD_WERROR:-}
  if [[ -z $werror ]]; then werror=$([[ -n ${CI:-} ]] && echo ON || echo OFF); fi
  (cd "$root" && logged "configure-$1" cmake --preset "$1" "-DKokkos_DIR=$kokkos_found" "-DROCKFOLD_WERROR=$werror") ||
    fail "CMake could not configure the preset $1: see above."
}

compile() {  # PRESET [TARGET…]
  local preset=$1
  shift
  (cd "$root" && cmake --build --preset "$preset" -j "$(jobs_at_a_time)" ${1+--target "$@"}) >&2 ||
    fail "the build of the preset $preset failed: see above."
}

command=${1:-help}
shift || true
case $command in
  demo)
    configure release
    compile release rockfold
    exec "$root/build/release/rockfold" demo "$@"
    ;;
  test)
    configure "${1:-release}"
    compile "${1:-release}"
    cd "$root"
    exec ctest --preset "${1:-release}" -j "$(nproc)"
    ;;
  build)
    configure "${1:-release}"
    compile "${1:-release}"
    say "Built: $root/build/${1:-release}/rockfold"
    ;;
  bench)
    configure release
    compile release
    for bench in "$root"/build/release/perf/bench_*; do
      [[ -x $bench && ! -d $bench ]] || continue
      OMP_PROC_BIND=${OMP_PROC_BIND:-spread} OMP_PLACES=${OMP_PLACES:-cores} "$bench" "$@"
    done
    ;;
  format)
    command -v clang-format >/dev/null || fail "clang-format is missing: apt-get install clang-format"
    cd "$root"
    git ls-files -z --cached --others --exclude-standard -- '*.cpp' '*.hpp' | xargs -0 -r clang-format -i
    ;;
  packages)
    printf 'needed:  %s\n' "${packages[*]}"
    printf 'missing: %s\n' "$(missing_packages | paste -sd ' ')"
    printf 'optional: %s\n' "${optional_packages[*]}"
    ;;
  kokkos)
    install_packages
    check_tools
    find_kokkos
    cat "$root/build/kokkos-prefix.txt"
    ;;
  kokkos-source)
    install_packages
    check_tools
    kokkos_source
    ;;
  clean) rm -rf -- "$root/build" ;;
  help | -h | --help) usage ;;
  *)
    usage >&2
    fail "there is no command '$command'."
    ;;
esac
