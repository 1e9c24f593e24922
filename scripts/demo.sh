#!/usr/bin/env bash
# Renders the default scene, from nothing: installs what is missing, builds, renders.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages "${build_packages[@]}"
configure
build_targets wedge_program

say "Rendering scenes/demo.json"
mkdir -p "$root/out"
"$build/wedge" render "$root/scenes/demo.json" \
    -o "$root/out/demo.png" -o "$root/out/demo.exr" "$@"
say "The image is in out/demo.png, to look at, and in out/demo.exr, with every layer:"
ls -l "$root/out/demo.png" "$root/out/demo.exr"
