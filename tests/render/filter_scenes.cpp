#include "filter_scenes.hpp"

#include <cmath>

namespace wedge::test {

Scene make_penumbra(LightProfile profile) {
    Scene scene = make_scene({make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0),
                              make_quad({-0.5f, 1, -0.5f}, {0, 0, 1}, {1, 0, 0}, 0)},
                             {lambert(0.7f)});
    scene.film = {64, 48};
    scene.camera = {.position = {0, 2.5f, 5}, .target = {0, 0, 0}, .vertical_fov_rad = 0.7f};
    scene.rect_lights = {{.center = {0.3f, 3, 0},
                          .edge_u = {1, 0, 0},
                          .edge_v = {0, 0, 1},
                          .radiance = Vec3(8),
                          .profile = profile,
                          .sigma = 0.3f}};
    return scene;
}

void look_down_aslant(Scene& scene) {
    scene.film = {32, 32};
    scene.camera = {.position = {0, 8, 0},
                    .target = {0, 0, 0},
                    .up = {0.4f, 0, 1},
                    .vertical_fov_rad = 2 * std::atan(0.97f / 8)};
    scene.rect_lights = {{.center = {0, 10, 0},
                          .edge_u = {3, 0, 0},
                          .edge_v = {0, 0, 3},
                          .radiance = Vec3(20),
                          .profile = LightProfile::uniform}};
}

RenderOptions filtered(float mu, uint32_t seed) {
    RenderOptions options;
    options.bounces = 0;
    options.method = Method::aaf;
    options.mu = mu;
    options.seed = seed;
    return options;
}

double rmse_of(const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(x[i] - y[i], 2);
    return std::sqrt(sum / double(x.size()));
}

double channel_rmse(const Image& a, const Image& b, const char* channel) {
    return rmse_of(channel_values(a, channel), channel_values(b, channel));
}

double rmse(const Image& a, const Image& b) {
    return channel_rmse(a, b, "G");
}

}  // namespace wedge::test
