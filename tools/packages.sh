#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the packages in clean Debian systems, installs them in others, and runs quick-loop there: its
# hash must be that of build/vinebench. The clean systems are folders made by debootstrap, so this
# needs root, debootstrap and git, and neither Docker nor a registry of images.
# Usage: packages.sh [deb] [wheel] [docker] [debian-13]; the first three by default.
#   deb        the Debian packages, as the Dockerfile's stage `build` makes them; lintian finds nothing
#   wheel      the wheel for Debian's Python, with all libraries in it
#   docker     all steps of the Dockerfile, and those of .devcontainer/
#   debian-13  the Debian packages on and for Debian 13, whose libraries give another hash
# Packages are left in out/packages.
#   VINEBENCH=build/vinebench  CHROOTS=/var/tmp/vinebench-packages (removed in the end unless KEEP=1)
#   JOBS=N (of the compiler)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
CHROOTS=${CHROOTS:-/var/tmp/vinebench-packages}
vinebench=${VINEBENCH:-build/vinebench}
out=$PWD/out/packages
CHROOT_ENVIRONMENT=(CCACHE_BASEDIR=/src CCACHE_NOHASHDIR=1 "CMAKE_BUILD_PARALLEL_LEVEL=${JOBS:-$(nproc)}")
# shellcheck source=packaging/chroot.sh
. packaging/chroot.sh
# shellcheck source=packaging/stages.sh
. packaging/stages.sh

say() { echo "packages.sh: $*"; }
give_up() {
  say "$*" >&2
  exit 1
}

# of_run FOLDER KEY: a text of the run's metrics.json.
of_run() { sed -nE "s/^ *\"$2\": \"([^\"]*)\",?$/\1/p" "$1/metrics.json" | head -n 1; }

# same_hash NAME FOLDER: the run there against that of build/vinebench.
same_hash() {
  local hash expected
  if [[ ! -f $out/reference/metrics.json ]]; then
    "$vinebench" run quick-loop --out "$out/reference" >"$out/reference.log" 2>&1 ||
      give_up "$vinebench: $(tail -n 1 "$out/reference.log")"
  fi
  hash=$(of_run "$2" hash) expected=$(of_run "$out/reference" hash)
  if [[ $hash != "$expected" ]]; then
    diff <(grep -A 12 '"hash_environment"' "$out/reference/metrics.json") \
      <(grep -A 12 '"hash_environment"' "$2/metrics.json") >&2 || true
    give_up "$1: quick-loop has the hash $hash, expected $expected"
  fi
  say "$1: quick-loop has the hash $hash"
}

# quick_loop ROOT NAME COMMAND...: runs it by that program there, into out/packages/NAME.
quick_loop() {
  rm -rf "$out/$2"
  mkdir -p "$out/$2"
  CHROOT_FOLDER=/ chroot_run "$1" "$out/$2:/result" -- "${@:3}" run quick-loop --out /result >"$out/$2.log" 2>&1 ||
    give_up "$2: quick-loop: $(tail -n 3 "$out/$2.log")"
}

# quick_loop_in_python ROOT NAME PYTHON: the same by the module.
quick_loop_in_python() {
  rm -rf "$out/$2"
  mkdir -p "$out/$2"
  chroot_run "$1" "$out/$2:/result" -- "$3" -W error -c \
    'import vinebench; assert vinebench.run("quick-loop", out="/result").passed'
}

# install_debs ROOT DEBS NAME...: packages of the folder DEBS with what they depend on, nothing else.
install_debs() {
  local root=$1 debs=$2 name packages=()
  for name in "${@:3}"; do packages+=("/packages/$(basename "$(echo "$debs/${name}"_*.deb)")"); done
  chroot_run "$root" "$debs:/packages" -- sh -c \
    'apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@"' sh "${packages[@]}" >"$root.log" 2>&1 ||
    give_up "${packages[*]}: $(tail -n 5 "$root.log")"
}

# check_lintian SUITE DEBS: in a clean system it finds no errors and no warnings but those that
# packaging/debian/ overrides.
check_lintian() {
  local root=$CHROOTS/lintian
  chroot_new "$1" "$root"
  chroot_run "$root" -- sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends lintian' \
    >"$root.log" 2>&1 || give_up "lintian of $1: $(tail -n 5 "$root.log")"
  chroot_run "$root" "$2:/packages" -- sh -c 'lintian --allow-root --fail-on error,warning /packages/*.deb' |
    tee "$2/lintian.txt" || give_up "lintian found something"
  chroot_remove "$root"
}

# build_debs SUITE: the Dockerfile's stage `build` on that Debian; packages into out/packages/SUITE.
build_debs() {
  run_stages build "$1"
  rm -rf "${out:?}/$1"
  cp -r "$(stage_folder build)/packages" "$out/$1"
  check_lintian "$1" "$out/$1"
  say "$(cd "$out/$1" && du -b ./*.deb | tr '\n' ' ')"
}

