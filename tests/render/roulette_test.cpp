// Paths that carry little end by chance: the same light from fewer rays.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "statistics.hpp"
#include "test_scenes.hpp"

namespace wedge::test {
namespace {

/// A dark room whose surfaces are half matt, half lobe. What decides whether a path goes on is the
/// channel that it carries most of: where red, which is matt, is reflected in full, all go on, and
/// green and blue are what they are in the grey room.
Scene make_dark_room(bool red) {
    const float albedo = 0.3f;
    Scene scene = make_room(0);
    for (Material& m : scene.materials) {
        m.diffuse = m.specular = Vec3(0.5f * albedo);
        if (red) m.diffuse.x = 1 - 0.5f * albedo;
        m.exponent = 20;
        m.model = SpecularModel::blinn_phong;
    }
    return scene;
}

double rays_per_sample(const Frame& frame) {
    return double(frame.stats.rays) / double(frame.stats.samples);
}

TEST_CASE("paths_that_end_by_chance_tell_the_same_light") {
    const Scene grey = make_dark_room(false), red = make_dark_room(true);
    for (int bounces : {2, 5}) {
        CAPTURE(bounces);
        const RenderOptions options = quick(512, bounces, Sampler::hash);
        const Frame some = render(grey, options), all = render(red, options);
        const std::vector<double> a = channel_values(some.image, "indirect.G"),
                                  b = channel_values(all.image, "indirect.G");
        std::vector<double> difference(a.size());
        for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
        const MeanAndError off = mean_and_error(difference);
        const double mean = channel_mean(all.image, "indirect.G");
        INFO(fmt::format("{} +- {} of {}; rays {}, {}", off.mean, off.standard_error, mean,
                         rays_per_sample(some), rays_per_sample(all)));
        CHECK(std::abs(off.mean) < 4 * off.standard_error);
        CHECK(off.standard_error < 0.004 * mean);
        CHECK(rays_per_sample(some) < (bounces == 2 ? 0.9 : 0.5) * rays_per_sample(all));
    }
}

}  // namespace
}  // namespace wedge::test
