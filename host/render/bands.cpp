#include "host/render/bands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wedge/error.hpp"
#include "wedge/shared/frame.h"

namespace wedge::rendering {
namespace {

void check_options(const Rect& crop, const RenderOptions& options) {
    const auto refuse = [&](const char* what) {
        throw Error(
            ErrorKind::usage,
            fmt::format("a film of {}x{} px does not fit the device at once and is rendered "
                        "in bands, {}; render it with --crop in parts, or a smaller one",
                        crop.width, crop.height, what));
    };
    if (options.method != Method::mc) refuse("which only --method mc can");
    if (!options.resume_file.empty()) refuse("which cannot be resumed");
    if (options.time_limit_s) refuse("which cannot end at a time");
    if (options.target_error) refuse("which cannot end at an error");
}

}  // namespace

std::vector<Rect> cut_into_bands(const Rect& crop, const RenderOptions& options,
                                 const DeviceInfo& device) {
    // Scene and film share the memory: half of it, and never more than a buffer may have.
    uint64_t limit = std::min(device.largest_buffer_bytes, device.memory_bytes / 2);
    if (options.film_bytes > 0) limit = std::min(limit, options.film_bytes);
    const uint64_t row_bytes = uint64_t(crop.width) * sizeof(shared::FilmPixel);
    const uint64_t rows = std::clamp<uint64_t>(limit / row_bytes, 1, uint64_t(crop.height));
    const auto count = int((uint64_t(crop.height) + rows - 1) / rows);
    if (count > 1) check_options(crop, options);

    std::vector<Rect> bands;
    for (int i = 0; i < count; ++i) {
        const auto row = [&](int band) { return int(int64_t(crop.height) * band / count); };
        bands.push_back({crop.x, crop.y + row(i), crop.width, row(i + 1) - row(i)});
    }
    return bands;
}

}  // namespace wedge::rendering
