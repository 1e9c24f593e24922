// Films in bands: the same bits as at once.
#include <doctest/doctest.h>

#include "host/render/bands.hpp"
#include "test_scenes.hpp"
#include "wedge/error.hpp"
#include "wedge/shared/frame.h"

namespace wedge::test {
namespace {

constexpr uint64_t kPixel = sizeof(shared::FilmPixel);

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
            for (const Rect& band : rendering::cut_into_bands(crop, options, device)) {
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

TEST_CASE("what_bands_cannot_do_is_said") {
    Scene scene = make_room(0);
    RenderOptions options = quick(8, 0);
    options.film_bytes = kPixel;
    options.method = Method::aaf;
    CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("only --method mc"), Error);
    options.method = Method::mc;
    options.resume_file = "bands.state";
    CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("cannot be resumed"), Error);
    options.resume_file.clear();
    options.time_limit_s = 1;
    CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("cannot end at a time"), Error);
    options.time_limit_s.reset();
    options.target_error = 0.1;
    CHECK_THROWS_WITH_AS(render(scene, options), doctest::Contains("end at an error"), Error);
}

}  // namespace wedge::test
