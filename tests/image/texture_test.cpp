#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "tests/image/support.hpp"
#include "wedge/image_io.hpp"
#include "wedge/log.hpp"
#include "wedge/shared/radiance.h"

using namespace wedge;
using wedge::test::error_message;
using wedge::test::TemporaryFolder;

namespace {

/// Writes `values` (interleaved, row 0 at the top) as OpenImageIO would for any other program.
template <typename T>
void write_with_oiio(const std::filesystem::path& file, int width, int height, int channels,
                     const std::vector<T>& values, OIIO::TypeDesc type, int quality = 100) {
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("CompressionQuality", quality);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const auto output = OIIO::ImageOutput::create(file.string());
    REQUIRE(output);
    REQUIRE(output->open(file.string(), spec));
    REQUIRE(output->write_image(type, values.data()));
    REQUIRE(output->close());
}

std::vector<unsigned char> test_bytes(int count) {
    std::vector<unsigned char> bytes;
    for (int i = 0; i < count; ++i) bytes.push_back((unsigned char)((i * 37 + 11) % 256));
    return bytes;
}

std::array<float, 4> float_texel(const TextureImage& texture, int index) {
    std::array<float, 4> texel;
    std::memcpy(texel.data(), texture.texels.data() + std::size_t(index) * sizeof(texel),
                sizeof(texel));
    return texel;
}

double srgb_to_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

struct CollectedWarnings {
    std::vector<std::string> messages;
    CollectedWarnings() {
        set_log_sink([this](LogLevel, const std::string& text) { messages.push_back(text); });
    }
    ~CollectedWarnings() { set_log_sink({}); }
};

}  // namespace

TEST_CASE("eight_bit_textures_keep_their_bytes_whatever_the_channels") {
    const TemporaryFolder folder;
    const int width = 7, height = 5;
    for (const char* extension : {"png", "tga", "bmp"})
        for (int channels : {1, 2, 3, 4}) {
            if (extension == std::string("bmp") && channels == 2)
                continue;  // BMP has no such thing
            if (extension == std::string("tga") && channels == 2)
                continue;  // nor this writer of TGA
            CAPTURE(extension);
            CAPTURE(channels);
            const auto file = folder / (std::string("t.") + extension);
            const auto bytes = test_bytes(width * height * channels);
            write_with_oiio(file, width, height, channels, bytes, OIIO::TypeDesc::UINT8);
            const TextureImage texture = load_texture(file, true);
            REQUIRE(texture.width == width);
            REQUIRE(texture.height == height);
            CHECK(texture.format == TextureFormat::srgb8);
            CHECK(load_texture(file, false).format == TextureFormat::linear8);
            REQUIRE(texture.texels.size() == std::size_t(width * height * 4));
            int wrong = 0;
            for (int i = 0; i < width * height; ++i) {
                const unsigned char* source = &bytes[std::size_t(i * channels)];
                const unsigned char alpha = channels % 2 == 0 ? source[channels - 1] : 255;
                for (int c = 0; c < 3; ++c)
                    wrong += texture.texels[std::size_t(i * 4 + c)] != source[channels < 3 ? 0 : c];
                wrong += texture.texels[std::size_t(i * 4 + 3)] != alpha;
            }
            CHECK(wrong == 0);
        }
}

TEST_CASE("jpeg_textures_come_close_and_the_right_way_up") {
    const TemporaryFolder folder;
    std::vector<unsigned char> bytes;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < 3; ++c) bytes.push_back((unsigned char)(y * 12 + c * 20));
    write_with_oiio(folder / "t.jpg", 16, 16, 3, bytes, OIIO::TypeDesc::UINT8);
    const TextureImage texture = load_texture(folder / "t.jpg", true);
    CHECK(texture.format == TextureFormat::srgb8);
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(texture.texels[std::size_t(i * 4 + c)] -
                           bytes[std::size_t(i * 3 + c)]) <= 6);
}

TEST_CASE("tga_stored_from_the_bottom_is_turned_over") {
    const TemporaryFolder folder;
    // Uncompressed true colour, 1 x 2, 24 bits, origin at the lower left: the blue row comes first.
    const unsigned char tga[] = {0, 0,  2, 0, 0, 0,  0, 0,   0, 0, 0,
                                 0, 1,  0, 2, 0, 24, 0, 255, 0, 0, /* bottom, blue as B G R */ 0,
                                 0, 255 /* top, red */};
    test::write_bytes(folder / "t.tga", {reinterpret_cast<const char*>(tga), sizeof(tga)});
    const TextureImage texture = load_texture(folder / "t.tga", true);
    REQUIRE(texture.texels.size() == 8);
    CHECK(texture.texels == std::vector<unsigned char>{255, 0, 0, 255, 0, 0, 255, 255});
}

