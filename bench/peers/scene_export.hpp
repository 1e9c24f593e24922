// A scene for other renderers: what Wedge itself would render, laid out in world space, in files
// that need none of Wedge's conventions to be read (docs/peers.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wedge/scene.hpp"

namespace wedge::peers {

/// Takes away what a peer has no counterpart for, so that both sides render the same: normal and
/// bump maps, and with `lambert_only` specular lobes and interpolated normals too. Returns what was
/// taken away, by name, for people; empty if nothing was.
std::vector<std::string> simplify_for_peers(Scene& scene, bool lambert_only = false);

/// Writes `folder`/scene.json, meshes/*.ply (one for each material, flat and smooth faces apart)
/// and textures/*.exr (linear, times the material's constant, in [0, that] for reflectances).
/// Creates the folder; files of an earlier export are replaced. Throws Error(output), and
/// Error(bad_input) where a texture is not read.
void export_scene(const Scene& scene, const std::filesystem::path& folder);

}  // namespace wedge::peers
