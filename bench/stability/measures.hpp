// The measures that recipes are judged by.
#pragma once

#include "bench/converge/analysis.hpp"
#include "bench/stability/suite.hpp"

namespace wedge::stability {

/// True for measures that are compared with the yardstick's at equal time.
bool is_ratio(Measure measure);

/// Of the runs at one budget; not yet divided by the yardstick's where that is to be done.
double measure(const Rule& rule, const converge::Rung& rung, const converge::Reference& reference);

/// Over pixels and R, G, B.
double mean_of(const Image& rgb);

}  // namespace wedge::stability
