#include "host/cli/image_support.hpp"

#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/render_arguments.hpp"
#include "wedge/error.hpp"
#if WEDGE_WITH_IMAGE
#include "wedge/image_io.hpp"
#endif

namespace wedge::cli {

#if WEDGE_WITH_IMAGE

void require_image_support(const std::string&) {}
void register_compare_if_supported(CLI::App& app) {
    register_compare(app);
}
TextureLoader texture_loader() {
    return load_texture;
}
void check_tone(const std::string& name) {
    parse_tone_curve(name);
}
void check_output(const std::filesystem::path& file) {
    check_writable(file);
}

void write_output(const std::filesystem::path& file, const Image& image, const Develop& develop) {
    if (output_format(file) == OutputFormat::exr)
        write_exr(file, image);
    else
        write_png(file, image, develop.exposure, parse_tone_curve(develop.tone));
}

void write_output(const std::filesystem::path& file, const image::HeatLayer& layer) {
    image::write_heat_map(file, layer);
}

#else

void require_image_support(const std::string& command) {
    throw Error(ErrorKind::usage, command +
                                      ": this build has no image support; build with OpenImageIO "
                                      "and -DWEDGE_WITH_IMAGE=ON");
}

void register_compare_if_supported(CLI::App& app) {
    CLI::App* command = app.add_subcommand("compare", "Not in this build: needs OpenImageIO");
    command->allow_extras();
    command->callback([] { require_image_support("compare"); });
}

TextureLoader texture_loader() {
    return {};
}
void check_tone(const std::string&) {}
void check_output(const std::filesystem::path&) {}
void write_output(const std::filesystem::path&, const Image&, const Develop&) {
    require_image_support("render");
}
void write_output(const std::filesystem::path&, const image::HeatLayer&) {
    require_image_support("render");
}

#endif

}  // namespace wedge::cli
