#include "host/render/device_scene.hpp"

#include <cstring>

#include "host/base/srgb.hpp"
#include "host/render/long_triangles.hpp"

namespace wedge::rendering {
namespace {

int device_format(TextureFormat format) {
    switch (format) {
        case TextureFormat::srgb8:
            return WEDGE_TEXTURE_SRGB8;
        case TextureFormat::linear8:
            return WEDGE_TEXTURE_LINEAR8;
        case TextureFormat::float32:
            break;
    }
    return WEDGE_TEXTURE_FLOAT32;
}

struct TexelData {
    std::vector<shared::TextureInfo> infos;
    std::vector<float> texels;  ///< the sRGB table, then all images; bytes are kept as bytes
};

TexelData pack_textures(const std::vector<Texture>& textures) {
    TexelData data;
    std::size_t size = WEDGE_SRGB_TABLE;
    for (const Texture& t : textures) size += t.image.texels.size() / sizeof(float);
    data.texels.resize(size);
    for (std::size_t i = 0; i < WEDGE_SRGB_TABLE; ++i)
        data.texels[i] = srgb_decode(float(i) / float(WEDGE_SRGB_TABLE - 1));

    std::size_t offset = WEDGE_SRGB_TABLE;
    for (const Texture& t : textures) {
        std::memcpy(data.texels.data() + offset, t.image.texels.data(), t.image.texels.size());
        shared::TextureInfo info{};
        info.offset = uint32_t(offset);
        info.width = t.image.width;
        info.height = t.image.height;
        info.format = device_format(t.image.format);
        info.scale_u = t.scale.x;
        info.scale_v = t.scale.y;
        info.offset_u = t.offset.x;
        info.offset_v = t.offset.y;
        info.value_gain = t.value_gain;
        info.value_base = t.value_base;
        info.clamp_to_edge = t.clamp;
        data.infos.push_back(info);
        offset += t.image.texels.size() / sizeof(float);
    }
    return data;
}

}  // namespace

cl_uint DeviceScene::set_args(cl::Kernel& kernel, cl_uint first) const {
    first = tree.set_args(kernel, first);
    for (const cl::Buffer* buffer :
         {&vertices, &triangles, &materials, &textures, &texels, &lights})
        kernel.setArg(first++, *buffer);
    kernel.setArg(first++, light_count);
    return first;
}

DeviceScene upload_scene(device::Device& device, const FlatScene& flat, const bvh::Bvh& bvh,
                         const std::vector<Texture>& textures, const BvhOptions& options) {
    const auto upload = [&device](const auto& items, const char* what) {
        return device.upload_bytes(items.data(), items.size() * sizeof(items[0]), what);
    };
    const TexelData texel_data = pack_textures(textures);
    DeviceScene scene;
    scene.tree = upload_tree(device, bvh, options);
    scene.vertices = upload(flat.vertices, "vertices");
    scene.triangles = upload(flat.shading, "triangles");
    scene.materials = upload(flat.materials, "materials");
    scene.textures = upload(texel_data.infos, "texture list");
    scene.texels = upload(texel_data.texels, "texture images");
    scene.lights = upload(flat.lights, "lights");
    scene.light_count = cl_uint(flat.lights.size());
    return scene;
}

void upload_long_triangles(device::Device& device, const FlatScene& flat, DeviceScene& scene) {
    const std::vector<uint32_t> list = find_long_triangles(flat);
    scene.long_triangles =
        device.upload_bytes(list.data(), list.size() * sizeof(list[0]), "list of long triangles");
    scene.long_triangle_count = cl_uint(list.size());
}

}  // namespace wedge::rendering
