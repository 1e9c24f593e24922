// Where triangles narrower than pixels are on the film, against lines drawn in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "filter_kernels.hpp"
#include "host/device/program.hpp"
#include "host/render/camera.hpp"
#include "host/render/long_triangles.hpp"
#include "wedge/render.hpp"
#include "wedge/shared/frame.h"

namespace wedge::test {
namespace {

using glm::dvec3;

struct Sliver {
    Vec3 p, q, r;
};

/// Between random places around the eye, before and behind it. Of every other one an end is near
/// the view's axis, where the sliver is wider than pixels.
std::vector<Sliver> random_slivers(int count, const Camera& camera) {
    std::mt19937 random{7};
    std::uniform_real_distribution<float> place(-10, 10), width(1e-4f, 0.3f), near_by(0.2f, 0.6f);
    std::vector<Sliver> slivers;
    for (int i = 0; i < count; ++i) {
        Vec3 p(place(random), place(random), place(random));
        const Vec3 q(place(random), place(random), place(random));
        if (i % 2 > 0) p = glm::mix(camera.position, camera.target, near_by(random));
        const Vec3 across = glm::normalize(glm::cross(q - p, Vec3(0.3f, 1, 0.2f)));
        slivers.push_back({p, q, p + width(random) * across});
    }
    return slivers;
}

/// By pixel: the most that it has of a side, px; the greatest of one over the depth of a side that
/// is in it, or within rounding of it.
struct Drawing {
    int width, height;
    std::vector<double> length_px, nearness;

    Drawing(int w, int h) : width(w), height(h), length_px(w * h), nearness(w * h) {}

    void come_near(double x, double y, double depth) {
        if (!(x >= 0 && y >= 0 && x < width && y < height)) return;
        double& n = nearness[std::size_t(y) * width + std::size_t(x)];
        n = std::max(n, 1 / depth);
    }
};

/// The camera by its angles alone.
struct Eye {
    dvec3 position, forward, right, down;
    double pixel;  ///< world length of one at depth 1

