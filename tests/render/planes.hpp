#pragma once

#include <cstddef>
#include <vector>

#include "wedge/shared/planes.h"

namespace wedge::test {

/// Arrays in planes, on the host.
struct Planes {
    int width, height;
    std::vector<float> values;

    Planes(int w, int h, int count)
        : width(w), height(h), values(2 * WEDGE_PLANE_MARGIN + std::size_t(count) * size()) {}
    std::size_t size() const { return std::size_t(WEDGE_PLANE_PITCH(width)) * height; }
    float& at(int plane, int x, int y) {
        return values[WEDGE_PLANE_MARGIN + plane * size() + y * WEDGE_PLANE_PITCH(width) + x];
    }
};

}  // namespace wedge::test
