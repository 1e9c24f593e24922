// The corpus again, in a program without a fuzzer: what was ever found stays found.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/targets.hpp"

namespace wedge::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double kHang_s = 10;

void replay(const std::string& name) {
    const Target feed = find_target(name);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(WEDGE_SOURCE_DIR "/tests/fuzz/corpus/" + name))
        files.push_back(entry.path());
    REQUIRE(!files.empty());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        CAPTURE(file.string());
        std::ifstream stream(file, std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(stream), {});
        const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
        const auto start = std::chrono::steady_clock::now();
        CHECK_NOTHROW(feed(data, bytes.size()));
        // Cut short and with a byte changed: what a broken disk makes of files.
        for (std::size_t part = 1; part < 4; ++part)
            CHECK_NOTHROW(feed(data, bytes.size() * part / 4));
        for (std::size_t i = 0; i < 8 && !bytes.empty(); ++i) {
            std::string broken = bytes;
            broken[i * 7919 % broken.size()] ^= char(1 << i);
            CHECK_NOTHROW(
                feed(reinterpret_cast<const std::uint8_t*>(broken.data()), broken.size()));
        }
        CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() <
              kHang_s);
    }
}

TEST_CASE("scene_corpus_is_read_or_refused") {
    replay("scene");
}
TEST_CASE("obj_corpus_is_read_or_refused") {
    replay("obj");
}
TEST_CASE("image_corpus_is_read_or_refused") {
    replay("image");
}

}  // namespace
}  // namespace wedge::fuzz
