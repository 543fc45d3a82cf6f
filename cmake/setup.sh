# Sourced by app/run and tests/run: what both need before they can start. Talks on stderr alone, so that the output of
# tyglab stays clean. Expects `root`, the top of the source tree.

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

# install_packages SECTION…: installs what is missing; does nothing when all is there.
install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    fail "This script installs packages with Debian's apt, which is not here. Install by hand what" \
      "cmake/packages.txt lists, then: cmake --preset release && cmake --build --preset release"
  local wanted missing
  mapfile -t wanted < <(packages_of "$@")
  mapfile -t missing < <(missing_of "${wanted[@]}")
  [ ${#missing[@]} -gt 0 ] || return 0
  [ "$(id -u)" = 0 ] || command -v sudo >/dev/null ||
    fail "Packages are missing, and neither root nor sudo is at hand. As root, run:" \
      "apt-get install --no-install-recommends ${missing[*]}"

  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log
  log=$(mktemp "${TMPDIR:-/tmp}/tyglab-apt.XXXXXX")
  # The lists of a machine may be missing or old: they are fetched only if the packages cannot be had without.
  if ! apt_get install -y --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
    if ! { apt_get update && apt_get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
      tail -n 20 "$log" >&2
      rm -f "$log"
      fail "apt could not install: ${missing[*]}. Its last words stand above; with a working network, run this again."
    fi
  fi
  rm -f "$log"
}

# install_more SECTION…: installs what is missing as far as apt has it; tests that need the rest are left out.
install_more() {
  local name
  for name in $(missing_of $(packages_of "$@")); do
    apt-cache show "$name" >/dev/null 2>&1 && apt_get install -y --no-install-recommends "$name" >/dev/null 2>&1 ||
      say "$name could not be installed; what needs it is not tested."
  done
}

# quietly WHAT COMMAND…: runs it; its output is shown only if it fails.
quietly() {
  local what=$1 log start=$SECONDS
  shift
  log=$(mktemp "${TMPDIR:-/tmp}/tyglab-log.XXXXXX")
  if ! "$@" >"$log" 2>&1; then
    tail -n 200 "$log" >&2
    rm -f "$log"
    fail "$what failed; what it said stands above."
  fi
  rm -f "$log"
  [ $((SECONDS - start)) -lt 5 ] || say "$what took $((SECONDS - start)) s."
}

# build FOLDER ARGUMENT…: builds; on a terminal the compiler's progress is seen.
build() {
  local folder=$1
  shift
  if [ -t 2 ]; then
    cmake --build "$folder" "$@" >&2 || fail "Building failed; what the compiler said stands above."
  else
    quietly "Building ${folder#"$root/"}" cmake --build "$folder" "$@"
  fi
}
