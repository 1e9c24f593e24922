#include "host/render/stages.hpp"

#include <algorithm>

namespace wedge::rendering {

std::vector<Stage> cut_into_stages(std::span<const SampleEnds> ends, uint32_t done) {
    uint32_t last = 0;
    for (const SampleEnds& e : ends) last = std::max({last, e.paths, e.camera_rays});
    std::vector<Stage> stages;
    for (uint32_t first = done; first < last; first *= 2) {
        Stage stage{first, std::min(2 * first, last), {}};
        for (uint32_t i = 0; i < ends.size(); ++i)
            if (ends[i].paths > first) stage.pixels.push_back(i);
        for (uint32_t i = 0; i < ends.size(); ++i)
            if (ends[i].paths <= first && ends[i].camera_rays > first) stage.pixels.push_back(i);
        stages.push_back(std::move(stage));
    }
    return stages;
}

}  // namespace wedge::rendering
