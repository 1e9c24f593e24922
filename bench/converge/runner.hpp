// Renders what is missing of scenes x methods x budgets x seeds.
#pragma once

#include <functional>
#include <vector>

#include "bench/converge/config.hpp"
#include "bench/converge/peer_runs.hpp"
#include "bench/converge/reference.hpp"
#include "bench/converge/run_record.hpp"

namespace wedge::converge {

/// A scene with all its finished runs.
struct SceneRuns {
    std::string name, digest, file;
    Film film;
    int bounces = 0;
    float exposure = 0;  ///< stops, for pictures
    uint64_t triangles = 0;
    Reference reference;
    std::vector<RunRecord> runs;
    std::vector<PeerReference> peer_references;
};

using Say = std::function<void(const std::string&)>;

/// The scene at the size and with the bounces of `config`; without what other renderers have no
/// counterpart for, which is said, if there are any among the methods.
Scene scene_to_measure(const Config& config, const std::string& scene_file, const LoadOptions& load,
                       const Say& say);

/// What `config` asks of the reference of a scene.
ReferenceRequest reference_request(const Config& config, const std::string& name,
                                   const std::string& digest, const Say& say);

/// Runs of different methods alternate, so that a slow moment of the machine meets all. Finished
/// runs are lines of `folder`/runs.jsonl and images in `folder`/images; those that are there and
/// were made by this program on this device are not made again. Throws Stopped, Error.
SceneRuns run_scene(const Config& config, const std::string& scene_file, const LoadOptions& load,
                    const Say& say);

}  // namespace wedge::converge
