// Films in bands: the same bits as at once, or as good an image where it is filtered.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "filter_scenes.hpp"
#include "host/render/bands.hpp"
#include "host/render/error_estimate.hpp"
#include "test_scenes.hpp"
#include "wedge/error.hpp"
#include "wedge/shared/frame.h"

namespace wedge::test {
namespace {

constexpr uint64_t kPixel = sizeof(shared::FilmPixel);

/// Larger than any filter of a film of this size needs as a margin.
Scene large_room() {
    Scene scene = make_room(20);
    scene.film = {64, 96};
    return scene;
}

/// Filtered, in bands of at most so many rows, of which a half may be margins; 0: at once.
RenderOptions filtered_in_bands(const Scene& scene, int bounces, int rows) {
    RenderOptions options;
    options.method = Method::aaf;
    options.bounces = bounces;
    const rendering::Plan plan = rendering::make_plan(scene, options.method, bounces);
    const uint64_t pixel = rendering::band_needs(plan, scene.film).pixel_bytes;
    options.film_bytes = uint64_t(rows) * uint64_t(scene.film.width) * pixel;
    return options;
}

float value(const Image& image, const std::string& name, int x, int y) {
    const auto pixel = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
    return image.pixels[pixel * image.channels.size() + std::size_t(image.channel(name))];
}

}  // namespace

TEST_CASE("bands_cover_the_crop_once_and_fit") {
    DeviceInfo device;
    device.largest_buffer_bytes = 1 << 30;
    device.memory_bytes = uint64_t(4) << 30;
    for (const Rect crop : {Rect{0, 0, 8192, 8192}, Rect{5, 7, 100, 1}, Rect{3, 2, 33, 101}})
        for (uint64_t limit : {uint64_t(0), 40 * kPixel, 1000 * kPixel, 1'000'000 * kPixel}) {
            RenderOptions options;
            options.film_bytes = limit;
            int y = crop.y;
            rendering::BandNeeds needs;
            needs.pixel_bytes = needs.buffer_bytes = kPixel;
            for (const auto& [band, kept] :
                 rendering::cut_into_bands(crop, options, device, needs)) {
                CHECK(kept.y == band.y);
                CHECK(kept.height == band.height);
                CHECK(band.x == crop.x);
                CHECK(band.width == crop.width);
                CHECK(band.y == y);
                CHECK(band.height > 0);
                const uint64_t bytes = uint64_t(band.width) * uint64_t(band.height) * kPixel;
                CHECK(bytes <= device.largest_buffer_bytes);
                if (limit > 0 && band.height > 1) CHECK(bytes <= limit);
                y += band.height;
            }
            CHECK(y == crop.y + crop.height);
        }
}

TEST_CASE("a_film_in_bands_has_the_bits_of_the_whole") {
    Scene scene = make_room(20);
    scene.film = {33, 29};
    for (const std::optional<Rect> crop :
         {std::optional<Rect>(), std::optional<Rect>({4, 3, 20, 19})}) {
        RenderOptions options = quick(8, 2);
        options.crop = crop;
        const Frame whole = render(scene, options);
        uint64_t most = 0;
        for (int rows : {1, 4, 10}) {
            options.film_bytes = uint64_t(rows) * 33 * kPixel;
            options.on_progress = [&](const Progress& p) { most = p.samples_done; };
            const Frame banded = render(scene, options);
            CHECK(banded.image.pixels == whole.image.pixels);
            CHECK(banded.stats.samples == whole.stats.samples);
            CHECK(banded.stats.rays == whole.stats.rays);
            CHECK(banded.stats.passes.size() == 1);
            CHECK(most == whole.stats.samples);
        }
    }
}

TEST_CASE("margins_of_bands_are_on_the_crop_and_fit") {
    DeviceInfo device;
    device.largest_buffer_bytes = 1 << 30;
    device.memory_bytes = uint64_t(4) << 30;
    const rendering::BandNeeds needs{2000, 300, 12, 3};
    const Rect crop{5, 7, 100, 501};
    for (uint64_t rows : {1, 3, 30, 60, 200}) {
        RenderOptions options;
        options.film_bytes = rows * 100 * needs.pixel_bytes;
        int y = crop.y;
        const auto bands = rendering::cut_into_bands(crop, options, device, needs);
        CHECK(bands.size() > 1);
        for (const auto& [rendered, kept] : bands) {
            CHECK(kept.y == y);
            y += kept.height;
            CHECK(kept.height > 0);
            CHECK(rendered.height <= int(rows));
            CHECK(rendered.x == crop.x);
            CHECK(rendered.width == crop.width);
            const int margin = std::min(needs.margin_px, int(rows) / 4);
            CHECK(rendered.y == std::max(kept.y - margin, crop.y));
            CHECK(rendered.y + rendered.height == std::min(y + margin, crop.y + crop.height));
        }
        CHECK(y == crop.y + crop.height);
    }
    // The largest buffer counts by itself, and all of them together.
    device.largest_buffer_bytes = 100 * 100 * needs.buffer_bytes;
    CHECK(rendering::cut_into_bands(crop, {}, device, needs)[0].rendered.height < 100);
    device.memory_bytes = 40 * 100 * needs.pixel_bytes;
    CHECK(rendering::cut_into_bands(crop, {}, device, needs)[0].rendered.height <= 30);
}

TEST_CASE("a_filtered_film_in_bands_has_the_samples_of_the_whole") {
    const Scene scene = large_room();
    RenderOptions options = filtered_in_bands(scene, 1, 0);
    options.adaptive = false;
    const Frame whole = render(scene, options);
    options.film_bytes = filtered_in_bands(scene, 1, 40).film_bytes;
    const Frame banded = render(scene, options);
    REQUIRE(banded.image.channels == whole.image.channels);
    for (int y = 0; y < scene.film.height; ++y)
        for (int x = 0; x < scene.film.width; ++x)
            for (const char* name : {"unfiltered.R", "unfiltered.B", "spp"})
                CHECK(value(banded.image, name, x, y) == value(whole.image, name, x, y));
    // Margins are traced twice.
    CHECK(banded.stats.samples > whole.stats.samples);
}

TEST_CASE("a_filtered_film_in_bands_is_as_good_as_the_whole") {
    const Scene scene = large_room();
    RenderOptions plain = quick(1024, 1, Sampler::lattice, 7);
    const Image truth = render(scene, plain).image;
    const Frame whole = render(scene, filtered_in_bands(scene, 1, 0));
    uint64_t done = 0, total = 0;
    RenderOptions options = filtered_in_bands(scene, 1, 40);
    options.on_progress = [&](const Progress& p) {
        CHECK(p.samples_done >= done);
        CHECK(p.samples_done <= p.samples_total);
        done = p.samples_done;
        total = p.samples_total;
    };
    const Frame banded = render(scene, options);
    CHECK(done == total);
    CHECK(banded.stats.mu == whole.stats.mu);
    CHECK(banded.stats.device_bytes < 0.6 * double(whole.stats.device_bytes));
    CHECK(banded.stats.programs_compiled + banded.stats.programs_from_cache ==
          whole.stats.programs_compiled + whole.stats.programs_from_cache);
    const double error = rmse(banded.image, truth), error_of_whole = rmse(whole.image, truth);
    CHECK(error < 1.1 * error_of_whole);
    REQUIRE(banded.stats.estimated_error);
    CHECK(banded.stats.estimated_error->rmse ==
          doctest::Approx(whole.stats.estimated_error->rmse).epsilon(0.15).scale(1e-9));
    CHECK(banded.stats.estimated_error->rel_mse ==
          doctest::Approx(whole.stats.estimated_error->rel_mse).epsilon(0.3).scale(1e-9));
    for (int y = 0; y < scene.film.height; ++y) {
        float told = 0;
        for (int x = 0; x < scene.film.width; ++x) told += value(banded.image, "error", x, y);
        CHECK(told > 0);
    }
}

TEST_CASE("errors_of_bands_are_joined_by_their_pixels") {
    const EstimatedError error = rendering::joined({1, 4}, 10, {3, 1}, 30);
    CHECK(error.rmse == doctest::Approx(std::sqrt((1 + 3 * 9) / 4.0)));
    CHECK(error.rel_mse == doctest::Approx((4 + 3 * 1) / 4.0));
}

TEST_CASE("bands_that_were_finished_stay_filtered_when_a_render_is_stopped") {
    const Scene scene = large_room();
    RenderOptions options = filtered_in_bands(scene, 1, 40);
    const Frame all = render(scene, options);
    std::atomic<bool> stop{false};
    options.stop = &stop;
    const uint64_t first_band = all.stats.samples / 3;
    options.on_progress = [&](const Progress& p) { stop = p.samples_done > first_band; };
    const Frame stopped = render(scene, options);
    CHECK(stopped.stats.interrupted);
    CHECK(!stopped.stats.estimated_error);
    int same_rows = 0, black_rows = 0;
    for (int y = 0; y < scene.film.height; ++y) {
        bool same = true, black = true;
        for (int x = 0; x < scene.film.width; ++x) {
            const float r = value(stopped.image, "R", x, y);
            same = same && r == value(all.image, "R", x, y);
            black = black && r == 0;
        }
        same_rows += same;
        black_rows += black;
    }
    // Of five bands at least the first, and at most the third.
    CHECK(same_rows >= scene.film.height / 5);
    CHECK(black_rows >= scene.film.height / 5);
}

TEST_CASE("what_bands_cannot_do_is_said") {
    Scene scene = make_room(0);
    RenderOptions options = quick(8, 0);
    options.film_bytes = kPixel;
    options.resume_file = "bands.state";
    CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("cannot be resumed"), Error);
    options.resume_file.clear();
    options.time_limit_s = 1;
    CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("cannot end at a time"), Error);
    options.time_limit_s.reset();
    options.target_error = 0.1;
    for (Method method : {Method::mc, Method::aaf}) {
        options.method = method;
        CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("end at an error"), Error);
    }
}

}  // namespace wedge::test
