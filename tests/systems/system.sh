# SPDX-License-Identifier: LGPL-2.1-or-later
# What debian.sh, packages.sh and recipe.sh share: empty Debian systems below folders, and steps that are told. Read with `source`, with $1 = 12 or 13.
# MIRROR is another mirror of Debian than http://deb.debian.org/debian.
if [ "$(id -u)" -ne 0 ]; then
  echo "a chroot needs root" >&2
  exit 2
fi
case $1 in
  12) suite=bookworm ;;
  13) suite=trixie ;;
  *)
    echo "unknown release of Debian: $1, expected 12 or 13" >&2
    exit 2
    ;;
esac
repository=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)

step=start
begin() {
  step=$1
  echo "=== $step"
}

# What is mounted in SYSTEM goes; code 1 if something of it is busy.
leave() {
  local place status=0
  for place in ccache dev/shm dev/pts dev sys proc; do
    if mountpoint -q "$1/$place"; then
      umount "$1/$place" || status=1
    fi
  done
  return $status
}

# finish_with SYSTEM: when the script ends, however it does, it leaves the system and says how it ended.
finish_with() {
  trap 'status=$?; leave "'"$1"'" || true
    if [ $status -eq 0 ]; then echo "Debian: everything works"; else echo "Debian: failed at: $step" >&2; status=1; fi; exit $status' EXIT
}

# make_system SYSTEM: an empty one where there is none.
make_system() {
  [ ! -e "$1/etc/debian_version" ] || return 0
  debootstrap --variant=minbase "$suite" "$1" "${MIRROR:-http://deb.debian.org/debian}" >"$1.log" 2>&1 || {
    tail -n 5 "$1.log" >&2
    exit 1
  }
}

# enter SYSTEM: makes it where there is none, with what MPI reads of the processors, and what it talks through.
enter() {
  make_system "$1"
  local place
  for place in proc sys dev dev/pts dev/shm; do
    mountpoint -q "$1/$place" || mount --bind "/$place" "$1/$place"
  done
  cp /etc/resolv.conf /etc/hosts "$1/etc/"
  inside "$1" "apt-get update -qq"
}

# inside SYSTEM COMMAND: of a shell there, with nothing of the environment of this one. The language is set as images of containers set it:
# ccache hashes the variables, and hits for the same compiler outside.
inside() {
  chroot "$1" /usr/bin/env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
    DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe \
    ${CCACHE_DIR:+CCACHE_DIR=/ccache} ${MYOLINES_JOBS:+MYOLINES_JOBS="$MYOLINES_JOBS"} bash -euo pipefail -c "$2"
}
