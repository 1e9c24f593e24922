#include "host/render/device_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "host/base/parallel.hpp"
#include "host/bvh/binarize.hpp"
#include "host/bvh/compress.hpp"
#include "host/bvh/interleave.hpp"
#include "wedge/error.hpp"

namespace wedge::rendering {
namespace {

// Smaller arrays are not worth the threads.
constexpr uint64_t kCopyInParallelFrom_bytes = uint64_t(2) << 20;
constexpr std::size_t kCopyGrain_bytes = std::size_t(2) << 20;

/// As Device::upload. Where the device's memory is the host's, all cores copy.
template <typename T>
cl::Buffer upload_array(device::Device& device, std::span<const T> items, const char* what) {
    const uint64_t bytes = items.size_bytes();
    if (device.info().type != DeviceType::cpu || bytes < kCopyInParallelFrom_bytes)
        return device.upload(items, what);
    try {
        cl::Buffer buffer = device.allocate(bytes, what, CL_MEM_READ_ONLY);
        const cl::CommandQueue& queue = device.queue();
        char* memory = static_cast<char*>(
            queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, bytes));
        const char* from = reinterpret_cast<const char*>(items.data());
        parallel_ranges(bytes, kCopyGrain_bytes, [&](std::size_t begin, std::size_t end) {
            std::memcpy(memory + begin, from + begin, end - begin);
        });
        queue.enqueueUnmapMemObject(buffer, memory);
        device.finish();
        return buffer;
    } catch (const cl::Error&) {
        return device.upload(items, what);  // a device that cannot map
    }
}

/// log2 of the number of items a chunk holds; chunks are full but for the last.
int chunk_shift(uint64_t largest_bytes, std::size_t item_bytes) {
    const uint64_t items = std::max<uint64_t>(largest_bytes / item_bytes, 1);
    return std::min(int(std::bit_width(items)) - 1, 31);
}

[[noreturn]] void throw_too_large(const device::Device& device, const char* what, uint64_t bytes,
                                  std::size_t buffers) {
    throw Error(ErrorKind::device,
                fmt::format("device {}: {} of {:.1f} GiB do not fit into {} buffers; render a "
                            "smaller scene, or choose another device with --device",
                            device.info().name, what, double(bytes) / (1 << 30), buffers));
}

/// Appends `count` buffers of 1 << shift items each; those that nothing is left for are the first
/// one again.
template <typename T>
void upload_chunks(device::Device& device, std::span<const T> items, int shift, std::size_t count,
                   const char* what, std::vector<cl::Buffer>& out) {
    const std::size_t chunk = std::size_t(1) << shift;
    if (items.size() > count * chunk) throw_too_large(device, what, items.size_bytes(), count);
    std::vector<cl::Buffer> buffers;
    for (std::size_t first = 0; first < items.size(); first += chunk)
        buffers.push_back(upload_array(
            device, items.subspan(first, std::min(chunk, items.size() - first)), what));
    if (buffers.empty()) buffers.push_back(device.upload(items, what));
    while (buffers.size() < count) buffers.push_back(buffers.front());
    out.insert(out.end(), buffers.begin(), buffers.end());
}

void upload_rows(device::Device& device, const bvh::Bvh& wide, uint64_t largest_bytes,
                 DeviceTree& tree) {
    constexpr const char* kWhat = "BVH nodes and triangles";
    constexpr std::size_t kChunks = 2 * WEDGE_TREE_CHUNKS, kRow_bytes = sizeof(shared::TreeRow);
    const uint64_t rows = bvh::row_count(wide);
    const int shift = chunk_shift(largest_bytes, kRow_bytes);
    const bool cut = rows * kRow_bytes > largest_bytes;
    const uint64_t chunk_rows = cut ? uint64_t(1) << shift : 0;
    if (cut && (chunk_rows < bvh::kLargestFamily_rows || rows > kChunks * chunk_rows))
        throw_too_large(device, kWhat, rows * kRow_bytes, kChunks);
    const bvh::TreeRows placed = bvh::interleave(wide, chunk_rows);
    const std::span<const shared::TreeRow> span(placed.data(), placed.size());
    tree.bytes = span.size_bytes();
    if (!cut) {
        tree.arrays = {upload_array(device, span, kWhat)};
        return;
    }
    upload_chunks(device, span, shift, kChunks, kWhat, tree.arrays);
    tree.defines.push_back("WEDGE_TREE_CHUNKED=1");
    tree.defines.push_back(fmt::format("WEDGE_ROW_CHUNK_SHIFT={}", shift));
}

template <typename Nodes, typename Blocks>
void upload_arrays(device::Device& device, const Nodes& nodes, const Blocks& blocks,
                   uint64_t largest_bytes, DeviceTree& tree) {
    const std::span node_span(nodes.data(), nodes.size());
    const std::span block_span(blocks.data(), blocks.size());
    tree.bytes = node_span.size_bytes() + block_span.size_bytes();
    if (std::max(node_span.size_bytes(), block_span.size_bytes()) <= largest_bytes) {
        tree.arrays = {upload_array(device, node_span, "BVH nodes"),
                       upload_array(device, block_span, "BVH triangles")};
        return;
    }
    const int node_shift = chunk_shift(largest_bytes, sizeof(nodes[0]));
    const int block_shift = chunk_shift(largest_bytes, sizeof(blocks[0]));
    upload_chunks(device, node_span, node_shift, WEDGE_TREE_CHUNKS, "BVH nodes", tree.arrays);
    upload_chunks(device, block_span, block_shift, WEDGE_TREE_CHUNKS, "BVH triangles", tree.arrays);
    tree.defines.push_back("WEDGE_TREE_CHUNKED=1");
    tree.defines.push_back(fmt::format("WEDGE_NODE_CHUNK_SHIFT={}", node_shift));
    tree.defines.push_back(fmt::format("WEDGE_BLOCK_CHUNK_SHIFT={}", block_shift));
}

}  // namespace

cl_uint DeviceTree::set_args(cl::Kernel& kernel, cl_uint first) const {
    for (const cl::Buffer& buffer : arrays) kernel.setArg(first++, buffer);
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
        upload_rows(device, tree, largest, out);
    }
    return out;
}

}  // namespace wedge::rendering
