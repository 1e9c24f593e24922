// Choices about the tree that rays are traced through (docs/tracing.md).
#pragma once

#include <cstdint>

namespace wedge {

/// How nodes lie in the device's memory. All give the same hits but for ties.
enum class BvhLayout {
    automatic,   ///< wide on CPUs, compressed on others
    wide,        ///< eight children in vectors, for CPUs
    compressed,  ///< eight children with quantised boxes, 80 bytes, for GPUs
    binary,      ///< two children, 64 bytes
};

/// `high`: also cuts triangles between children where that pays. Builds slower, traces faster where
/// triangles are large or lie askew.
enum class BvhQuality { medium, high };

struct BvhOptions {
    BvhLayout layout = BvhLayout::automatic;
    BvhQuality quality = BvhQuality::medium;
    /// A node or triangle array larger than this is cut into chunks; 0: the device's largest
    /// buffer. For tests.
    uint64_t largest_buffer_bytes = 0;
};

}  // namespace wedge
