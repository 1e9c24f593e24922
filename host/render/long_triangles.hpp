// Triangles that may be narrower than pixels and cross many of them.
#pragma once

#include <cstdint>
#include <vector>

#include "host/render/flatten.hpp"

namespace wedge::rendering {

/// In ascending order, those at least four times as long as wide: parts of wires, railings, twigs,
/// or of nothing of the kind. Of small ones that make up a surface there may be millions, which are
/// left out, and with them wires whose triangles are as short as wide.
std::vector<uint32_t> find_long_triangles(const FlatScene& flat);

}  // namespace wedge::rendering
