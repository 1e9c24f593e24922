// Pictures of all methods at about the same time, with details and errors.
#pragma once

#include <string>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

/// At the time of the yardstick's middle rung; each method's nearest rung, its true time beside it.
std::string strip_html(const SceneAnalysis& scene);

/// Bias maps of the filtered methods; empty if there is none.
std::string bias_maps_html(const SceneAnalysis& scene);

}  // namespace wedge::converge
