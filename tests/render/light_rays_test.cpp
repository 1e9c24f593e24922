// Two light rays a sample, where paths end at their first hit.
#include <doctest/doctest.h>

#include <string>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

/// The same light, but for a background too dark to be seen: there paths go on to look for it, and
/// samples have one light ray.
Scene with_one_light_ray(Scene scene) {
    scene.background = Vec3(1e-12f);
    return scene;
}

double error_of_light(const Scene& scene, const RenderOptions& options) {
    const Image truth = render(scene, quick(4096, 0, Sampler::lattice, 9)).image;
    return channel_rmse(render(scene, options).image, truth, "direct.G");
}

TEST_CASE("a_second_light_ray_tells_more_of_light") {
    // Beyond 1 / sqrt(2), since both are of one sequence.
    const Scene twice = make_penumbra(LightProfile::uniform), once = with_one_light_ray(twice);
    for (Sampler sampler : {Sampler::sobol, Sampler::lattice, Sampler::stratified, Sampler::hash}) {
        const double limit = sampler == Sampler::hash ? 0.8 : 0.75;
        CAPTURE(std::string(to_string(sampler)));
        CHECK(error_of_light(twice, quick(16, 0, sampler)) <
              limit * error_of_light(once, quick(16, 0, sampler)));
    }
    RenderOptions same = filtered(1);
    same.adaptive = false;
    same.samples_per_pixel = 16;
    same.filter = FilterMode::none;
    CHECK(error_of_light(twice, same) < 0.85 * error_of_light(once, same));
}

// Twice the rays have half of the variance, and numbers of samples go with its root.
TEST_CASE("with_a_second_light_ray_fewer_samples_do") {
    const Scene scene = make_penumbra(LightProfile::gaussian);
    const auto samples = [](const Scene& s) {
        return channel_values(render(s, filtered(1)).image, "spp");
    };
    const auto twice = samples(scene), once = samples(with_one_light_ray(scene));
    double sum_twice = 0, sum_once = 0;
    for (std::size_t i = 0; i < once.size(); ++i) {
        if (once[i] < 32 || once[i] > 64) continue;  // not what they have at least or at most
        sum_twice += twice[i];
        sum_once += once[i];
    }
    REQUIRE(sum_once > 0);
    const double ratio = sum_twice / sum_once;
    CAPTURE(ratio);
    CHECK(ratio > 0.6);
    CHECK(ratio < 0.85);
}

}  // namespace
}  // namespace wedge::test
