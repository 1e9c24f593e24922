// Four light rays a sample, where paths end at their first hit.
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

TEST_CASE("more_light_rays_tell_more_of_light") {
    // Beyond 1 / sqrt(4), since all are of one sequence.
    const Scene often = make_penumbra(LightProfile::uniform), once = with_one_light_ray(often);
    for (Sampler sampler : {Sampler::sobol, Sampler::lattice, Sampler::stratified, Sampler::hash}) {
        const double limit = sampler == Sampler::hash ? 0.6 : 0.55;
        CAPTURE(std::string(to_string(sampler)));
        CHECK(error_of_light(often, quick(16, 0, sampler)) <
              limit * error_of_light(once, quick(16, 0, sampler)));
    }
    RenderOptions same = filtered(1);
    same.adaptive = false;
    same.samples_per_pixel = 16;
    same.filter = FilterMode::none;
    CHECK(error_of_light(often, same) < 0.65 * error_of_light(once, same));
}

// Four times the rays have a quarter of the variance; numbers of samples go with its power 0.4.
TEST_CASE("with_more_light_rays_fewer_samples_do") {
    const Scene scene = make_penumbra(LightProfile::gaussian);
    const auto samples = [](const Scene& s) {
        return channel_values(render(s, filtered(0.5f)).image, "spp");
    };
    const auto often = samples(scene), once = samples(with_one_light_ray(scene));
    double sum_often = 0, sum_once = 0;
    for (std::size_t i = 0; i < once.size(); ++i) {
        if (once[i] < 32 || once[i] > 64) continue;  // not what they have at least or at most
        sum_often += often[i];
        sum_once += once[i];
    }
    REQUIRE(sum_once > 0);
    const double ratio = sum_often / sum_once;
    CAPTURE(ratio);
    CHECK(ratio > 0.5);
    CHECK(ratio < 0.72);
}

}  // namespace
}  // namespace wedge::test
