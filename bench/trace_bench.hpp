// Ray rates of one scene, kind by kind.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/device/device.hpp"
#include "wedge/bvh.hpp"
#include "wedge/scene.hpp"

namespace wedge::bench {

struct TraceBenchOptions {
    int width = 1024, height = 768;  ///< primary rays, px
    int repeats = 7;                 ///< timed, after one that is not
    uint32_t local_size = 0;         ///< work-group size; 0: what suits the device
    bool embree = true;  ///< measured too, where the build has it and the device is a CPU
    /// Measure processor time, divided by the cores, in place of wall time: on a machine that is
    /// busy with other things, the ratios are steadier.
    bool processor_time = false;
    int build_repeats = 3;  ///< builds of each tree, by turns with Embree's; the median counts
    /// Trees to be measured; all layouts of one quality share one build.
    std::vector<BvhLayout> layouts = {BvhLayout::automatic};
    std::vector<BvhQuality> qualities = {BvhQuality::medium};
};

struct Rate {
    double mrays_per_s = 0;  ///< median, 10^6 rays a second
    double spread = 0;       ///< (largest - smallest) / median
};

struct TraceRow {
    std::string kind;
    std::size_t rays = 0;
    double hit_share = 0;  ///< of the rays
    Rate wedge;
    std::optional<Rate> embree;
    std::optional<double> ratio_embree;  ///< median of the ratios of neighbouring runs
    std::size_t differing = 0;           ///< rays for which one tracer hits and the other misses
};

/// One scene in one tree.
struct TraceReport {
    std::string scene;
    BvhLayout layout = BvhLayout::wide;
    BvhQuality quality = BvhQuality::medium;
    uint64_t triangles = 0, nodes = 0, blocks = 0;
    uint64_t tree_bytes = 0;  ///< on the device
    uint32_t depth = 0;
    double build_s = 0;  ///< median, without the change of layout
    std::optional<double> embree_build_s, build_ratio_embree;
    std::optional<uint64_t> embree_bytes;
    std::vector<TraceRow> rows;
};

/// Spheres over a plane, for a machine without scene files.
Scene made_up_scene();

/// A report for each quality and layout, all with the same rays. All tracers take turns, so that a
/// slow moment of the machine meets them all. Embree's trees are of the same quality.
std::vector<TraceReport> measure_tracing(device::Device& device, const Scene& scene,
                                         const TraceBenchOptions& options);

}  // namespace wedge::bench