# check_library ROOT DEBS: an example is built against libvinebench-dev.
check_library() {
  install_debs "$1" "$2" libvinebench-dev
  CHROOT_FOLDER=/ chroot_run "$1" "$PWD/examples/feed_images:/example" -- sh -c \
    'apt-get install -y -qq --no-install-recommends g++ cmake make >/dev/null 2>&1 && built=$(mktemp -d) &&
     cmake -S /example -B "$built" >/dev/null && cmake --build "$built" >/dev/null &&
     "$built/feed_images" /example 2>/dev/null' || give_up "libvinebench-dev: the example is not built"
  say "libvinebench-dev: the example feed_images is built and runs"
}

check_deb() {
  local root=$CHROOTS/deb
  build_debs bookworm
  chroot_new bookworm "$root"
  install_debs "$root" "$out/bookworm" vinebench
  quick_loop "$root" deb vinebench
  same_hash deb "$out/deb"
  install_debs "$root" "$out/bookworm" vinebench python3-vinebench
  quick_loop_in_python "$root" deb-python python3
  same_hash python3-vinebench "$out/deb-python"
  chroot_run "$root" -- apt-get purge -y -qq vinebench python3-vinebench >"$root.log" 2>&1
  [[ -z $(find "$root/usr" -name '*vinebench*' -print -quit) ]] || give_up "purged packages leave files"
  chroot_new bookworm "$root"
  check_library "$root" "$out/bookworm"
  chroot_remove "$root"
}

check_wheel() {
  local root=$CHROOTS/wheel build wheels=$CHROOTS/wheels name platforms=()
  [[ -d $(stage_folder tools) ]] || run_stages tools bookworm
  build=$(stage_folder tools)
  mkdir -p "$wheels" "$out/wheel"
  rm -f "$out"/wheel/*.whl
  for name in _2_36 _2_28 _2_27 _2_17 _2_5 2014 1; do platforms+=(--platform "manylinux${name}_x86_64"); done
  "${PYTHON:-python3}" -m pip download -q --only-binary=:all: --python-version 3.11 --implementation cp \
    "${platforms[@]}" -d "$wheels" -r packaging/wheel/requirements.txt
  copy_context "$build/src"
  CHROOT_FOLDER=/src chroot_run "$build" "$wheels:/wheels" "$out/wheel:/packages" "${STAGE_BINDS[@]}" -- \
    packaging/wheel/build.sh /wheels /packages
  chroot_new bookworm "$root"
  chroot_run "$root" "$wheels:/wheels" "$out/wheel:/packages" -- sh -c \
    'apt-get update -qq && apt-get install -y -qq --no-install-recommends python3-venv && python3 -m venv /venv &&
     /venv/bin/pip install -q --no-index --find-links /wheels /packages/vinebench-*.whl' >"$root.log" 2>&1 ||
    give_up "wheel: $(tail -n 5 "$root.log")"
  quick_loop "$root" wheel-program /venv/bin/vinebench
  same_hash "wheel, program" "$out/wheel-program"
  quick_loop_in_python "$root" wheel-python /venv/bin/python
  same_hash "wheel, module" "$out/wheel-python"
  say "$(du -b "$out"/wheel/*.whl), installed $(du -sm "$root"/venv/lib/python3*/site-packages/vinebench* | awk '{ m += $1 } END { print m }') MiB"
  chroot_remove "$root"
}

check_docker() {
  run_stages "" bookworm
  quick_loop "$(stage_folder last)" docker "${STAGE_START[0]}"
  same_hash docker "$out/docker"
  local folder command
  folder=$(stage_folder tools)
  command=$(sed -nE 's/.*"postCreateCommand": "(.*)",/\1/p' .devcontainer/devcontainer.json)
  grep -q '"dockerfile": "../Dockerfile".*"target": "tools"' .devcontainer/devcontainer.json
  copy_context "$folder/workspace"
  CHROOT_FOLDER=/workspace chroot_run "$folder" -- sh -c "$command" >"$out/devcontainer.log" 2>&1 ||
    give_up "devcontainer: $(tail -n 3 "$out/devcontainer.log")"
  say "devcontainer: $command"
}

check_debian_13() {
  local root=$CHROOTS/deb-13 hash
  build_debs trixie
  chroot_new trixie "$root"
  install_debs "$root" "$out/trixie" vinebench python3-vinebench
  quick_loop "$root" debian-13 vinebench
  hash=$(of_run "$out/debian-13" hash)
  say "debian-13: quick-loop passes and has the hash $hash"
  quick_loop_in_python "$root" debian-13-python python3
  [[ $(of_run "$out/debian-13-python" hash) == "$hash" ]] || give_up "debian-13: the module has another hash"
  chroot_remove "$root"
}

[[ $# -gt 0 ]] || set -- deb wheel docker
for package in "$@"; do
  case $package in
    deb | wheel | docker | debian-13) ;;
    *)
      echo "packages.sh: $package: expected deb, wheel, docker or debian-13" >&2
      exit 2
      ;;
  esac
done
command -v debootstrap >/dev/null && unshare --mount true 2>/dev/null || give_up "needs debootstrap, and root that may mount"
[[ -x $vinebench ]] || give_up "$vinebench: build it first, for the hash to compare with"
vinebench=$(realpath "$vinebench")
mkdir -p "$out" "$CHROOTS"
rm -rf "$out/reference"
for package in "$@"; do "check_${package//-/_}"; done
[[ ${KEEP:-} == 1 ]] || chroot_remove "$CHROOTS"