TEST_CASE("palettes_are_expanded") {
    const TemporaryFolder folder;
    // Windows bitmap, 2 x 1, 8 bits, a palette of two colours (B G R 0), rows padded to 4 bytes.
    const unsigned char bmp[] = {'B', 'M', 66, 0, 0, 0, 0, 0, 0,  0,  62, 0, 0,  0,  //
                                 40,  0,   0,  0, 2, 0, 0, 0, 1,  0,  0,  0, 1,  0,  8,  0,
                                 0,   0,   0,  0, 4, 0, 0, 0, 0,  0,  0,  0, 0,  0,  0,  0,
                                 2,   0,   0,  0, 0, 0, 0, 0, 10, 20, 30, 0, 40, 50, 60, 0,  //
                                 1,   0,   0,  0};
    test::write_bytes(folder / "t.bmp", {reinterpret_cast<const char*>(bmp), sizeof(bmp)});
    const TextureImage texture = load_texture(folder / "t.bmp", true);
    CHECK(texture.texels == std::vector<unsigned char>{60, 50, 40, 255, 30, 20, 10, 255});
}

TEST_CASE("sixteen_bit_colour_is_decoded_from_srgb_and_data_is_not") {
    const TemporaryFolder folder;
    const std::vector<uint16_t> values = {0, 1000, 20000, 32768, 50000, 65535};
    write_with_oiio(folder / "t.png", 2, 1, 3, values, OIIO::TypeDesc::UINT16);
    const TextureImage colour = load_texture(folder / "t.png", true);
    const TextureImage data = load_texture(folder / "t.png", false);
    REQUIRE(colour.format == TextureFormat::float32);
    REQUIRE(data.format == TextureFormat::float32);
    for (int i = 0; i < 2; ++i) {
        for (int c = 0; c < 3; ++c) {
            const double encoded = values[std::size_t(i * 3 + c)] / 65535.0;
            CHECK(float_texel(data, i)[std::size_t(c)] == doctest::Approx(encoded).epsilon(1e-6));
            CHECK(float_texel(colour, i)[std::size_t(c)] ==
                  doctest::Approx(srgb_to_linear(encoded)).epsilon(1e-5));
        }
        CHECK(float_texel(colour, i)[3] == 1);
    }
}

TEST_CASE("float_textures_stay_linear_and_unclamped") {
    const TemporaryFolder folder;
    const std::vector<float> values = {0,    0.5f,  12.5f,
                                       1000, 0.25f, 2};  // RGBE keeps 8 bits of each
    for (const char* name : {"t.exr", "t.hdr"}) {
        CAPTURE(name);
        write_with_oiio(folder / name, 2, 1, 3, values, OIIO::TypeDesc::FLOAT);
        const TextureImage texture = load_texture(folder / name, true);
        REQUIRE(texture.format == TextureFormat::float32);
        const bool rgbe = std::string(name) == "t.hdr";
        for (int i = 0; i < 2; ++i)
            for (int c = 0; c < 3; ++c) {
                const float value = values[std::size_t(i * 3 + c)];
                const float largest = i == 0 ? 12.5f : 1000;
                CHECK(std::abs(float_texel(texture, i)[std::size_t(c)] - value) <=
                      (rgbe ? largest / 128 : 0));
            }
    }
}

TEST_CASE("colour_of_transparent_texels_survives") {
    const TemporaryFolder folder;
    write_with_oiio(folder / "t.png", 1, 1, 4, std::vector<unsigned char>{200, 100, 50, 0},
                    OIIO::TypeDesc::UINT8);
    CHECK(load_texture(folder / "t.png", true).texels ==
          std::vector<unsigned char>{200, 100, 50, 0});
}

TEST_CASE("texels_too_large_for_the_sums_of_a_film_are_cut_and_counted") {
    const TemporaryFolder folder;
    write_with_oiio(folder / "t.exr", 2, 1, 3, std::vector<float>{3e38f, 2, -1e30f, 3, 4, 1e15f},
                    OIIO::TypeDesc::FLOAT);
    CollectedWarnings warnings;
    const TextureImage texture = load_texture(folder / "t.exr", true);
    constexpr float kMost = WEDGE_LARGEST_RADIANCE;
    CHECK(float_texel(texture, 0) == std::array<float, 4>{kMost, 2, -kMost, 1});
    CHECK(float_texel(texture, 1) == std::array<float, 4>{3, 4, 1e15f, 1});
    REQUIRE(warnings.messages.size() == 1);
    CHECK(warnings.messages[0].find("1 of 2 texels have values above") != std::string::npos);
}

TEST_CASE("texels_that_are_not_finite_become_black_and_are_counted") {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    write_with_oiio(folder / "t.exr", 3, 1, 3,
                    std::vector<float>{nan, 2, infinity, 3, 4, 5, -infinity, 6, 7},
                    OIIO::TypeDesc::FLOAT);
    CollectedWarnings warnings;
    const TextureImage texture = load_texture(folder / "t.exr", true);
    CHECK(float_texel(texture, 0) == std::array<float, 4>{0, 2, 0, 1});
    CHECK(float_texel(texture, 1) == std::array<float, 4>{3, 4, 5, 1});
    CHECK(float_texel(texture, 2) == std::array<float, 4>{0, 6, 7, 1});
    REQUIRE(warnings.messages.size() == 1);
    CHECK(warnings.messages[0].find("2 of 3 texels") != std::string::npos);
}

