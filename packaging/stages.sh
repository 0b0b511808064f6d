# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
#
# Executes the steps of the Dockerfile in clean systems (chroot.sh). A stage goes on in the folder of
# the one that it comes from.

declare -A STAGE_FOLDERS=()
STAGE_START=()
STAGE_BINDS=()
ccache_folder=$(ccache -k cache_dir 2>/dev/null || true)
[[ ! -d $ccache_folder ]] || STAGE_BINDS=("$ccache_folder:/root/.cache/ccache")

# copy_context FOLDER: what is in the repository, as in a clone, with what is not committed yet.
copy_context() {
  rm -rf "$1"
  git clone -q --no-checkout --depth 1 "file://$PWD" "$1"
  git ls-files -z --cached --others --exclude-standard | xargs -0 -r cp -a --parents -t "$1"
}

# stage_folder NAME: empty if it was not executed; `last` is that of the last one.
stage_folder() { echo "${STAGE_FOLDERS[$1]:-}"; }

# stage_copy FROM ROOT FOLDER FILE... TO
stage_copy() {
  local from=$1 root=$2 folder=$3 words=("${@:4}") to file
  to=${words[-1]}
  [[ $to == /* ]] || to=$folder/$to
  for file in "${words[@]:0:${#words[@]}-1}"; do
    if [[ -d $from/$file ]]; then
      mkdir -p "$root/$to"
      cp -a "$from/$file/." "$root/$to/"
    else
      [[ $to != */ && $to != */. ]] || to=$to/$(basename "$file")
      mkdir -p "$(dirname "$root/$to")"
      cp -a "$from/$file" "$root/$to"
    fi
  done
}

# stage_begin NAME IMAGE SUITE: its system. SUITE is that of Debian in place of the image's.
stage_begin() {
  local name=$1 image=$2 suite=$3
  case $image in
    stage:*) STAGE_FOLDERS[$name]=${STAGE_FOLDERS[${image#stage:}]} ;;
    debian:12-slim)
      STAGE_FOLDERS[$name]=$CHROOTS/stage-$suite-$name
      chroot_new "$suite" "${STAGE_FOLDERS[$name]}"
      ;;
    *)
      echo "stages.sh: $image: no such image here" >&2
      return 1
      ;;
  esac
  STAGE_FOLDERS[last]=${STAGE_FOLDERS[$name]}
}

# run_stages STAGE SUITE: the steps of the Dockerfile up to the stage, or to the end where it is empty.
run_stages() {
  local steps=() step fields root="" log=$CHROOTS/stages.log
  mapfile -t steps < <(python3 packaging/dockerfile.py Dockerfile ${1:+"$1"})
  [[ ${#steps[@]} -gt 0 ]] || return 1
  copy_context "$CHROOTS/context"
  for step in "${steps[@]}"; do
    IFS=$'\t' read -ra fields <<<"$step"
    case ${fields[0]} in
      stage)
        stage_begin "${fields[1]}" "${fields[2]}" "$2"
        root=${STAGE_FOLDERS[last]}
        ;;
      run)
        CHROOT_FOLDER=${fields[1]} chroot_run "$root" "${STAGE_BINDS[@]}" -- /bin/sh -c "${fields[2]}" >"$log" 2>&1 ||
          { echo "Dockerfile: RUN ${fields[2]}" >&2; tail -n 20 "$log" >&2; return 1; }
        ;;
      copy) stage_copy "$CHROOTS/context" "$root" "${fields[@]:1}" ;;
      copyfrom) stage_copy "${STAGE_FOLDERS[${fields[1]}]}" "$root" "${fields[@]:2}" ;;
      start) STAGE_START=("${fields[@]:2}") ;;
    esac
  done
}
