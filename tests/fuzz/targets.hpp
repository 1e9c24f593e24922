// What the fuzzers feed: each takes any bytes, and either succeeds or throws Error(bad_input).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace wedge::fuzz {

/// A scene file. Beside it stand `t.obj` (a triangle with the material "a") and `map.png`.
void read_scene(const std::uint8_t* data, std::size_t size);

/// An OBJ file; what follows a line `#mtl` is its material library, `m.mtl`. The meshes go through
/// the builder of acceleration structures too.
void read_obj(const std::uint8_t* data, std::size_t size);

/// An image file as a texture and as an image; the first byte chooses the extension.
void read_image(const std::uint8_t* data, std::size_t size);

/// By name: "scene", "obj", "image". Bytes are fed, and anything but success or Error(bad_input)
/// ends the process or is thrown on.
using Target = void (*)(const std::uint8_t*, std::size_t);
Target find_target(const std::string& name);

}  // namespace wedge::fuzz
