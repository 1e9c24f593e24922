#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tests/image/support.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using wedge::test::TemporaryFolder;

namespace {

/// Every layer a render writes, with values no lossy format would keep.
Image layered_image(int width, int height) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = {"R",   "G",   "B",   "A", "direct.R", "direct.G", "direct.B",   "albedo.R",
                      "N.X", "N.Y", "N.Z", "Z", "P.X",      "spp",      "variance.R", "emission.B"};
    for (std::size_t i = 0; i < std::size_t(width) * height * image.channels.size(); ++i)
        image.pixels.push_back(float(std::sin(double(i)) * std::pow(10.0, double(i % 60) - 30)));
    image.metadata = {{"wedge:scene", "cornell \"box\"\nsecond line"},
                      {"wedge:seed", "17"},
                      {"wedge:device", "é µ"}};
    return image;
}

Image rgb_image(int width, int height, float value) {
    Image image{width, height, {"R", "G", "B"}, {}, {}};
    image.pixels.assign(std::size_t(width) * height * 3, value);
    return image;
}

std::vector<unsigned char> png_bytes(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input);
    REQUIRE(input->spec().nchannels == 3);
    REQUIRE(input->spec().format == OIIO::TypeDesc::UINT8);
    std::vector<unsigned char> bytes(input->spec().image_bytes());
    REQUIRE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, bytes.data()));
    return bytes;
}

}  // namespace

TEST_CASE("exr_round_trip_keeps_every_bit_name_and_metadata") {
    const TemporaryFolder folder;
    const Image written = layered_image(37, 23);
    write_exr(folder / "image.exr", written);
    const Image read = read_image(folder / "image.exr");

    CHECK(read.width == written.width);
    CHECK(read.height == written.height);
    CHECK(read.metadata == written.metadata);
    CHECK(std::multiset<std::string>(read.channels.begin(), read.channels.end()) ==
          std::multiset<std::string>(written.channels.begin(), written.channels.end()));
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < written.channels.size(); ++c) {
        const int there = read.channel(written.channels[c]);
        REQUIRE(there >= 0);
        for (int y = 0; y < written.height; ++y)
            for (int x = 0; x < written.width; ++x)
                wrong += read.at(x, y, there) != written.at(x, y, int(c));
    }
    CHECK(wrong == 0);
}

TEST_CASE("exr_keeps_infinities_and_nans") {
    const TemporaryFolder folder;
    Image image = rgb_image(2, 1, 1);
    image.pixels[0] = std::numeric_limits<float>::infinity();
    image.pixels[4] = std::numeric_limits<float>::quiet_NaN();
    write_exr(folder / "image.exr", image);
    const Image read = read_image(folder / "image.exr");
    CHECK(std::isinf(read.pixels[0]));
    CHECK(std::isnan(read.pixels[4]));
    CHECK(read.pixels[5] == 1);
}

TEST_CASE("other_readers_see_colour_first_and_prefixed_metadata") {
    const TemporaryFolder folder;
    write_exr(folder / "image.exr", layered_image(3, 2));
    const auto input = OIIO::ImageInput::open((folder / "image.exr").string());
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    CHECK(std::string(input->format_name()) == "openexr");
    CHECK(spec.format == OIIO::TypeDesc::FLOAT);
    REQUIRE(spec.nchannels == 16);
    const std::vector<std::string> first(spec.channelnames.begin(), spec.channelnames.begin() + 4);
    CHECK(first == std::vector<std::string>{"R", "G", "B", "A"});
    CHECK(spec.alpha_channel == 3);
    CHECK(spec.get_string_attribute("wedge:seed") == "17");
    CHECK(spec.get_string_attribute("compression") == "zip");
}

TEST_CASE("metadata_without_the_prefix_gets_it") {
    const TemporaryFolder folder;
    Image image = rgb_image(1, 1, 0);
    image.metadata = {{"note", "a"}, {"wedge:seed", "b"}};
    write_exr(folder / "image.exr", image);
    CHECK(read_image(folder / "image.exr").metadata ==
          std::map<std::string, std::string>{{"wedge:note", "a"}, {"wedge:seed", "b"}});
}

