// The same bits, however the work is cut.
#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>

#include "host/render/schedule.hpp"
#include "test_scenes.hpp"

namespace wedge::test {
namespace {

bool same_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

Scene small_room() {
    Scene scene = make_room(25);
    scene.film = {33, 21};
    return scene;
}

TEST_CASE("images_do_not_depend_on_work_groups_or_tiles") {
    const Scene scene = small_room();
    for (Sampler sampler : {Sampler::sobol, Sampler::hash}) {
        const RenderOptions plain = quick(10, 2, sampler, 3);
        const Image reference = render(scene, plain).image;
        for (uint32_t local : {1u, 7u, 64u}) {
            RenderOptions options = plain;
            options.local_size = local;
            CHECK(same_bits(render(scene, options).image, reference));
        }
        for (uint32_t tile : {1u, 50u, 100000u}) {
            RenderOptions options = plain;
            options.tile_pixels = tile;
            CHECK(same_bits(render(scene, options).image, reference));
        }
        CHECK(!same_bits(render(scene, quick(10, 2, sampler, 4)).image, reference));
    }
}

TEST_CASE("a_crop_is_cut_from_the_whole_image") {
    const Scene scene = small_room();
    const Image whole = render(scene, quick(4, 1)).image;
    RenderOptions options = quick(4, 1);
    options.crop = Rect{5, 3, 11, 9};
    const Image part = render(scene, options).image;
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            const bool inside = x >= 5 && x < 16 && y >= 3 && y < 12;
            for (int c = 0; c < int(whole.channels.size()); ++c)
                REQUIRE(part.at(x, y, c) == (inside ? whole.at(x, y, c) : 0.0f));
        }
}

TEST_CASE("a_schedule_covers_all_work_once") {
    for (uint32_t tile : {0u, 1u, 7u, 1000u}) {
        rendering::Schedule schedule(100, 8, 22, tile);
        std::vector<std::vector<int>> done(100, std::vector<int>(30, 0));
        double seconds = 1e-7;
        while (const auto work = schedule.next()) {
            CHECK(work->first_sample % kSampleBatch == 0);
            for (uint32_t p = 0; p < work->pixel_count; ++p)
                for (uint32_t s = 0; s < work->sample_count; ++s)
                    done[work->first_pixel + p][work->first_sample + s] += 1;
            schedule.measured(seconds *= 3);  // a device that slows down
        }
        CHECK(schedule.at_pass_end());
        for (const auto& pixel : done)
            for (int s = 0; s < 30; ++s) CHECK(pixel[s] == (s >= 8 ? 1 : 0));
    }
}

}  // namespace
}  // namespace wedge::test
