#include "tests/fuzz/targets.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "host/bvh/bvh.hpp"
#include "host/scene/check_scene.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"
#include "wedge/log.hpp"
#include "wedge/scene.hpp"

namespace wedge::fuzz {
namespace {

namespace fs = std::filesystem;

/// Removed at the end of the process; in memory where there is such a file system.
class Folder {
  public:
    Folder() {
        const fs::path root = fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
        std::string name = (root / "wedge_fuzz_XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
        set_log_sink([](LogLevel, const std::string&) {});
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;

    fs::path write(const std::string& name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary | std::ios::trunc) << bytes;
        return path_ / name;
    }

  private:
    fs::path path_;
};

const Folder& folder() {
    static const Folder instance;
    return instance;
}

std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

TextureImage grey_texel(const fs::path&, bool) {
    return {1, 1, TextureFormat::srgb8, {128, 128, 128, 255}};
}

/// What was read must be fit to be rendered.
void load_and_check(const fs::path& file) {
    try {
        const Scene scene = load_scene(file, {{}, grey_texel});
        scene::check_scene(scene);
        for (const Mesh& mesh : scene.meshes) bvh::build(mesh.positions, mesh.triangles);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::bad_input) throw;
    }
}

}  // namespace

void read_scene(const std::uint8_t* data, std::size_t size) {
    static const fs::path obj =
        folder().write("t.obj", "mtllib t.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    static const fs::path mtl = folder().write("t.mtl", "newmtl a\nKd 1 0 0\n");
    static const fs::path map = folder().write("map.png", "");
    load_and_check(folder().write("scene.json", text_of(data, size)));
}

void read_obj(const std::uint8_t* data, std::size_t size) {
    static const fs::path map = folder().write("map.png", "");
    constexpr std::string_view kCut = "\n#mtl\n";
    const std::string_view text = text_of(data, size);
    const std::size_t cut = text.find(kCut);
    const bool has_mtl = cut != text.npos;
    folder().write("m.mtl", has_mtl ? text.substr(cut + kCut.size()) : std::string_view());
    load_and_check(folder().write("m.obj", has_mtl ? text.substr(0, cut + 1) : text));
}

void read_image(const std::uint8_t* data, std::size_t size) {
    constexpr const char* kExtensions[] = {".exr", ".png", ".jpg", ".tif",
                                           ".hdr", ".bmp", ".tga", ".unknown"};
    if (size == 0) return;
    const char* extension = kExtensions[data[0] % std::size(kExtensions)];
    const fs::path file =
        folder().write(std::string("image") + extension, text_of(data + 1, size - 1));
    const auto feed = [](const auto& read) {
        try {
            read();
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::bad_input) throw;
        }
    };
    feed([&] { load_texture(file, true); });
    feed([&] { wedge::read_image(file); });
}

Target find_target(const std::string& name) {
    if (name == "scene") return read_scene;
    if (name == "obj") return read_obj;
    if (name == "image") return read_image;
    throw std::runtime_error("no fuzz target is called " + name);
}

}  // namespace wedge::fuzz
