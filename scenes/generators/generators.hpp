// Geometry made by formula: test scenes that need no files. The kinds, their parameters, defaults,
// units and ranges stand in the table that opens each kind's source file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "wedge/scene.hpp"

namespace wedge::scenes {

/// Builds one mesh of `kind`. Parameters not given have their defaults. Materials are added to
/// `materials` under names such as `grids/bars`, or used as they are if that name is there already,
/// and `Mesh::material_of` holds their indices. The same parameters give the same mesh on every
/// run; where there is chance in it, the parameter `seed` decides. y is up. Throws Error(bad_input)
/// for an unknown kind or parameter or a value out of range, and lists what is known.
Mesh generate(const std::string& kind, const std::map<std::string, double>& parameters,
              std::vector<Material>& materials);

/// Names that `generate` takes, sorted.
std::vector<std::string> generator_kinds();

}  // namespace wedge::scenes
