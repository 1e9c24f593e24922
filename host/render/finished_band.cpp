#include "host/render/finished_band.hpp"

#include <fmt/format.h>

#include <span>

#include "host/render/error_estimate.hpp"
#include "host/render/film_image.hpp"
#include "host/render/filter_layers.hpp"
#include "host/render/filtered_run.hpp"
#include "host/render/told_error.hpp"
#include "wedge/log.hpp"

namespace wedge::rendering {
namespace {

void count_film(const std::vector<shared::FilmPixel>& film, const Rect& crop, uint64_t seed,
                RenderStats& stats) {
    constexpr std::size_t kNamed = 4;
    std::vector<std::string> places;
    uint64_t dropped = 0;
    for (std::size_t i = 0; i < film.size(); ++i) {
        const shared::FilmPixel& p = film[i];
        stats.samples += uint64_t(p.direct.w) + uint64_t(p.square.w);
        stats.rays += uint64_t(p.indirect.w);
        dropped += uint64_t(p.square.w);
        if (p.square.w > 0 && places.size() < kNamed)
            places.push_back(
                fmt::format("{},{}", crop.x + int(i % crop.width), crop.y + int(i / crop.width)));
    }
    stats.non_finite_samples += dropped;
    if (dropped > 0)
        log_warning(
            fmt::format("{} samples were not finite and have been dropped, first at pixel {}, seed "
                        "{}; look at one with --pixel X,Y",
                        dropped, fmt::join(places, " and "), seed));
}

/// Of values by pixel of what is rendered, those that are kept.
template <typename T>
std::span<const T> kept_of(const std::vector<T>& pixels, const Band& band) {
    const auto width = std::size_t(band.rendered.width);
    return std::span(pixels).subspan(std::size_t(band.kept.y - band.rendered.y) * width,
                                     std::size_t(band.kept.height) * width);
}

std::vector<NamedChannel> kept_layers(std::vector<NamedChannel> layers, const Band& band) {
    for (NamedChannel& layer : layers) {
        const auto kept = kept_of(layer.second, band);
        layer.second = std::vector<float>(kept.begin(), kept.end());
    }
    return layers;
}

void add_estimate(const EstimatedError& band, double pixels, double pixels_before,
                  RenderStats& stats) {
    std::optional<EstimatedError>& all = stats.estimated_error;
    all = all ? joined(*all, pixels_before, band, pixels) : band;
}

}  // namespace

void finish_band(PathTracer& tracer, const RenderOptions& options, const Band& band,
                 const FilteredLight& filtered, bool complete, uint64_t pixels_before,
                 Frame& frame) {
    std::vector<shared::FilmPixel> film = tracer.read_film();
    count_film(film, band.rendered, options.seed, frame.stats);
    // Variances, too, are of what was sampled.
    write_film(kept_of(film, band), band.kept, frame.image);
    if (filtered.guarded.empty()) return;
    const std::vector<Vec3> errors =
        told_errors(filtered.guarded, std::size_t(band.rendered.width));
    const auto layers = kept_layers(filter_layers(filtered, film, errors), band);
    replace_unfiltered(film, filtered);
    const auto kept = kept_of(film, band);
    if (complete)
        add_estimate(estimate_of_filtered(kept, kept_of(errors, band)), double(kept.size()),
                     double(pixels_before), frame.stats);
    write_light(kept, band.kept, frame.image);
    add_channels(frame.image, layers, band.kept);
}

}  // namespace wedge::rendering
