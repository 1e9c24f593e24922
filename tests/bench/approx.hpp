// Comparison by relative difference: doctest's Approx adds 1 to the scale, in which small errors
// would drown.
#pragma once

#include <doctest/doctest.h>

namespace wedge::test {

inline doctest::Approx close_to(double value, double relative) {
    return doctest::Approx(value).epsilon(relative).scale(0);
}

}  // namespace wedge::test
