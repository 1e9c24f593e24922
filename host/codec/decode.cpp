// The bytes of an image file to pixels.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#include "host/codec/codec_functions.hpp"
#include "host/codec/exr_header.hpp"
#include "host/image/metadata.hpp"
#include "wedge/error.hpp"

namespace wedge::codec {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: cannot read the image: {}", file.string(), reason));
}

/// What the file system knows, said better than an image library would.
void require_file(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail(file, "there is no such file");
    if (fs::is_directory(status)) fail(file, "it is a folder");
    if (fs::is_regular_file(status) && fs::file_size(file, error) == 0)
        fail(file, "the file is empty (0 bytes)");
}

bool is_cmyk(const OIIO::ImageSpec& spec) {
    for (const char* key : {"jpeg:ColorSpace", "tiff:ColorSpace", "oiio:ColorSpace"}) {
        const std::string space = spec.get_string_attribute(key);
        if (space == "CMYK" || space == "YCCK") return true;
    }
    return spec.nchannels >= 4 && spec.channel_name(0) == "C" && spec.channel_name(1) == "M";
}

void require_usable(const fs::path& file, const OIIO::ImageSpec& spec) {
    if (spec.deep) fail(file, "it is a deep image; flatten it first");
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0)
        fail(file, fmt::format("its size is {} x {} x {} with {} channels", spec.width, spec.height,
                               spec.depth, spec.nchannels));
    if (std::size_t(spec.width) * std::size_t(spec.height) > image::kMaxPixels)
        fail(file, fmt::format("{} x {} pixels are more than the {} that are taken; scale it down",
                               spec.width, spec.height, image::kMaxPixels));
    // Decoders fill in what is missing, and of a few damaged bytes make gigabytes.
    constexpr std::size_t kSurelyFine = std::size_t(1) << 24, kMostPerByte = 1024;
    const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
    std::error_code error;
    const std::size_t bytes = fs::file_size(file, error);
    if (pixels > kSurelyFine && !error && pixels / kMostPerByte > bytes)
        fail(file, fmt::format("it claims {} x {} pixels in {} bytes; the file is damaged",
                               spec.width, spec.height, bytes));
    if (is_cmyk(spec)) fail(file, "its colours are CMYK; convert it to RGB");
}

/// libjpeg fills what is missing with grey and calls it a success. A whole file has an end marker
/// after its last start of a scan (neither occurs inside compressed data; a thumbnail comes
/// before).
void require_whole_jpeg(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    const std::size_t scan = bytes.rfind("\xFF\xDA");
    const std::size_t end = bytes.rfind("\xFF\xD9");
    if (scan != std::string::npos && (end == std::string::npos || end < scan))
        fail(file, "the file is truncated");
}

std::unique_ptr<OIIO::ImageInput> open(const fs::path& file) {
    OIIO::ImageSpec hints;
    // Textures are multiplied into colours; dividing alpha out again would lose texels where it is
    // 0.
    hints.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::geterror();  // drops what an earlier call may have left
    auto input = OIIO::ImageInput::open(file.string(), &hints);
    if (!input) {
        const std::string reason = OIIO::geterror();
        fail(file, reason.empty() ? "no known image format" : reason);
    }
    return input;
}

std::map<std::string, std::string> metadata_of(const OIIO::ImageSpec& spec) {
    std::map<std::string, std::string> metadata;
    for (const auto& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (name.starts_with(image::kMetadataPrefix)) metadata[name] = attribute.get_string();
    }
    return metadata;
}

}  // namespace

image::DecodedImage decode(const fs::path& file, bool keep_bytes) {
    require_file(file);
    if (const std::string flaw = flaw_of_exr_header(file); !flaw.empty()) fail(file, flaw);
    const auto input = open(file);
    const OIIO::ImageSpec spec = input->spec();
    require_usable(file, spec);
    if (input->format_name() == std::string_view("jpeg")) require_whole_jpeg(file);

    image::DecodedImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.channelnames;
    image.stores_integers = !spec.format.is_floating_point();
    image.holds_bytes = keep_bytes && spec.format == OIIO::TypeDesc::UINT8;
    image.metadata = metadata_of(spec);
    const OIIO::TypeDesc type = image.holds_bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    const std::size_t byte_count = image.pixel_count() * std::size_t(spec.nchannels) * type.size();
    try {
        // Not zeroed: a file that claims far more than it holds then costs address space, not
        // memory.
        image.values = std::make_unique_for_overwrite<std::byte[]>(byte_count);
    } catch (const std::bad_alloc&) {
        fail(file, fmt::format("it needs {} bytes of memory, which are not there", byte_count));
    }
    if (!input->read_image(0, 0, 0, -1, type, image.values.get())) fail(file, input->geterror());
    return image;
}

}  // namespace wedge::codec
