#include "suite.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#ifdef WEDGE_WITH_IMAGE
#include "wedge/image_io.hpp"
#endif

namespace wedge::test {
namespace {

const std::filesystem::path kRoot = WEDGE_SOURCE_DIR;

template <typename Visit>
void for_all_values(const Image& image, const Visit& visit) {
    const std::size_t stride = image.channels.size();
    for (const char* name : {"R", "G", "B"})
        for (std::size_t i = std::size_t(image.channel(name)); i < image.pixels.size(); i += stride)
            visit(i);
}

}  // namespace

Scene suite_scene(const std::string& name, int width, int height) {
    LoadOptions load;
#ifdef WEDGE_WITH_IMAGE
    load.load_texture = load_texture;
#endif
    Scene scene = load_scene(kRoot / "scenes/stability" / (name + ".json"), load);
    scene.film = {width, height};
    return scene;
}

std::vector<std::string> suite_scene_names() {
    std::ifstream in(kRoot / "bench/stability.json");
    const auto suite = nlohmann::json::parse(in, nullptr, true, true);
    std::vector<std::string> names;
    for (const auto& recipe : suite.at("recipes"))
        names.push_back(std::filesystem::path(recipe.at("scene").get<std::string>()).stem());
    return names;
}

RenderOptions filtered(FilterMode mode, float mu, int most_samples, uint64_t seed) {
    RenderOptions options;
    options.method = Method::aaf;
    options.filter = mode;
    options.mu = mu;
    options.samples_per_pixel = most_samples;
    options.seed = seed;
    return options;
}

double mean_of(const Image& image) {
    double sum = 0, count = 0;
    for_all_values(image, [&](std::size_t i) {
        sum += double(image.pixels[i]);
        count += 1;
    });
    return sum / count;
}

double rmse_between(const Image& a, const Image& b) {
    double sum = 0, count = 0;
    const std::size_t pixels = std::size_t(a.width) * a.height;
    for (const char* name : {"R", "G", "B"}) {
        const auto ca = std::size_t(a.channel(name)), cb = std::size_t(b.channel(name));
        for (std::size_t i = 0; i < pixels; ++i) {
            const double d = double(a.pixels[i * a.channels.size() + ca]) -
                             double(b.pixels[i * b.channels.size() + cb]);
            sum += d * d;
            count += 1;
        }
    }
    return std::sqrt(sum / count);
}

bool all_finite(const Image& image) {
    for (float value : image.pixels)
        if (!std::isfinite(value)) return false;
    return true;
}

}  // namespace wedge::test
