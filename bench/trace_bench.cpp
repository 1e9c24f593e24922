#include "bench/trace_bench.hpp"

#include <algorithm>
#include <ctime>
#include <thread>

#include "bench/tracers.hpp"
#include "host/base/stopwatch.hpp"
#include "host/bvh/interleave.hpp"
#include "scenes/generators/generators.hpp"

namespace wedge::bench {
namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Rate rate_of(std::size_t rays, const std::vector<double>& seconds) {
    const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
    const double middle = median(seconds);
    if (!(middle > 0)) return {};
    return {double(rays) / middle * 1e-6, (*most - *least) / middle};
}

bool is_hit(const PackedHit& hit) {
    return hit.primitive != WEDGE_NO_PRIMITIVE;
}

/// A tree of one quality, and Embree's.
struct BuiltTree {
    BvhQuality quality;
    bvh::Bvh tree;
    std::unique_ptr<EmbreeScene> embree;
    std::vector<double> build_s, embree_build_s, ratios;
};

BuiltTree build_trees(const rendering::FlatScene& flat, BvhQuality quality, bool embree,
                      int repeats) {
    BuiltTree built;
    built.quality = quality;
    for (int i = 0; i < repeats; ++i) {
        built.tree = {};
        built.tree = bvh::build(flat.positions, flat.triangles, quality);
        Stopwatch layout;  // Embree's build leaves what its rays read, too
        bvh::interleave(built.tree);
        built.build_s.push_back(built.tree.build_s + layout.total());
        if (!embree) continue;
        built.embree.reset();
        built.embree = build_embree_scene(flat, quality);
        if (!built.embree) continue;
        built.embree_build_s.push_back(built.embree->build_s);
        built.ratios.push_back(built.build_s.back() / built.embree->build_s);
    }
    return built;
}

/// A tree in one layout, ready to be traced.
struct Contender {
    const BuiltTree* built;
    BvhLayout layout;
    std::unique_ptr<rendering::DeviceTree> on_device;
    std::unique_ptr<Tracer> kernels, embree;
    std::vector<double> wedge_s, embree_s, ratios;
};

Contender make_contender(device::Device& device, const BuiltTree& built, BvhLayout layout,
                         uint32_t local_size) {
    Contender contender{.built = &built, .layout = layout};
    if (layout == BvhLayout::automatic)
        contender.layout = rendering::suitable_layout(device.info());
    contender.on_device = std::make_unique<rendering::DeviceTree>(
        rendering::upload_tree(device, built.tree, {.layout = contender.layout}));
    contender.kernels = make_kernel_tracer(device, *contender.on_device, local_size);
    if (built.embree) contender.embree = built.embree->make_tracer();
    return contender;
}

double time_trace(Tracer& tracer, bool processor_time) {
    if (!processor_time) return tracer.trace();
    const std::clock_t start = std::clock();
    tracer.trace();
    const double cores = std::max(1u, std::thread::hardware_concurrency());
    return double(std::clock() - start) / CLOCKS_PER_SEC / cores;
}

void time_once(Contender& c, bool processor_time) {
    c.wedge_s.push_back(time_trace(*c.kernels, processor_time));
    if (!c.embree) return;
    c.embree_s.push_back(time_trace(*c.embree, processor_time));
    c.ratios.push_back(c.embree_s.back() / c.wedge_s.back());
}

TraceRow make_row(const RaySet& set, const Contender& c) {
    TraceRow row;
    row.kind = set.kind;
    row.rays = set.rays.size();
    if (set.rays.empty()) return row;
    row.wedge = rate_of(row.rays, c.wedge_s);
    const std::vector<PackedHit> hits = c.kernels->hits();
    row.hit_share = double(std::count_if(hits.begin(), hits.end(), is_hit)) / double(row.rays);
    if (!c.embree) return row;
    row.embree = rate_of(row.rays, c.embree_s);
    row.ratio_embree = median(c.ratios);
    const std::vector<PackedHit> others = c.embree->hits();
    for (std::size_t i = 0; i < hits.size(); ++i)
        row.differing += is_hit(hits[i]) != is_hit(others[i]);
    return row;
}

/// Appends a row to each contender's report.
void measure_rows(const RaySet& set, std::vector<Contender>& contenders,
                  const TraceBenchOptions& options, std::vector<TraceReport>& reports) {
    for (Contender& c : contenders) {
        c.kernels->load(set);
        if (c.embree) c.embree->load(set);
        if (!set.rays.empty()) time_once(c, options.processor_time);  // not counted
        c.wedge_s.clear(), c.embree_s.clear(), c.ratios.clear();
    }
    for (int i = 0; i < options.repeats && !set.rays.empty(); ++i)
        for (Contender& c : contenders) time_once(c, options.processor_time);
    for (std::size_t i = 0; i < contenders.size(); ++i)
        reports[i].rows.push_back(make_row(set, contenders[i]));
}

TraceReport make_report(const Scene& scene, const rendering::FlatScene& flat, const Contender& c) {
    TraceReport report;
    report.scene = scene.name;
    report.layout = c.layout;
    report.quality = c.built->quality;
    report.triangles = flat.triangles.size();
    report.nodes = c.built->tree.nodes.size();
    report.blocks = c.built->tree.blocks.size();
    report.tree_bytes = c.on_device->bytes;
    report.depth = c.built->tree.depth;
    report.build_s = median(c.built->build_s);
    if (c.built->embree) {
        report.embree_build_s = median(c.built->embree_build_s);
        report.build_ratio_embree = median(c.built->ratios);
        report.embree_bytes = c.built->embree->bytes;
    }
    return report;
}

}  // namespace

Scene made_up_scene() {
    Scene scene;
    scene.name = "spheres";
    scene.camera.position = Vec3(0, 3.6f, 8.2f);
    scene.camera.target = Vec3(0, 0.9f, 0);
    scene.meshes.push_back(scenes::generate("spheres", {}, scene.materials));
    scene.instances.push_back({});
    return scene;
}

std::vector<TraceReport> measure_tracing(device::Device& device, const Scene& scene,
                                         const TraceBenchOptions& options) {
    const rendering::FlatScene flat = rendering::flatten(scene);
    // Beside a GPU, a rate on the host's cores says nothing.
    const bool embree = options.embree && device.info().type == DeviceType::cpu;
    std::vector<BuiltTree> built;
    for (const BvhQuality quality : options.qualities)
        built.push_back(build_trees(flat, quality, embree, options.build_repeats));
    std::vector<Contender> contenders;
    std::vector<TraceReport> reports;
    for (const BuiltTree& one : built)
        for (const BvhLayout layout : options.layouts) {
            contenders.push_back(make_contender(device, one, layout, options.local_size));
            reports.push_back(make_report(scene, flat, contenders.back()));
        }

    Tracer& first = *contenders.front().kernels;
    const TraceClosest trace = [&](std::span<const PackedRay> rays) {
        first.load({"", false, {rays.begin(), rays.end()}});
        first.trace();
        return first.hits();
    };
    for (const RaySet& set : make_ray_sets(scene, flat, built.front().tree.bounds, options.width,
                                           options.height, trace))
        measure_rows(set, contenders, options, reports);
    return reports;
}

}  // namespace wedge::bench
