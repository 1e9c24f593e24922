// One pixel again, with every vertex of every path told.
#include <fmt/format.h>

#include "host/device/program.hpp"
#include "host/device/self_test.hpp"
#include "host/render/device_scene.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/plan.hpp"
#include "host/render/render_settings.hpp"
#include "wedge/error.hpp"
#include "wedge/shared/replay.h"

namespace wedge {
namespace {

using shared::PathVertex;

/// A replay of more samples would be read by nobody.
constexpr uint32_t kMaxReplaySamples = 4096;

std::string text(const shared::float4& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

std::string vertex_text(const Scene& scene, const PathVertex& v, uint32_t depth) {
    if (v.kind == WEDGE_REPLAY_MISS)
        return fmt::format("    {}: nothing in direction {}, background {}, throughput {}\n", depth,
                           text(v.position), text(v.emitted), text(v.throughput));
    const std::string material = v.material < scene.materials.size()
                                     ? scene.materials[v.material].name
                                     : std::string("a light source");
    return fmt::format(
        "    {}: at {}, distance {:.6g}, triangle {}, {}, normal {}\n"
        "       throughput {}, emitted {}, sampled light {}\n",
        depth, text(v.position), v.position.w, v.primitive, material, text(v.normal),
        text(v.throughput), text(v.emitted), text(v.direct));
}

std::string film_text(const shared::FilmPixel& p) {
    const float n = p.direct.w > 0 ? p.direct.w : 1;
    const auto mean = [n](const shared::float4& v) { return text({v.x / n, v.y / n, v.z / n, 0}); };
    return fmt::format(
        "mean of {} samples: emission {}, direct {}, indirect {}; {} dropped, {} rays\n",
        p.direct.w, mean(p.emission), mean(p.direct), mean(p.indirect), p.square.w, p.indirect.w);
}

}  // namespace

std::string replay_pixel(const Scene& scene, const RenderOptions& options, int x, int y) {
    RenderOptions one = options;
    one.crop = Rect{x, y, 1, 1};
    // The sampler must see the same settings as the whole render.
    const rendering::PathSettings settings = rendering::make_path_settings(scene, one);
    const uint32_t samples = rendering::sample_count(scene, options);
    if (samples > kMaxReplaySamples)
        throw Error(
            ErrorKind::usage,
            fmt::format("replaying {} samples is too much to read; ask for at most {} with --spp",
                        samples, kMaxReplaySamples));
    device::Device device(options.device);
    device::self_test(device, options.kernel_dir);
    RenderStats stats;
    rendering::PathTracer tracer(device, scene, settings,
                                 rendering::make_plan(scene, Method::mc, settings.bounces), stats,
                                 rendering::Recording::on);
    const std::vector<PathVertex> record = tracer.record_samples(options.sample_offset, samples);

    std::string out = fmt::format("pixel {},{}, seed {}, {} samples from {}\n", x, y, options.seed,
                                  samples, options.sample_offset);
    const auto per_path = uint32_t(settings.bounces + 2);
    for (uint32_t s = 0; s < samples; ++s) {
        out += fmt::format("  sample {}\n", options.sample_offset + s);
        for (uint32_t depth = 0; depth < per_path; ++depth) {
            const PathVertex& v = record[std::size_t(s) * per_path + depth];
            if (v.kind == WEDGE_REPLAY_UNUSED) break;
            out += vertex_text(scene, v, depth);
        }
    }
    return out + film_text(tracer.read_film()[0]);
}

}  // namespace wedge
