#include "bench/trace_bench.hpp"

#include <algorithm>

#include "bench/tracers.hpp"
#include "scenes/generators/generators.hpp"

namespace wedge::bench {
namespace {

double median(std::vector<double> values) {
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

TraceRow measure_row(const RaySet& set, Tracer& kernels, Tracer* embree, int repeats) {
    TraceRow row;
    row.kind = set.kind;
    row.rays = set.rays.size();
    if (set.rays.empty()) return row;
    kernels.load(set);
    kernels.trace();
    if (embree) {
        embree->load(set);
        embree->trace();
    }
    std::vector<double> wedge_s, embree_s, ratios;
    for (int i = 0; i < repeats; ++i) {
        wedge_s.push_back(kernels.trace());
        if (!embree) continue;
        embree_s.push_back(embree->trace());
        ratios.push_back(embree_s.back() / wedge_s.back());
    }
    row.wedge = rate_of(row.rays, wedge_s);
    const std::vector<PackedHit> hits = kernels.hits();
    row.hit_share = double(std::count_if(hits.begin(), hits.end(), is_hit)) / double(row.rays);
    if (embree) {
        row.embree = rate_of(row.rays, embree_s);
        row.ratio_embree = median(ratios);
        const std::vector<PackedHit> others = embree->hits();
        for (std::size_t i = 0; i < hits.size(); ++i)
            row.differing += is_hit(hits[i]) != is_hit(others[i]);
    }
    return row;
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

TraceReport measure_tracing(device::Device& device, const Scene& scene,
                            const TraceBenchOptions& options) {
    const rendering::FlatScene flat = rendering::flatten(scene);
    const bvh::Bvh tree = bvh::build(flat.positions, flat.triangles);
    const auto kernels = make_kernel_tracer(device, tree, options.local_size);
    // Beside a GPU, a rate on the host's cores says nothing.
    const bool compare = options.embree && device.info().type == DeviceType::cpu;
    const auto embree = compare ? make_embree_tracer(flat) : nullptr;

    TraceReport report;
    report.scene = scene.name;
    report.triangles = flat.triangles.size();
    report.nodes = tree.nodes.size();
    report.blocks = tree.blocks.size();
    report.tree_bytes = tree.nodes.size() * sizeof(shared::BvhNode) +
                        tree.blocks.size() * sizeof(shared::TriangleBlock);
    report.depth = tree.depth;
    report.build_s = tree.build_s;
    if (embree) report.embree_build_s = embree->build_s;

    const TraceClosest trace = [&](std::span<const PackedRay> rays) {
        kernels->load({"", false, {rays.begin(), rays.end()}});
        kernels->trace();
        return kernels->hits();
    };
    for (const RaySet& set :
         make_ray_sets(scene, flat, tree.bounds, options.width, options.height, trace))
        report.rows.push_back(measure_row(set, *kernels, embree.get(), options.repeats));
    return report;
}

}  // namespace wedge::bench
