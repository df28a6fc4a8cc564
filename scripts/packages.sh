# Debian packages, by what they are for; sourced by quickstart and check.
packages_build="gcc libc6-dev meson ninja-build pkg-config libgsl-dev libfftw3-dev libhdf5-dev libyaml-dev libjansson-dev librandom123-dev gnuplot-nox"
packages_test="clang libcmocka-dev python3 python3-h5py python3-mdanalysis man-db"

# Install those of the named packages that are missing; say so, and stop with a clear message where that cannot be done.
install_missing() {
  missing=""
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  echo "Installing Debian packages:$missing" >&2
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "Not root and no sudo: ask for these packages to be installed:$missing" >&2; return 1; }
    as_root=sudo
  fi
  log=$(mktemp)
  if ! { $as_root apt-get update -q && DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -q --no-install-recommends $missing; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    echo "apt-get could not install:$missing" >&2
    return 1
  fi
  rm -f "$log"
}
