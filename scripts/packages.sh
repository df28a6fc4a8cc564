# SPDX-License-Identifier: GPL-3.0-or-later
# What a step needs is there, or is installed, or is named: `need build unit`. Sourced by quickstart, check and others.
needs_table=scripts/needs.txt

# setup_tests FOLDER OPTIONS: a build folder with tests. One that was set up without them is set up again.
setup_tests() {
  again=""
  if [ -f "$1/build.ninja" ]; then
    grep -q '^build tests/' "$1/build.ninja" && return
    again=--reconfigure
  fi
  setup $again "$@" -Dtests=true
}

# Meson's words where it fails alone.
setup() {
  said=$(meson setup "$@" 2>&1) || { echo "$said" >&2; return 1; }
}

need() {
  if command -v apt-get >/dev/null && command -v dpkg-query >/dev/null; then
    install_missing "$@"
  else
    name_missing "$@"
  fi
  case " $* " in *" all "*) check_usable "${CC:-cc}" clang ;; *) check_usable "${CC:-cc}" ;; esac
}

# What is there may be too old, or half there: an earlier meson, a compiler without the headers that are its own.
check_usable() {
  least=$(sed -n "s/.*meson_version: '>=\([0-9.]*\)'.*/\1/p" meson.build)
  there=$(meson --version)
  if awk -v a="$there" -v b="$least" \
    'BEGIN { split(a, x, "."); split(b, y, "."); exit !(a && (x[1] < y[1] + 0 || x[1] == y[1] && x[2] < y[2] + 0)) }'; then
    echo "meson $there is too old: install meson $least or later, e.g. by: python3 -m pip install --user meson" >&2
    return 1
  fi
  for compiler in "$@"; do
    echo "#include <stddef.h>" | $compiler -E - >/dev/null 2>&1 && continue
    echo "$compiler does not find its own headers (stddef.h): install them, for clang on Debian: sudo apt-get install" \
      "libclang-common-$($compiler -dumpversion | sed 's/[.].*//')-dev" >&2
    return 1
  done
}

# Column $1 of the table, of the steps that follow.
names_of() {
  column=$1
  shift
  awk -v column="$column" -v steps=" $* " \
    '!/^#/ && index(steps, " " $1 " ") && $column != "-" && !seen[$column]++ { print $column }' "$needs_table"
}

install_missing() {
  missing=""
  for package in $(names_of 3 "$@"); do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { name_missing "$@"; return; }
    as_root=sudo
  fi
  echo "Installing Debian packages:$missing" >&2
  apt_log=$(mktemp)
  if ! { $as_root apt-get update -q && $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing; } >"$apt_log" 2>&1; then
    tail -n 20 "$apt_log" >&2
    echo "apt-get could not install:$missing (all it said: $apt_log)" >&2
    return 1
  fi
  rm -f "$apt_log"
}

# Is it there, for the compiler and the python that the build takes?
is_there() {
  what=${1#*:}
  case $1 in
  command:cc) command -v "${CC:-cc}" ;;
  command:*) command -v "$what" ;;
  module:*) for name in $(echo "$what" | tr , ' '); do pkg-config --exists "$name" && return 0; done; false ;;
  header:*) echo "#include <$what>" | ${CC:-cc} ${CPPFLAGS:-} ${CFLAGS:-} -E - ;;
  esac >/dev/null 2>&1
}

# Of the rows of those steps, the ones whose probe fails, as a table of the same form.
missing_rows() {
  while read -r step probe names; do
    case " $* " in *" $step "*) is_there "$probe" || echo "$step $probe $names" ;; esac
  done <"$needs_table"
}

# What is missing is said, and what this system, or others, would install it with. Nothing is: true.
name_missing() {
  rows=$(missing_rows "$@")
  [ -z "$rows" ] && return 0
  {
    echo "Missing on this machine, and not to be installed from here (no apt-get, or no right to use it):"
    echo "$rows" | sed 's/^[^ ]* \([^ ]*\).*/  \1/; s/module:/pkg-config module /; s/command://; s/header:/header /; s/,/ or /'
    echo "Install it, and start this again:"
    case $(command -v dnf || command -v brew || command -v pacman) in
    */dnf) suggest 4 "sudo dnf install" ;;
    */brew) suggest 5 "brew install" ;;
    */pacman) suggest 6 "sudo pacman -S" ;;
    *)
      suggest 3 "Debian, Ubuntu: sudo apt-get install"
      suggest 4 "Fedora: sudo dnf install"
      suggest 5 "Homebrew: brew install"
      suggest 6 "Arch: sudo pacman -S"
      ;;
    esac
    if command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null; then
      echo "  without root: scripts/packages-here ~/graingas-packages ./quickstart unpacks them into that folder (400 MB)"
    fi
    echo "  or use a static command that another machine has made: scripts/release static (docs/howto/install.md)"
    case $rows in *Random123*)
      echo "  Random123 is headers alone: where it is no package, unpack github.com/DEShawResearch/random123 and set"
      echo "  CPPFLAGS=-I<its folder include>"
      ;;
    esac
  } >&2
  return 1
}

suggest() {
  echo "$rows" | awk -v column="$1" -v line="  $2" \
    '$column != "-" && !seen[$column]++ { line = line " " $column } END { print line }'
}
