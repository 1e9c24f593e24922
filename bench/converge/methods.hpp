// What `wedge bench converge` can compare. A new method is one line of the table in methods.cpp.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "bench/baselines/denoise.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {

/// What a method's effort is set by: samples per pixel, or the scale of the bandwidth.
enum class Knob { spp, mu };

struct Method {
    const char* name;   ///< as typed, "mc-sobol"
    const char* label;  ///< for people
    Knob knob;
    bool biased;  ///< filtered: no z-test, but a map of the bias
    void (*configure)(RenderOptions&);
    std::optional<baselines::Filter> filter = {};  ///< over the finished render
    /// Made by somebody else from the finished runs of this method (bench/peers), and taken where
    /// they are there; `external_tag` ends the keys of its runs.
    const char* external_source = nullptr;
    const char* external_tag = nullptr;
    /// Another renderer, driven by this script of bench/peers; it has no rays to count, and no
    /// estimates of variance. `configure` is of no use then.
    const char* peer_script = nullptr;
    bool lambert_only = false;  ///< a peer without counterparts of our lobes and smooth normals
};

std::span<const Method> all_methods();

/// Throws Error(usage) that lists the names.
const Method& find_method(const std::string& name);

/// Names, separated by commas.
std::string method_names();
std::string peer_names();  ///< of those with a `peer_script`

/// Options of one run. `value` of the knob; samples per pixel are rounded.
RenderOptions options_for(const Method& method, double value, uint32_t seed);

/// What distinguishes the method's runs in any scene: all options but knob, seed, device. The same
/// for every scene, which is asserted.
nlohmann::json settings_json(const Method& method);

/// Arguments of `wedge render` that do the same as `options`.
std::string render_arguments(const RenderOptions& options);

}  // namespace wedge::converge
