// The layout of the tree and its quality change the time of a render, not what it shows.
#include <doctest/doctest.h>

#include "wedge/render.hpp"
#include "wedge/scene.hpp"

using namespace wedge;

namespace {

Image render_with(const BvhOptions& bvh) {
    Scene scene = load_scene(WEDGE_SOURCE_DIR "/scenes/spheres.json");
    scene.film.width = 48;
    scene.film.height = 36;
    RenderOptions options;
    options.samples_per_pixel = 4;
    options.bounces = 2;
    options.bvh = bvh;
    return render(scene, options).image;
}

/// Values that differ by more than a thousandth of the largest there is.
double share_of_differing(const Image& a, const Image& b) {
    REQUIRE(a.pixels.size() == b.pixels.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        differing += std::abs(a.pixels[i] - b.pixels[i]) >
                     1e-3f * std::max(std::abs(a.pixels[i]), std::abs(b.pixels[i]));
    return double(differing) / double(a.pixels.size());
}

}  // namespace

TEST_CASE("layout_and_quality_of_the_tree_do_not_change_the_image") {
    const Image expected = render_with({});
    // Rays through shared edges may name the other triangle, whose shading differs a little.
    for (const BvhLayout layout : {BvhLayout::wide, BvhLayout::compressed, BvhLayout::binary})
        CHECK(share_of_differing(render_with({.layout = layout}), expected) < 0.002);
    CHECK(share_of_differing(render_with({.quality = BvhQuality::high}), expected) < 0.002);
}

TEST_CASE("a_tree_in_chunks_renders_the_same_bits") {
    const Image whole = render_with({});
    const Image cut = render_with({.largest_buffer_bytes = uint64_t(1) << 20});
    CHECK(whole.pixels == cut.pixels);
}
