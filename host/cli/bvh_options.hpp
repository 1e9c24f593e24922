// Names of the choices about the tree, as options take them.
#pragma once

#include <map>
#include <string>

#include "wedge/bvh.hpp"

namespace wedge::cli {

inline const std::map<std::string, BvhLayout> kBvhLayouts = {{"auto", BvhLayout::automatic},
                                                             {"wide", BvhLayout::wide},
                                                             {"compressed", BvhLayout::compressed},
                                                             {"binary", BvhLayout::binary}};

inline const std::map<std::string, BvhQuality> kBvhQualities = {{"medium", BvhQuality::medium},
                                                                {"high", BvhQuality::high}};

}  // namespace wedge::cli