    Eye(const Camera& camera, const Film& film) {
        position = dvec3(camera.position);
        forward = glm::normalize(dvec3(camera.target) - position);
        right = glm::normalize(glm::cross(forward, dvec3(camera.up)));
        down = glm::cross(forward, right);
        pixel = 2 * std::tan(double(camera.vertical_fov_rad) / 2) / film.height;
    }
};

/// Of parts of a side beyond the depth where the triangle is `share` of a pixel wide.
void draw_side(Drawing& drawing, const Eye& eye, const Rect& crop, const Film& film, dvec3 a,
               dvec3 b, double width, double share) {
    constexpr int kSteps = 40000;
    constexpr double kRounding_px = 0.01;
    double x_before = 0, y_before = 0, length_px = 0;
    std::size_t before = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const dvec3 d = a + (b - a) * (double(i) / kSteps) - eye.position;
        const double depth = glm::dot(d, eye.forward);
        if (!(depth > 1e-9) || width >= share * eye.pixel * depth) continue;
        const double x = glm::dot(d, eye.right) / depth / eye.pixel + film.width / 2.0 - crop.x;
        const double y = glm::dot(d, eye.down) / depth / eye.pixel + film.height / 2.0 - crop.y;
        const double step = std::hypot(x - x_before, y - y_before);
        x_before = x, y_before = y;
        for (const double e : {-kRounding_px, kRounding_px}) {
            drawing.come_near(x + e, y + e, depth);
            drawing.come_near(x + e, y - e, depth);
        }
        if (!(x >= 0 && y >= 0 && x < drawing.width && y < drawing.height)) continue;
        const std::size_t at = std::size_t(y) * drawing.width + std::size_t(x);
        length_px = at == before && step < 1 ? length_px + step : 0;
        before = at;
        drawing.length_px[at] = std::max(drawing.length_px[at], length_px);
    }
}

Drawing draw(const std::vector<Sliver>& slivers, const Camera& camera, const Film& film,
             const Rect& crop, double share) {
    Drawing drawing(crop.width, crop.height);
    const Eye eye(camera, film);
    for (const Sliver& s : slivers) {
        const dvec3 p(s.p), q(s.q), r(s.r);
        const double longest =
            std::max({glm::length(q - p), glm::length(r - q), glm::length(p - r)});
        const double width = glm::length(glm::cross(q - p, r - p)) / longest;
        draw_side(drawing, eye, crop, film, p, q, width, share);
        draw_side(drawing, eye, crop, film, q, r, width, share);
        draw_side(drawing, eye, crop, film, r, p, width, share);
    }
    return drawing;
}

/// The kernel's.
std::vector<float> find_nearness(const std::vector<Sliver>& slivers, const Camera& camera,
                                 const Film& film, const Rect& crop) {
    device::Device device;
    const device::ProgramRequest request{"kernels/distances.cl", {"WEDGE_SHADOW_LIGHTS=1"}};
    const auto programs = device::build_programs(device, std::span(&request, 1), WEDGE_SOURCE_DIR);
    shared::FrameParams params{};
    params.camera = rendering::make_camera_rays(camera, film);
    params.crop_x = crop.x, params.crop_y = crop.y;
    params.crop_width = crop.width, params.crop_height = crop.height;
    std::vector<shared::ShadingVertex> vertices;
    std::vector<shared::ShadingTriangle> triangles;
    std::vector<uint32_t> list;
    for (const Sliver& s : slivers) {
        const auto first = uint32_t(vertices.size());
        for (const Vec3& v : {s.p, s.q, s.r}) vertices.push_back({v.x, v.y, v.z, 0, 0, 0, 0, 0});
        list.push_back(uint32_t(triangles.size()));
        triangles.push_back({first, first + 1, first + 2, 0, -1});
    }
    std::vector<float> nearness(std::size_t(crop.width) * std::size_t(crop.height), 0.0f);
    const cl::Buffer kept[] = {upload(device, std::vector{params}), upload(device, vertices),
                               upload(device, triangles), upload(device, list),
                               upload(device, nearness)};
    cl::Kernel kernel = programs[0].kernel("filter_thin_things");
    for (cl_uint i = 0; i < 5; ++i) kernel.setArg(i, kept[i]);
    const auto half = cl_uint(list.size() / 2), end = cl_uint(list.size());
    for (const auto& [from, to] : {std::pair(cl_uint(0), half), std::pair(half, end)}) {
        kernel.setArg(5, from);
        kernel.setArg(6, to);
        device.launch(kernel, to - from + 3);
    }
    device.finish();
    device.download(kept[4], nearness.data(), nearness.size() * sizeof(float));
    return nearness;
}

TEST_CASE("pixels_that_thin_triangles_cross_are_marked") {
    Camera camera;
    camera.position = {0.5f, -0.3f, 1};
    camera.target = {4, 1, -3};
    camera.vertical_fov_rad = 1;
    const Film film{97, 61};
    const std::vector<Sliver> slivers = random_slivers(60, camera);
    for (const Rect& crop : {Rect{0, 0, 97, 61}, Rect{20, 30, 40, 7}}) {
        CAPTURE(crop.x);
        // Where rounding decides, either will do.
        const Drawing surely = draw(slivers, camera, film, crop, 0.99);
        const Drawing perhaps = draw(slivers, camera, film, crop, 1.01);
        const std::vector<float> found = find_nearness(slivers, camera, film, crop);
        int marked = 0, missed = 0, wrong = 0, far_off = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const bool is_marked = found[i] > 0, is_crossed = surely.length_px[i] > 0.4;
            marked += is_marked;
            missed += !is_marked && is_crossed;
            wrong += is_marked && !(perhaps.nearness[i] > 0);
            if (is_marked && is_crossed)
                far_off += double(found[i]) > 1.01 * perhaps.nearness[i] ||
                           double(found[i]) < 0.9 * surely.nearness[i];
        }
        CHECK(marked > 20);
        CHECK(missed == 0);
        CHECK(wrong == 0);
        CHECK(far_off == 0);
    }
}

