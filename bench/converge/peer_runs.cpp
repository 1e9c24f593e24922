#include "bench/converge/peer_runs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "bench/peers/scene_export.hpp"
#include "host/base/atomic_file.hpp"
#include "wedge/image_io.hpp"

namespace wedge::converge {
namespace {

constexpr uint32_t kReferenceSeed = 0x5EED;  // runs count up from 0
constexpr int kReferenceParts = 16;          // independent renders, for variances

}  // namespace

std::filesystem::path PeerRuns::export_folder() const {
    return config_.folder / "peers" / fmt::format("{}-{}", name_, digest_.substr(0, 8));
}

peers::Peer& PeerRuns::peer_of(const Method& method) {
    if (!is_exported_) peers::export_scene(scene_, export_folder());
    is_exported_ = true;
    auto& peer = peers_[&method];
    if (!peer)
        peer = std::make_unique<peers::Peer>(config_.python, method.peer_script, method.name,
                                             export_folder());
    return *peer;
}

Image PeerRuns::run(const Method& method, RunRecord& record) {
    peers::Peer& peer = peer_of(method);
    peers::Peer::Rendered rendered = peer.render(int(std::lround(record.knob)), record.seed);
    record.render_s = record.time_s = rendered.render_s;
    record.compile_s = rendered.compile_s;
    record.bvh_build_s = peer.load_s();
    record.passes = {{method.name, rendered.render_s, 1}};
    record.samples = rendered.samples;
    record.device = peer.device();
    record.driver = peer.version();
    return std::move(rendered.image);
}

double PeerRuns::seconds(const Method& method, double spp) {
    return peer_of(method).render(int(std::lround(spp)), 0).render_s;
}

PeerReference PeerRuns::reference(const Method& method,
                                  const std::function<void(const std::string&)>& say) {
    const int spp =
        (config_.reference_spp + kReferenceParts - 1) / kReferenceParts * kReferenceParts;
    const std::filesystem::path file =
        config_.references /
        fmt::format("{}-{}-{}-spp{}.exr", name_, digest_.substr(0, 8), method.name, spp);
    PeerReference reference{&method, "", {}, spp};
    if (std::filesystem::exists(file)) {
        reference.image = read_image(file);
        reference.version = reference.image.metadata["wedge:renderer"];
        return reference;
    }
    say(fmt::format("{}: reference by {}, {} samples a pixel", name_, method.name, spp));
    reference.image = peer_of(method).render(spp, kReferenceSeed, kReferenceParts).image;
    reference.version = reference.image.metadata["wedge:renderer"];
    make_folder(config_.references);
    write_exr(file, reference.image);
    return reference;
}

std::vector<PeerReference> PeerRuns::references(
    const std::function<void(const std::string&)>& say) {
    std::vector<PeerReference> list;
    std::set<std::string> scripts;
    for (const std::string& name : config_.methods) {
        const Method& method = find_method(name);
        if (method.peer_script && scripts.insert(method.peer_script).second)
            list.push_back(reference(method, say));
    }
    return list;
}

}  // namespace wedge::converge
