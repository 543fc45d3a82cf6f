# Sourced by app/run and tests/run: the setup that both need. It prints on stderr only, so that the output of tyglab
# stays clean. It expects `root`, the top of the source tree.

say() { printf '%s\n' "$*" >&2; }
fail() {
  say "$*"
  exit 1
}

# packages_of SECTION…: the names in those sections of cmake/packages.txt.
packages_of() {
  awk -v wanted=" $* " '
    { sub(/#.*/, "") }
    /^\[/ { section = substr($1, 2, length($1) - 2); next }
    NF && index(wanted, " " section " ") { print $1 }' "$root/cmake/packages.txt"
}

# missing_of PACKAGE…: those that are not installed.
missing_of() {
  local name
  for name in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || printf '%s\n' "$name"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

apt_get() { as_root apt-get -q -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@"; }

# install_packages SECTION…: installs missing packages; does nothing if there are none.
install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    fail "This script installs packages with Debian's apt, which this system lacks. Install the packages" \
      "listed in cmake/packages.txt by hand, then: cmake --preset release && cmake --build --preset release"
  local wanted missing
  mapfile -t wanted < <(packages_of "$@")
  mapfile -t missing < <(missing_of "${wanted[@]}")
  [ ${#missing[@]} -gt 0 ] || return 0
  [ "$(id -u)" = 0 ] || command -v sudo >/dev/null ||
    fail "Packages are missing, and installing them requires root or sudo. As root, run:" \
      "apt-get install --no-install-recommends ${missing[*]}"

  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log
  log=$(mktemp "${TMPDIR:-/tmp}/tyglab-apt.XXXXXX")
  # A machine's package lists may be missing or old; they are updated only if the installation fails without that.
  if ! apt_get install -y --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
    if ! { apt_get update && apt_get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
      tail -n 20 "$log" >&2
      rm -f "$log"
      fail "apt could not install: ${missing[*]}. The end of its output is above; check the network, then run this again."
    fi
  fi
  rm -f "$log"
}

# install_more SECTION…: installs the missing packages that apt offers; tests that need the others are skipped.
install_more() {
  local name
  for name in $(missing_of $(packages_of "$@")); do
    apt-cache show "$name" >/dev/null 2>&1 && apt_get install -y --no-install-recommends "$name" >/dev/null 2>&1 ||
      say "$name could not be installed; tests that need it are skipped."
  done
}

# quietly WHAT COMMAND…: runs a command; its output is shown only if it fails.
quietly() {
  local what=$1 log start=$SECONDS
  shift
  log=$(mktemp "${TMPDIR:-/tmp}/tyglab-log.XXXXXX")
  if ! "$@" >"$log" 2>&1; then
    tail -n 200 "$log" >&2
    rm -f "$log"
    fail "$what failed; its output is above."
  fi
  rm -f "$log"
  [ $((SECONDS - start)) -lt 5 ] || say "$what took $((SECONDS - start)) s."
}

# build FOLDER ARGUMENT…: builds; on a terminal it shows the compiler's progress.
build() {
  local folder=$1
  shift
  if [ -t 2 ]; then
    cmake --build "$folder" "$@" >&2 || fail "Building failed; the compiler's output is above."
  else
    quietly "Building ${folder#"$root/"}" cmake --build "$folder" "$@"
  fi
}
