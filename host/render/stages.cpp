#include "host/render/stages.hpp"

#include <algorithm>

namespace wedge::rendering {
namespace {

/// Whether [before, end) and the stage have samples in common.
bool lacks(uint32_t before, uint32_t end, const Stage& stage) {
    return std::max(before, stage.first) < std::min(end, stage.end);
}

bool lacks_paths(const shared::SampleEnds& e, const Stage& stage) {
    return lacks(e.paths_before, e.paths, stage);
}

bool lacks_camera_rays(const shared::SampleEnds& e, const Stage& stage) {
    return lacks(std::max(e.camera_rays_before, e.paths), e.camera_rays, stage);
}

}  // namespace

std::vector<Stage> cut_into_stages(std::span<const shared::SampleEnds> ends, uint32_t done) {
    uint32_t last = 0;
    for (const shared::SampleEnds& e : ends) last = std::max({last, e.paths, e.camera_rays});
    std::vector<Stage> stages;
    for (uint32_t first = done; first < last; first *= 2) {
        Stage stage{first, std::min(2 * first, last), {}};
        for (uint32_t i = 0; i < ends.size(); ++i)
            if (lacks_paths(ends[i], stage)) stage.pixels.push_back(i);
        for (uint32_t i = 0; i < ends.size(); ++i)
            if (!lacks_paths(ends[i], stage) && lacks_camera_rays(ends[i], stage))
                stage.pixels.push_back(i);
        if (!stage.pixels.empty()) stages.push_back(std::move(stage));
    }
    return stages;
}

}  // namespace wedge::rendering
