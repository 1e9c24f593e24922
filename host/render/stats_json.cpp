#include <nlohmann/json.hpp>

#include "wedge/render.hpp"

namespace wedge {
namespace {

using json = nlohmann::ordered_json;

nlohmann::ordered_json device_json(const DeviceInfo& d) {
    return {{"index", d.index},
            {"name", d.name},
            {"type", name_of(d.type)},
            {"platform", d.platform},
            {"platform_version", d.platform_version},
            {"driver", d.driver},
            {"compute_units", d.compute_units},
            {"memory_bytes", d.memory_bytes},
            {"largest_buffer_bytes", d.largest_buffer_bytes}};
}

}  // namespace

std::string stats_to_json(const RenderStats& s) {
    nlohmann::ordered_json passes = nlohmann::ordered_json::array();
    double device_s = 0;
    for (const PassStats& pass : s.passes) {
        passes.push_back(
            {{"name", pass.name}, {"device_s", pass.device_s}, {"launches", pass.launches}});
        device_s += pass.device_s;
    }
    nlohmann::ordered_json out = {
        {"version", version()},
        {"device", device_json(s.device)},
        {"passes", passes},
        {"rays", s.rays},
        {"rays_per_s", device_s > 0 ? double(s.rays) / device_s : 0.0},
        {"samples", s.samples},
        {"non_finite_samples", s.non_finite_samples},
        {"device_bytes", s.device_bytes},
        {"triangles", s.triangles},
        {"degenerate_triangles", s.degenerate_triangles},
        {"non_finite_triangles", s.non_finite_triangles},
        {"flatten_s", s.flatten_s},
        {"bvh_build_s", s.bvh_build_s},
        {"upload_s", s.upload_s},
        {"compile_s", s.compile_s},
        {"render_s", s.render_s},
        {"render_cpu_s", s.render_cpu_s},
        {"mu", s.mu > 0 ? json(s.mu) : json()},
        {"estimated_rmse", s.estimated_error ? json(s.estimated_error->rmse) : json()},
        {"estimated_rel_mse", s.estimated_error ? json(s.estimated_error->rel_mse) : json()},
        {"programs_compiled", s.programs_compiled},
        {"programs_from_cache", s.programs_from_cache},
        {"interrupted", s.interrupted},
        {"failure", s.failure},
    };
    return out.dump(4) + "\n";
}

}  // namespace wedge