TEST_CASE("eight_bit_images_are_read_as_linear_light") {
    const TemporaryFolder folder;
    write_with_oiio(folder / "t.png", 1, 1, 4, std::vector<unsigned char>{0, 128, 255, 128},
                    OIIO::TypeDesc::UINT8);
    const Image image = read_image(folder / "t.png");
    REQUIRE(image.channels == std::vector<std::string>{"R", "G", "B", "A"});
    CHECK(image.pixels[0] == 0);
    CHECK(image.pixels[1] == doctest::Approx(srgb_to_linear(128 / 255.0)).epsilon(1e-5));
    CHECK(image.pixels[2] == 1);
    CHECK(image.pixels[3] == doctest::Approx(128 / 255.0).epsilon(1e-6));
}

TEST_CASE("grey_images_are_read_as_rgb") {
    const TemporaryFolder folder;
    write_with_oiio(folder / "t.png", 1, 1, 1, std::vector<unsigned char>{255},
                    OIIO::TypeDesc::UINT8);
    const Image image = read_image(folder / "t.png");
    CHECK(image.channels == std::vector<std::string>{"R", "G", "B"});
    CHECK(image.pixels == std::vector<float>{1, 1, 1});
}

TEST_CASE("files_that_are_no_images_are_named_with_the_reason") {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name) {
        const auto file = folder / name;
        const std::string of_texture =
            error_message(ErrorKind::bad_input, [&] { load_texture(file, true); });
        const std::string of_image = error_message(ErrorKind::bad_input, [&] { read_image(file); });
        CHECK(of_texture.find(name) != std::string::npos);
        CHECK(of_image.find(name) != std::string::npos);
        CHECK(of_texture.size() > file.string().size() + 30);
        return of_texture;
    };
    CHECK(message("absent.png").find("no such file") != std::string::npos);
    test::write_bytes(folder / "empty.png", "");
    CHECK(message("empty.png").find("empty") != std::string::npos);
    test::write_bytes(folder / "text.png", "This is not a picture, whatever its name may say.\n");
    message("text.png");
    std::filesystem::create_directory(folder / "folder.png");
    CHECK(message("folder.png").find("folder") != std::string::npos);
}

TEST_CASE("truncated_files_are_refused") {
    const TemporaryFolder folder;
    const int size = 64;
    const auto bytes = test_bytes(size * size * 3);
    std::vector<float> floats;
    for (unsigned char byte : bytes) floats.push_back(byte);
    for (const char* name : {"t.png", "t.jpg", "t.tga", "t.bmp", "t.exr", "t.hdr"}) {
        CAPTURE(name);
        const auto file = folder / name;
        const bool is_float = std::string(name) == "t.exr" || std::string(name) == "t.hdr";
        if (is_float)
            write_with_oiio(file, size, size, 3, floats, OIIO::TypeDesc::FLOAT);
        else
            write_with_oiio(file, size, size, 3, bytes, OIIO::TypeDesc::UINT8);
        const std::string whole = test::read_bytes(file);
        load_texture(file, true);
        for (double part : {0.02, 0.3, 0.5, 0.9}) {
            CAPTURE(part);
            test::write_bytes(file,
                              std::string_view(whole).substr(0, std::size_t(whole.size() * part)));
            CHECK(error_message(ErrorKind::bad_input, [&] { load_texture(file, true); }) != "");
            CHECK(error_message(ErrorKind::bad_input, [&] { read_image(file); }) != "");
        }
    }
}

TEST_CASE("hostile_sizes_are_refused_before_memory_is_taken") {
    const TemporaryFolder folder;
    // An RGBE header is text, so that it can claim anything.
    test::write_bytes(folder / "t.hdr",
                      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 200000 +X 200000\n\x02\x02");
    const std::string message =
        error_message(ErrorKind::bad_input, [&] { load_texture(folder / "t.hdr", true); });
    CHECK(message.find("200000 x 200000") != std::string::npos);
}

TEST_CASE("cmyk_is_refused") {
    const TemporaryFolder folder;
    OIIO::ImageSpec spec(2, 2, 4, OIIO::TypeDesc::UINT8);
    spec.channelnames = {"C", "M", "Y", "K"};
    spec.attribute("tiff:ColorSpace", "CMYK");
    spec.attribute("tiff:PhotometricInterpretation", 5);
    spec.attribute("oiio:RawColor", 1);
    const auto output = OIIO::ImageOutput::create("t.tif");
    const auto bytes = test_bytes(16);
    REQUIRE(output->open((folder / "t.tif").string(), spec));
    REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, bytes.data()));
    REQUIRE(output->close());
    const std::string message =
        error_message(ErrorKind::bad_input, [&] { load_texture(folder / "t.tif", true); });
    CHECK(message.find("CMYK") != std::string::npos);
}
