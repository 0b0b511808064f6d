# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Clean Debian systems in folders, for tests of packages (tools/packages.sh). Needs root and
# debootstrap. Mirror and settings of apt are those of the running system. Mounts are made in a
# namespace of the command's own, so that none is left when it ends, however it ends.

# chroot_mirror [security]: the running system's mirror of Debian.
chroot_mirror() {
  local wanted=${1:-} uri
  while read -r uri; do
    case $uri in
      *security*) [[ $wanted != security ]] || { echo "$uri"; return; } ;;
      */debian | */debian/) [[ -n $wanted ]] || { echo "$uri"; return; } ;;
    esac
  done < <(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
    sed -nE 's/^(URIs:|deb( +\[[^]]*\])?) +([^ ]+).*/\3/p')
}

# chroot_new SUITE FOLDER: a clean system, as the image debian:SUITE-slim but for its documents.
chroot_new() {
  local suite=$1 root=$2 base=$CHROOTS/base-$1 mirror security
  mirror=$(chroot_mirror)
  security=$(chroot_mirror security)
  [[ -n $mirror ]] || { echo "chroot.sh: apt's sources name no mirror of Debian" >&2; return 1; }
  if [[ ! -e $base.made ]]; then
    chroot_remove "$base"
    debootstrap --variant=minbase "$suite" "$base" "$mirror" >"$base.log" 2>&1 ||
      { tail -n 5 "$base.log" >&2; return 1; }
    touch "$base.made"
  fi
  chroot_remove "$root"
  cp -a --reflink=auto "$base" "$root"
  {
    echo "deb $mirror $suite main"
    echo "deb $mirror $suite-updates main"
    [[ -z $security ]] || echo "deb $security $suite-security main"
  } >"$root/etc/apt/sources.list"
  # Files of packages are left out: where a package brings its own, dpkg would ask which to keep.
  local file
  for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/*; do
    [[ $file == */docker-* ]] || dpkg -S "$file" >/dev/null 2>&1 || ! grep -qs '^ *Acquire' "$file" || cp "$file" "$root/etc/apt/apt.conf.d/"
  done
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
}

# chroot_run FOLDER [FROM:TO]... -- COMMAND...: in it, with folders of this system bound into it.
# CHROOT_ENVIRONMENT has NAME=VALUE of its environment, CHROOT_FOLDER its working directory.
chroot_run() {
  local root=$1 environment=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root
    LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive) name
  shift
  for name in http_proxy https_proxy no_proxy; do
    [[ -z ${!name:-} ]] || environment+=("$name=${!name}")
  done
  environment+=("${CHROOT_ENVIRONMENT[@]}")
  local binds=("$CHROOTS/archives:/var/cache/apt/archives")
  while [[ $1 != -- ]]; do
    binds+=("$1")
    shift
  done
  shift
  mkdir -p "$CHROOTS/archives/partial"
  unshare --mount --propagation private bash -c '
    set -e
    root=$1 folder=$2 count=$3
    shift 3
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/tmp"
    for ((i = 0; i < count; i++)); do
      mkdir -p "$root${1#*:}"
      mount --bind "${1%%:*}" "$root${1#*:}"
      shift
    done
    exec chroot "$root" /usr/bin/env -i -C "$folder" "$@"
  ' bash "$root" "${CHROOT_FOLDER:-/}" "${#binds[@]}" "${binds[@]}" "${environment[@]}" "$@"
}

# chroot_remove FOLDER: refuses one in which something is mounted.
chroot_remove() {
  [[ -e $1 ]] || return 0
  if cut -d' ' -f2 /proc/self/mounts | grep -qF "$1/"; then
    echo "chroot.sh: $1: something is mounted in it" >&2
    return 1
  fi
  rm -rf --one-file-system "$1"
}
