#!/usr/bin/env bash
# Runs every test, from nothing: installs what is missing, builds, tests. Arguments go to ctest. Without
# any, ray rates are measured briefly too and left in build/release/artefacts/bench_trace.json: numbers to
# compare runs by. No test depends on them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${build_packages[@]}" "${check_packages[@]}"
configure
build_targets

say "Running the tests"
cd "$build"
[[ $# -gt 0 ]] && exec ctest --output-on-failure "$@"
ctest --output-on-failure

say "Measuring ray rates"
mkdir -p artefacts
./wedge bench trace --size 256 --repeats 5 --json artefacts/bench_trace.json ||
    say "Ray rates could not be measured; that fails nothing"
