// wedge compare, as a person or a script would use it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

Image grey(float value, int width = 16) {
    Image image;
    image.width = width;
    image.height = 12;
    image.channels = {"R", "G", "B"};
    image.pixels.assign(std::size_t(width) * 12 * 3, value);
    return image;
}

TEST_CASE("compare_prints_the_distance_of_two_images") {
    const Workbench bench;
    write_exr(bench.folder() / "a.exr", grey(0.5f));
    write_exr(bench.folder() / "b.exr", grey(0.25f));
    const ProcessResult result =
        bench.wedge({"compare", "a.exr", "b.exr", "--json", "--diff", "d.exr", "--gain", "2"});
    REQUIRE(result.exit_code == 0);
    const auto found = nlohmann::json::parse(result.out);
    CHECK(found.at("mse") == doctest::Approx(0.0625));
    CHECK(found.at("rmse") == doctest::Approx(0.25));
    CHECK(found.at("relmse") == doctest::Approx(0.0625 / (0.26 * 0.26)));
    CHECK(read_image(bench.folder() / "d.exr").at(3, 3, 0) == doctest::Approx(0.5));
}

TEST_CASE("compare_refuses_images_of_different_sizes") {
    const Workbench bench;
    write_exr(bench.folder() / "a.exr", grey(0.5f));
    write_exr(bench.folder() / "b.exr", grey(0.5f, 20));
    const ProcessResult result = bench.wedge({"compare", "a.exr", "b.exr"});
    CHECK(result.exit_code == 3);
    CHECK(result.err_has("16 x 12"));
    CHECK(result.err_has("20 x 12"));
}

}  // namespace
}  // namespace wedge::test
