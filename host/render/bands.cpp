#include "host/render/bands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/render/filter_settings.hpp"
#include "host/render/signal_filter.hpp"
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
    if (!options.resume_file.empty()) refuse("which cannot be resumed");
    if (options.time_limit_s) refuse("which cannot end at a time");
    if (options.target_error) refuse("which cannot end at an error");
}

/// That the device renders at once. Film and filters share its memory with the scene, and rows of
/// planes may be a little longer than the film's.
uint64_t pixels_at_once(const RenderOptions& options, const DeviceInfo& device,
                        const BandNeeds& needs) {
    const uint64_t buffer = device.largest_buffer_bytes / 64 * 63;
    uint64_t memory = device.memory_bytes / 4 * uint64_t(needs.memory_quarters);
    if (options.film_bytes > 0) memory = std::min(memory, options.film_bytes);
    return std::min(memory / needs.pixel_bytes, buffer / needs.buffer_bytes);
}

}  // namespace

BandNeeds band_needs(const Plan& plan, const Film& film) {
    BandNeeds needs;
    needs.pixel_bytes = needs.buffer_bytes = sizeof(shared::FilmPixel);
    if (plan.signals == 0) return needs;
    for (const FilterBuffer& buffer : filter_buffers(plan, 1)) {
        needs.pixel_bytes += buffer.bytes;
        needs.buffer_bytes = std::max(needs.buffer_bytes, buffer.bytes);
    }
    // The image on the host is small beside it, and a third of it is never touched on CPUs: what is
    // kept of second and third surfaces, which most pixels have not.
    needs.memory_quarters = 3;
    // The standard deviation of the widest filter. Beyond that it has little weight, and lines
    // fitted to one side are not biased (kernels/lib/line_fit.clh).
    needs.margin_px = largest_filter_radius_px(film) / 3 + WEDGE_GUARD_RADIUS;
    return needs;
}

std::vector<Band> cut_into_bands(const Rect& crop, const RenderOptions& options,
                                 const DeviceInfo& device, const BandNeeds& needs) {
    const uint64_t most = pixels_at_once(options, device, needs) / uint64_t(crop.width);
    const int rows = int(std::clamp<uint64_t>(most, 1, uint64_t(crop.height)));
    if (rows == crop.height) return {{crop, crop}};
    check_options(crop, options);

    const int margin = std::min(needs.margin_px, rows / 4), kept = rows - 2 * margin;
    const int count = (crop.height + kept - 1) / kept;
    std::vector<Band> bands;
    for (int i = 0; i < count; ++i) {
        const auto row = [&](int band) { return int(int64_t(crop.height) * band / count); };
        const int first = row(i), end = row(i + 1);
        const int top = std::max(first - margin, 0), bottom = std::min(end + margin, crop.height);
        bands.push_back({{crop.x, crop.y + top, crop.width, bottom - top},
                         {crop.x, crop.y + first, crop.width, end - first}});
    }
    return bands;
}

}  // namespace wedge::rendering