/// Looks along -z from the origin; a pixel is `pixel` wide at depth 1.
Camera look_ahead(const Film& film, float pixel) {
    Camera camera;
    camera.position = {0, 0, 0};
    camera.target = {0, 0, -1};
    camera.up = {0, 1, 0};
    camera.vertical_fov_rad = 2 * std::atan(0.5f * pixel * float(film.height));
    return camera;
}

int count_marked(const std::vector<float>& nearness) {
    CHECK(std::all_of(nearness.begin(), nearness.end(),
                      [](float n) { return std::isfinite(n) && !std::signbit(n); }));
    return int(std::count_if(nearness.begin(), nearness.end(), [](float n) { return n > 0; }));
}

// From before the eye to behind it, where rounding may put ends anywhere.
TEST_CASE("thin_triangles_that_pass_the_eye_are_marked_before_it") {
    const Film film{64, 48};
    const Camera camera = look_ahead(film, 0.01f);
    for (const float size : {1e-3f, 1.0f, 1e3f, 1e6f})
        for (const float width : {1e-10f, 1e-7f, 1e-4f}) {
            CAPTURE(size);
            CAPTURE(width);
            // The far end in the film's middle; the near one leaves it above.
            const Vec3 far_end(0, 0, -size), near_end(0, 0.3f * size, size);
            const Sliver sliver{far_end, near_end, far_end + Vec3(width * size, 0, 0)};
            const auto nearness = find_nearness({sliver}, camera, film, {0, 0, 64, 48});
            CHECK(count_marked(nearness) >= 24);
            CHECK(count_marked(nearness) <= 2 * 24 + 4);
        }
}

TEST_CASE("triangles_shorter_than_a_pixel_are_not_marked") {
    const Film film{64, 48};
    const Camera camera = look_ahead(film, 0.01f);
    const auto marked = [&](float length_px) {
        const Vec3 p(0.002f, 0.002f, -1), along(0.01f * length_px, 0, 0);
        const Sliver sliver{p, p + along, p + 0.5f * along + Vec3(0, 1e-4f, 0)};
        return count_marked(find_nearness({sliver, sliver}, camera, film, {0, 0, 64, 48}));
    };
    CHECK(marked(0.7f) == 0);
    CHECK(marked(3) >= 3);
}

TEST_CASE("long_triangles_are_those_four_times_as_long_as_wide") {
    rendering::FlatScene flat;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
        const auto first = uint32_t(flat.positions.size());
        flat.positions.insert(flat.positions.end(), {p, q, r});
        flat.triangles.push_back({first, first + 1, first + 2});
    };
    add({0, 0, 0}, {1, 0, 0}, {0.5f, 0.3f, 0});    // 3.3 times
    add({0, 0, 0}, {1, 0, 0}, {0.5f, 0.2f, 0});    // five times
    add({0, 0, 0}, {1, 0, 0}, {2, 0, 0});          // no width
    add({0, 0, 0}, {1, 0, 0}, {nan, 0.01f, 0});    // nowhere
    add({0, 0, 0}, {0, 0, 7}, {1e-3f, 0, 0});      // 7000 times
    add({0, 0, 0}, {1e-9f, 0, 0}, {0, 1e-9f, 0});  // small
    add({0, 0, 0}, {1e-15f, 0, 0}, {0, 1e-18f, 0});
    add({0, 0, 0}, {1e15f, 0, 0}, {0, 1e12f, 0});
    CHECK(rendering::find_long_triangles(flat) == std::vector<uint32_t>{1, 4, 6, 7});
}

}  // namespace
}  // namespace wedge::test
