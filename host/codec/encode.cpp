#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "host/codec/codec_functions.hpp"
#include "host/image/metadata.hpp"
#include "wedge/error.hpp"

namespace wedge::codec {
namespace {

namespace fs = std::filesystem;

std::string encode(const std::string& format, const OIIO::ImageSpec& spec, const void* pixels,
                   const fs::path& named) {
    const auto fail = [&](const std::string& reason) {
        throw Error(ErrorKind::output,
                    fmt::format("{}: cannot encode {}: {}", named.string(), format, reason));
    };
    const auto output = OIIO::ImageOutput::create(format);
    if (!output) fail(OIIO::geterror());

    OIIO::Filesystem::IOVecOutput sink;
    if (!output->set_ioproxy(&sink)) fail("this OpenImageIO cannot encode to memory");
    // The name only chooses the format here; nothing of that name is opened.
    if (!output->open("image." + format, spec)) fail(output->geterror());
    if (!output->write_image(spec.format, pixels)) fail(output->geterror());
    if (!output->close()) fail(output->geterror());
    return std::string(sink.buffer().begin(), sink.buffer().end());
}

}  // namespace

std::string encode_exr(const Image& image, const fs::path& named) {
    OIIO::ImageSpec spec(image.width, image.height, int(image.channels.size()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.alpha_channel = image.channel("A");
    spec.z_channel = image.channel("Z");
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [key, value] : image.metadata)
        spec.attribute(image::exr_attribute_name(key), value);
    return encode("openexr", spec, image.pixels.data(), named);
}

std::string encode_png(int width, int height, const unsigned char* rgb, const fs::path& named) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return encode("png", spec, rgb, named);
}

}  // namespace wedge::codec
