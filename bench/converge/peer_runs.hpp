// Other renderers (bench/peers) as methods: the scene is exported, and each gets a process that is
// there until all is measured, so that its runs alternate with ours.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "bench/converge/config.hpp"
#include "bench/converge/run_record.hpp"
#include "bench/peers/peer_process.hpp"

namespace wedge::converge {

/// A converged image by another renderer.
struct PeerReference {
    const Method* method = nullptr;
    std::string version;
    Image image;  ///< R, G, B, variance.R, .G, .B (of the mean)
    int spp = 0;  ///< samples per pixel
};

class PeerRuns {
  public:
    PeerRuns(const Config& config, const Scene& scene, std::string name, std::string digest)
        : config_(config), scene_(scene), name_(std::move(name)), digest_(std::move(digest)) {}

    /// Renders with the samples and the seed of `record`, and fills its times and origin. Throws
    /// Error(device), Error(usage).
    Image run(const Method& method, RunRecord& record);

    double seconds(const Method& method, double spp);

    /// One of each renderer among the methods, by the first method of each; from the folder of
    /// references where it is there.
    std::vector<PeerReference> references(const std::function<void(const std::string&)>& say);

    PeerReference reference(const Method& method,
                            const std::function<void(const std::string&)>& say);

    /// Where the scene is written for them.
    std::filesystem::path export_folder() const;

  private:
    peers::Peer& peer_of(const Method& method);

    const Config& config_;
    const Scene& scene_;
    std::string name_, digest_;
    bool is_exported_ = false;
    std::map<const Method*, std::unique_ptr<peers::Peer>> peers_;
};

}  // namespace wedge::converge
