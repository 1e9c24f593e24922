// The sections of the report, as HTML.
#pragma once

#include <string>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

// Of the whole: report_summary.cpp.
std::string headline(const Config& config, const Analysis& analysis);
std::string summary_section(const Analysis& analysis);
std::string how_section(const Config& config, const Analysis& analysis);

// Of one scene: report_scene.cpp.
std::string charts_section(const SceneAnalysis& scene);
std::string comparison_section(const SceneAnalysis& scene);
std::string pictures_section(const SceneAnalysis& scene);
std::string bias_section(const SceneAnalysis& scene);
std::string raw_section(const SceneAnalysis& scene);

/// Empty where no other renderer was asked: report_peers.cpp.
std::string peers_section(const SceneAnalysis& scene);

// What time goes into: report_costs.cpp.
std::string costs_section(const SceneAnalysis& scene);

}  // namespace wedge::converge
