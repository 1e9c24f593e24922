// Images to files: EXR for numbers, PNG for eyes. docs/output.md is the user's side of this.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "host/base/atomic_file.hpp"
#include "host/base/parallel.hpp"
#include "host/base/srgb.hpp"
#include "host/image/codec.hpp"
#include "host/image/tone.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"

namespace wedge {
namespace {

namespace fs = std::filesystem;

void require_pixels(const fs::path& file, const Image& image) {
    const std::size_t pixel_count = std::size_t(image.width) * std::size_t(image.height);
    if (image.width <= 0 || image.height <= 0 || image.channels.empty())
        throw Error(ErrorKind::output, fmt::format("{}: the image is empty", file.string()));
    if (image.pixels.size() != pixel_count * image.channels.size())
        throw Error(
            ErrorKind::output,
            fmt::format("{}: {} values do not make {} x {} pixels of {} channels", file.string(),
                        image.pixels.size(), image.width, image.height, image.channels.size()));
}

uint8_t to_8_bits(float display_linear) {
    return uint8_t(srgb_encode(display_linear) * 255 + 0.5f);
}

void require_folder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) return;
    throw Error(ErrorKind::output,
                fmt::format("{}: cannot write: there is no folder {}; create it first",
                            file.string(), folder.string()));
}

}  // namespace

void write_exr(const fs::path& file, const Image& image) {
    require_pixels(file, image);
    require_folder(file);
    write_file_atomically(file, image::encode_exr(image, file));
}

void write_png(const fs::path& file, const Image& image, float exposure, ToneCurve curve) {
    require_pixels(file, image);
    require_folder(file);
    const int rgb[3] = {image.channel("R"), image.channel("G"), image.channel("B")};
    if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0)
        throw Error(ErrorKind::output,
                    fmt::format("{}: a PNG needs the channels R, G and B", file.string()));

    const float gain = std::exp2(exposure);
    const std::size_t pixel_count = std::size_t(image.width) * std::size_t(image.height);
    const std::size_t stride = image.channels.size();
    std::vector<uint8_t> bytes(pixel_count * 3);
    parallel_ranges(pixel_count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (int c = 0; c < 3; ++c) {
                const float radiance = image.pixels[i * stride + std::size_t(rgb[c])] * gain;
                bytes[i * 3 + std::size_t(c)] = to_8_bits(image::apply_tone_curve(curve, radiance));
            }
    });

    write_file_atomically(file, image::encode_png(image.width, image.height, bytes.data(), file));
}

void check_writable(const fs::path& file) {
    image::require_codec();
    require_folder(file);
    std::error_code ignored;
    if (fs::exists(file, ignored) && fs::is_other(file, ignored)) {  // a device or a pipe
        if (::access(file.c_str(), W_OK) != 0)
            throw Error(ErrorKind::output,
                        fmt::format("{}: cannot write: {}", file.string(), std::strerror(errno)));
        return;
    }
    const AtomicFile probe(file);  // creates a file beside the target, and removes it
}

}  // namespace wedge
