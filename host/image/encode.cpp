#include "host/image/encode.hpp"

#include <OpenImageIO/filesystem.h>
#include <fmt/format.h>

#include "wedge/error.hpp"

namespace wedge::image {

std::string encode(const std::string& format, const OIIO::ImageSpec& spec, const void* pixels,
                   const std::filesystem::path& named) {
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

}  // namespace wedge::image
