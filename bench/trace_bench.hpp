// Ray rates of one scene, kind by kind.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/device/device.hpp"
#include "wedge/scene.hpp"

namespace wedge::bench {

struct TraceBenchOptions {
    int width = 1024, height = 768;  ///< primary rays, px
    int repeats = 7;                 ///< timed, after one that is not
    uint32_t local_size = 0;         ///< work-group size; 0: what suits the device
    bool embree = true;  ///< measured too, where the build has it and the device is a CPU
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

struct TraceReport {
    std::string scene;
    uint64_t triangles = 0, nodes = 0, blocks = 0, tree_bytes = 0;
    uint32_t depth = 0;
    double build_s = 0;
    std::optional<double> embree_build_s;
    std::vector<TraceRow> rows;
};

/// Spheres over a plane, for a machine without scene files.
Scene made_up_scene();

/// Runs of the two tracers alternate, so that a slow moment of the machine meets both.
TraceReport measure_tracing(device::Device& device, const Scene& scene,
                            const TraceBenchOptions& options);

}  // namespace wedge::bench
