// Images do not depend on how many threads the device runs.
#include <doctest/doctest.h>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

Image render_with_threads(const Workbench& bench, const std::string& threads) {
    ProcessSettings settings;
    settings.environment["POCL_MAX_PTHREAD_COUNT"] = threads;
    const ProcessResult result =
        bench.wedge({"render", "room.json", "-o", threads + ".exr", "--spp", "10"}, settings);
    REQUIRE(result.exit_code == 0);
    return read_image(bench.folder() / (threads + ".exr"));
}

TEST_CASE("images_do_not_depend_on_the_number_of_threads") {
    const Workbench bench;
    write_room(bench);
    const Image one = render_with_threads(bench, "1");
    for (const char* threads : {"2", "5"})
        CHECK(render_with_threads(bench, threads).pixels == one.pixels);
}

}  // namespace
}  // namespace wedge::test
