#!/usr/bin/env bash
# Runs every test, from nothing: installs what is missing, builds, tests. Arguments go to ctest.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${build_packages[@]}" "${check_packages[@]}"
configure
build_targets

say "Running the tests"
cd "$build"
exec ctest --output-on-failure "$@"
