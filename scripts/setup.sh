# Shared by demo.sh and check.sh: from a bare Debian 12 to a release build. To be sourced.
#
# WEDGE_SKIP_PACKAGES=1 leaves packages alone, for systems where the same things are installed under
# other names.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$root/build/release"

build_packages=(
    g++ cmake ninja-build
    pocl-opencl-icd ocl-icd-opencl-dev opencl-clhpp-headers
    libglm-dev libfmt-dev nlohmann-json3-dev libtinyobjloader-dev libcli11-dev libtbb-dev
    # The tools because the CMake package of the library names them and fails without.
    libopenimageio-dev openimageio-tools
    # One configuration for both scripts, so that neither makes the other build again.
    doctest-dev
)
check_packages=(oclgrind)

say() { printf '%s\n' "-- $*"; }

fail() {
    printf '%s\n' "error: $1" >&2
    shift
    for line in "$@"; do printf '%s\n' "       $line" >&2; done
    exit 1
}

# Prints those of its arguments that are not installed.
missing_packages() {
    local package state
    for package in "$@"; do
        state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
        # Where several architectures are installed, the states stand side by side.
        [[ $state == installed* ]] || printf '%s\n' "$package"
    done
}

# Runs a command as root: as it is, or through sudo.
as_root() {
    if [[ $(id -u) -eq 0 ]]; then "$@"; else sudo "$@"; fi
}

install_packages() {
    [[ ${WEDGE_SKIP_PACKAGES:-} == 1 ]] && return 0
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        fail "this is not a Debian system, so nothing can be installed for you" \
            "Install what these Debian packages hold: $*" \
            "Then run this again with WEDGE_SKIP_PACKAGES=1 in the environment."
    fi
    local missing
    mapfile -t missing < <(missing_packages "$@")
    [[ ${#missing[@]} -eq 0 ]] && return 0

    say "Missing packages: ${missing[*]}"
    if [[ $(id -u) -ne 0 ]] && ! command -v sudo >/dev/null; then
        fail "installing packages needs root, and there is no sudo here" \
            "Run as root: apt-get install --no-install-recommends ${missing[*]}"
    fi
    say "Installing them (apt-get)"
    as_root apt-get update -q ||
        fail "apt-get update failed" "Is the network there, and no other apt-get running?"
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -q -y --no-install-recommends "${missing[@]}" ||
        fail "apt-get could not install ${missing[*]}" \
            "Debian 12 (bookworm) has them all; older releases do not."
}

# Once there is a build folder, the build itself configures again where it has to.
configure() {
    [[ -f $build/build.ninja ]] && return 0
    say "Configuring build/release"
    (cd "$root" && cmake --preset release) || fail "CMake could not configure the build (see above)"
}

# Arguments: targets; none: everything.
build_targets() {
    local targets=()
    [[ $# -gt 0 ]] && targets=(--target "$@")
    say "Building build/release"
    cmake --build "$build" "${targets[@]}" || fail "the build failed (see above)"
}
