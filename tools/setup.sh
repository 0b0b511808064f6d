#!/usr/bin/env bash
# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs missing Debian packages for building Vinebench, as root or through sudo. No effect if all
# are installed. Usage: setup.sh [--ros] [--browser] [--fuzz] [--packages] [--cycles] [--cluster]; with --ros also
# those for recording ROS 1 bags, and for the tests that read data sets with Python: 136 packages,
# 323 MB; with --browser also Chromium, for the tests of reports; with --fuzz also clang and its
# libFuzzer; with --packages also what makes Debian packages and wheels; with --cycles also Blender, for
# reference pictures: 414 MB; with --cluster also Slurm, GNU parallel and libfaketime, for the tests of
# sweeps.
set -euo pipefail

packages=(
  # tools
  g++ cmake ninja-build git pkg-config ccache clang-format
  # simulation (qhull: Debian's MuJoCo package names its headers)
  libmujoco-dev libqhull-dev libgl-dev libegl-dev libegl-mesa0 libgl1-mesa-dri libassimp-dev libtinygltf-dev
  # vision and optimisation
  libopencv-dev libeigen3-dev libceres-dev libapriltag-dev libhwy-dev
  # statistics
  libboost-math-dev
  # files, text, command line
  libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev libdeflate-dev
  libzstd-dev liblz4-dev libbz2-dev libsqlite3-dev libnlopt-dev libcpp-httplib-dev libssl-dev
  # the front end of reports
  esbuild libjs-three
  # the Python module
  python3-dev python3-numpy pybind11-dev
  # tests
  libgtest-dev libgmock-dev
)
# Where there is one: Mesa 25.1 and newer have none, and EGL is used alone.
osmesa=libosmesa6-dev

for option in "$@"; do
  case $option in
    --ros)
      packages+=(
        librosbag-storage-dev libsensor-msgs-dev libnav-msgs-dev libtf2-msgs-dev libros-rosgraph-msgs-dev
        python3-rosbag python3-opencv python3-pil python3-yaml
      )
      ;;
    --browser)
      packages+=(chromium chromium-driver python3-selenium node-typescript)
      ;;
    --fuzz)
      packages+=(clang libclang-rt-dev)
      ;;
    --packages)
      packages+=(dpkg-dev file python3-venv)
      ;;
    --cycles)
      packages+=(blender)
      ;;
    --cluster)
      packages+=(slurm-wlm munge parallel libfaketime bindfs)
      ;;
    *)
      echo "setup.sh: $option is no option; usage: setup.sh [--ros] [--browser] [--fuzz] [--packages] [--cycles] [--cluster]" >&2
      exit 2
      ;;
  esac
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup.sh: this system has no apt; install by its own means what these Debian packages hold:" >&2
  echo "  ${packages[*]} $osmesa" >&2
  exit 1
fi

is_installed() { [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }
is_known() { apt-cache show "$1" >/dev/null 2>&1; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if ! is_installed "$osmesa"; then
  # A system that never had apt's lists knows no package.
  if is_known "$osmesa" || ! is_known libegl-dev; then missing+=("$osmesa"); fi
fi
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: neither root nor sudo; have someone install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt_get=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get)
"${apt_get[@]}" update -qq
if [[ ${missing[-1]} == "$osmesa" ]] && ! is_known "$osmesa"; then
  unset "missing[-1]"
fi
echo "setup.sh: installing ${missing[*]}"
"${apt_get[@]}" install -y -qq --no-install-recommends "${missing[@]}"
