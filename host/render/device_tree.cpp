#include "host/render/device_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "host/bvh/binarize.hpp"
#include "host/bvh/compress.hpp"
#include "wedge/error.hpp"

namespace wedge::rendering {
namespace {

/// log2 of the number of items a chunk holds; chunks are full but for the last.
int chunk_shift(uint64_t largest_bytes, std::size_t item_bytes) {
    const uint64_t items = std::max<uint64_t>(largest_bytes / item_bytes, 1);
    return std::min(int(std::bit_width(items)) - 1, 31);
}

/// Buffers of 1 << shift items each; those that nothing is left for are the first one again.
template <typename T>
std::vector<cl::Buffer> upload_chunks(device::Device& device, std::span<const T> items, int shift,
                                      const char* what) {
    const std::size_t chunk = std::size_t(1) << shift;
    if (items.size() > WEDGE_TREE_CHUNKS * chunk)
        throw Error(ErrorKind::device,
                    fmt::format("device {}: {} of {:.1f} GiB do not fit into {} buffers; render a "
                                "smaller scene, or choose another device with --device",
                                device.info().name, what, double(items.size_bytes()) / (1 << 30),
                                WEDGE_TREE_CHUNKS));
    std::vector<cl::Buffer> buffers;
    for (std::size_t first = 0; first < items.size(); first += chunk)
        buffers.push_back(
            device.upload(items.subspan(first, std::min(chunk, items.size() - first)), what));
    if (buffers.empty()) buffers.push_back(device.upload(items, what));
    while (buffers.size() < WEDGE_TREE_CHUNKS) buffers.push_back(buffers.front());
    return buffers;
}

template <typename Nodes, typename Blocks>
void upload_arrays(device::Device& device, const Nodes& nodes, const Blocks& blocks,
                   uint64_t largest_bytes, DeviceTree& tree) {
    const std::span node_span(nodes.data(), nodes.size());
    const std::span block_span(blocks.data(), blocks.size());
    tree.bytes = node_span.size_bytes() + block_span.size_bytes();
    if (std::max(node_span.size_bytes(), block_span.size_bytes()) <= largest_bytes) {
        tree.nodes = {device.upload(node_span, "BVH nodes")};
        tree.blocks = {device.upload(block_span, "BVH triangles")};
        return;
    }
    const int node_shift = chunk_shift(largest_bytes, sizeof(nodes[0]));
    const int block_shift = chunk_shift(largest_bytes, sizeof(blocks[0]));
    tree.nodes = upload_chunks(device, node_span, node_shift, "BVH nodes");
    tree.blocks = upload_chunks(device, block_span, block_shift, "BVH triangles");
    tree.defines.push_back("WEDGE_TREE_CHUNKED=1");
    tree.defines.push_back(fmt::format("WEDGE_NODE_CHUNK_SHIFT={}", node_shift));
    tree.defines.push_back(fmt::format("WEDGE_BLOCK_CHUNK_SHIFT={}", block_shift));
}

}  // namespace

cl_uint DeviceTree::set_args(cl::Kernel& kernel, cl_uint first) const {
    for (const cl::Buffer& buffer : nodes) kernel.setArg(first++, buffer);
    for (const cl::Buffer& buffer : blocks) kernel.setArg(first++, buffer);
    return first;
}

BvhLayout suitable_layout(const DeviceInfo& device) {
    return device.type == DeviceType::cpu ? BvhLayout::wide : BvhLayout::compressed;
}

DeviceTree upload_tree(device::Device& device, const bvh::Bvh& tree, const BvhOptions& options) {
    const BvhLayout layout =
        options.layout == BvhLayout::automatic ? suitable_layout(device.info()) : options.layout;
    const uint64_t largest = options.largest_buffer_bytes ? options.largest_buffer_bytes
                                                          : device.info().largest_buffer_bytes;
    DeviceTree out;
    if (layout == BvhLayout::compressed) {
        out.defines.push_back(fmt::format("WEDGE_BVH_LAYOUT={}", WEDGE_BVH_COMPRESSED));
        const bvh::CompressedTree compressed = bvh::compress(tree);
        upload_arrays(device, compressed.nodes, compressed.blocks, largest, out);
    } else if (layout == BvhLayout::binary) {
        out.defines.push_back(fmt::format("WEDGE_BVH_LAYOUT={}", WEDGE_BVH_BINARY));
        upload_arrays(device, bvh::binarize(tree), tree.blocks, largest, out);
    } else {
        upload_arrays(device, tree.nodes, tree.blocks, largest, out);
    }
    return out;
}

}  // namespace wedge::rendering
