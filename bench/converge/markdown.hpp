// The summary as Markdown, for documentation.
#pragma once

#include <string>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

std::string markdown_tables(const Config& config, const Analysis& analysis);

}  // namespace wedge::converge
