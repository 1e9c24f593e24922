#include "host/scene/settings.hpp"

#include <fmt/format.h>

namespace wedge::scene {
namespace {

constexpr int kMostSamples = 1 << 24;
constexpr int kMostBounces = 1000;
constexpr double kMostStops = 100;

/// Sine of the angle below which `up` gives no direction to the image.
constexpr double kParallel = 1e-5;

}  // namespace

Camera read_camera(const JsonView& view) {
    view.allow_only({"position", "target", "up", "vertical_fov_deg"});
    Camera camera;
    camera.position = view.require("position").vec3();
    camera.target = view.require("target").vec3();
    const auto up = view.find("up");
    if (up) camera.up = up->vec3();
    if (const auto fov = view.find("vertical_fov_deg"))
        camera.vertical_fov_rad = glm::radians(fov->number({0, 180, true}));
    // 179.999999 degrees rounds to pi.
    if (!(camera.vertical_fov_rad < kPi)) view.fail("\"vertical_fov_deg\" is too close to 180");

    if (camera.position == camera.target)
        view.fail("\"position\" and \"target\" are the same point; the view has no direction");
    const glm::dvec3 ahead =
        glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
    const double up_length = glm::length(glm::dvec3(camera.up));
    if (!(up_length > 0)) up->fail("must not be zero");
    if (!(glm::length(glm::cross(ahead, glm::dvec3(camera.up) / up_length)) > kParallel))
        view.fail("\"up\" is parallel to the view; choose another");
    return camera;
}

Film read_film(const JsonView& view) {
    view.allow_only({"width", "height"});
    Film film;
    film.width = view.require("width").integer(1, kLargestSide_px);
    film.height = view.require("height").integer(1, kLargestSide_px);
    if ((long long)(film.width) * film.height > kMostPixels)
        view.fail(
            fmt::format("{} x {} are more than {} pixels", film.width, film.height, kMostPixels));
    return film;
}

RenderDefaults read_render_defaults(const JsonView& view) {
    view.allow_only({"spp", "bounces", "exposure"});
    RenderDefaults defaults;
    if (const auto spp = view.find("spp"))
        defaults.samples_per_pixel = spp->integer(1, kMostSamples);
    if (const auto bounces = view.find("bounces"))
        defaults.bounces = bounces->integer(0, kMostBounces);
    if (const auto exposure = view.find("exposure"))
        defaults.exposure = exposure->number({-kMostStops, kMostStops});
    return defaults;
}

}  // namespace wedge::scene
