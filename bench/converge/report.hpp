// The report: one HTML file that needs nothing else, neither network nor scripts.
#pragma once

#include <string>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

/// Well-formed: every element is closed, as in XML. `section`: HTML that comes before all others.
std::string report_html(const Config& config, const Analysis& analysis,
                        const std::string& section = "");

}  // namespace wedge::converge