TEST_CASE("png_values_follow_the_srgb_formula") {
    const TemporaryFolder folder;
    const int count = 256;
    Image ramp = rgb_image(count, 1, 0);
    for (int x = 0; x < count; ++x)
        for (int c = 0; c < 3; ++c) ramp.at(x, 0, c) = float(x) / 200;  // goes beyond 1
    write_png(folder / "ramp.png", ramp);
    const auto bytes = png_bytes(folder / "ramp.png");
    for (int x = 0; x < count; ++x) {
        const double linear = std::min(1.0, double(float(x) / 200));
        const double encoded =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        CHECK(std::abs(bytes[std::size_t(x) * 3] - encoded * 255) <= 0.5 + 1e-4);
    }
}

TEST_CASE("png_applies_exposure_before_the_tone_curve") {
    const TemporaryFolder folder;
    const auto first_byte = [&](float value, float exposure, ToneCurve curve) {
        write_png(folder / "one.png", rgb_image(1, 1, value), exposure, curve);
        return int(png_bytes(folder / "one.png")[0]);
    };
    // 0.5 displayed is sRGB code 187.516 -> 188.
    CHECK(first_byte(0.25f, 1, ToneCurve::srgb) == 188);
    CHECK(first_byte(1, -1, ToneCurve::srgb) == 188);
    CHECK(first_byte(0.5f, 1, ToneCurve::reinhard) == 188);  // 1 / (1 + 1)
    // Filmic at x = 1: (2.51 + 0.03) / (2.43 + 0.59 + 0.14) = 0.803797; sRGB 0.907974 * 255 =
    // 231.5.
    const double filmic = 1.055 * std::pow(2.54 / 3.16, 1 / 2.4) - 0.055;
    CHECK(first_byte(1, 0, ToneCurve::filmic) == int(filmic * 255 + 0.5));
    for (ToneCurve curve : {ToneCurve::srgb, ToneCurve::filmic, ToneCurve::reinhard}) {
        CHECK(first_byte(0, 0, curve) == 0);
        CHECK(first_byte(-3, 0, curve) == 0);
        CHECK(first_byte(std::numeric_limits<float>::quiet_NaN(), 0, curve) == 0);
        CHECK(first_byte(std::numeric_limits<float>::infinity(), 0, curve) == 255);
    }
}

TEST_CASE("png_takes_rgb_from_wherever_it_is_and_leaves_out_the_rest") {
    const TemporaryFolder folder;
    Image image{1, 1, {"Z", "B", "A", "G", "R"}, {9, 0, 0.5f, 1, 0}, {}};
    write_png(folder / "g.png", image);
    CHECK(png_bytes(folder / "g.png") == std::vector<unsigned char>{0, 255, 0});
}

TEST_CASE("images_that_cannot_be_written_are_output_errors") {
    const TemporaryFolder folder;
    const auto kind_of = [](auto&& action) {
        try {
            action();
        } catch (const Error& error) {
            return error.kind();
        }
        return ErrorKind::internal;
    };
    Image no_colour{1, 1, {"Z"}, {1}, {}};
    Image short_of_pixels{2, 2, {"R", "G", "B"}, {1, 2, 3}, {}};
    CHECK(kind_of([&] { write_png(folder / "a.png", no_colour); }) == ErrorKind::output);
    CHECK(kind_of([&] { write_exr(folder / "a.exr", short_of_pixels); }) == ErrorKind::output);
    CHECK(kind_of([&] { write_exr(folder / "a.exr", Image{}); }) == ErrorKind::output);
    CHECK(folder.is_empty());
}

TEST_CASE("tone_curves_are_named_or_refused_with_the_list") {
    CHECK(parse_tone_curve("filmic") == ToneCurve::filmic);
    try {
        parse_tone_curve("agx");
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::usage);
        CHECK(std::string(error.what()).find("reinhard") != std::string::npos);
    }
}
