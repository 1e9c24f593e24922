#include "bench/converge/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wedge/error.hpp"

namespace wedge::converge {
namespace {

using baselines::Filter;

template <Sampler kSampler>
void monte_carlo(RenderOptions& o) {
    o.method = wedge::Method::mc;
    o.sampler = kSampler;
}

constexpr uint64_t kControlSeeds = 1u << 18;  // apart from those of runs, halves and references

void control(RenderOptions& o) {
    monte_carlo<Sampler::sobol>(o);
    o.seed = kControlSeeds;
}

template <FilterMode kFilter, bool kAdaptive, Sampler kSampler = Sampler::sobol>
void aaf(RenderOptions& o) {
    o.method = wedge::Method::aaf;
    o.filter = kFilter;
    o.adaptive = kAdaptive;
    o.sampler = kSampler;
}

constexpr Method peer(const char* name, const char* label, const char* script,
                      bool lambert_only = false) {
    return {name, label,   Knob::spp, false,  monte_carlo<Sampler::hash>,
            {},   nullptr, nullptr,   script, lambert_only};
}

// The first unbiased method of a comparison is its yardstick.
constexpr Method kMethods[] = {
    {"mc-sobol", "Monte Carlo, Owen-scrambled Sobol", Knob::spp, false,
     monte_carlo<Sampler::sobol>},
    {"mc-stratified", "Monte Carlo, jittered strata", Knob::spp, false,
     monte_carlo<Sampler::stratified>},
    {"mc-hash", "Monte Carlo, independent samples", Knob::spp, false, monte_carlo<Sampler::hash>},
    {"aaf", "axis-aligned filtering, guarded", Knob::mu, true, aaf<FilterMode::guarded, true>},
    {"aaf-plain", "axis-aligned filtering as in the papers, no guard", Knob::mu, true,
     aaf<FilterMode::plain, true>},
    {"aaf-adaptive", "its adaptive samples, not filtered", Knob::mu, false,
     aaf<FilterMode::none, true>},
    {"aaf-filter", "its filter, the same samples everywhere", Knob::spp, true,
     aaf<FilterMode::plain, false>},
    {"aaf-stratified", "axis-aligned filtering, no guard, jittered strata", Knob::mu, true,
     aaf<FilterMode::plain, true, Sampler::stratified>},
    {"mc+gaussian", "mc-sobol, Gaussian of 2 px", Knob::spp, true, monte_carlo<Sampler::sobol>,
     Filter::gaussian},
    {"mc+bilateral", "mc-sobol, cross-bilateral filter", Knob::spp, true,
     monte_carlo<Sampler::sobol>, Filter::bilateral},
    {"mc+atrous", "mc-sobol, a-trous wavelets (Dammertz et al. 2010)", Knob::spp, true,
     monte_carlo<Sampler::sobol>, Filter::atrous},
    {"mc+nlm", "mc-sobol, two-buffer non-local means (Rousselle et al. 2012)", Knob::spp, true,
     monte_carlo<Sampler::sobol>, Filter::nlm},
    {"mc+svgf", "mc-sobol, spatial part of SVGF (Schied et al. 2017)", Knob::spp, true,
     monte_carlo<Sampler::sobol>, Filter::svgf},
    {"mc+oidn",
     "mc-sobol, Open Image Denoise (bench/peers/oidn.py)",
     Knob::spp,
     true,
     monte_carlo<Sampler::sobol>,
     {},
     "mc-sobol",
     "oidn"},
    {"mc-control", "mc-sobol with other seeds: what luck does", Knob::spp, false, control},
    {"aaf-uniform", "aaf with the same samples in every pixel", Knob::spp, true,
     aaf<FilterMode::guarded, false>},
    peer("mitsuba", "Mitsuba 3, independent samples", "mitsuba_peer.py"),
    peer("mitsuba-multijitter", "Mitsuba 3, correlated multi-jittered samples", "mitsuba_peer.py"),
    peer("cycles", "Cycles, tabulated Sobol", "cycles_peer.py", true),
    peer("luxcore", "LuxCore, Sobol", "luxcore_peer.py", true),
};

}  // namespace

std::span<const Method> all_methods() {
    return kMethods;
}

std::string method_names() {
    std::string names;
    for (const Method& method : kMethods)
        names += (names.empty() ? "" : ", ") + std::string(method.name);
    return names;
}

std::string peer_names() {
    std::string names;
    for (const Method& method : kMethods)
        if (method.peer_script) names += (names.empty() ? "" : ", ") + std::string(method.name);
    return names;
}

const Method& find_method(const std::string& name) {
    const auto found = std::find_if(std::begin(kMethods), std::end(kMethods),
                                    [&](const Method& m) { return name == m.name; });
    if (found == std::end(kMethods))
        throw Error(ErrorKind::usage,
                    fmt::format("--methods {}: no such method; known: {}", name, method_names()));
    return *found;
}

RenderOptions options_for(const Method& method, double value, uint32_t seed) {
    RenderOptions options;
    method.configure(options);
    options.seed += seed;
    if (method.knob == Knob::spp)
        options.samples_per_pixel = int(std::max(1.0, std::round(value)));
    else
        options.mu = float(value);
    return options;
}

nlohmann::json settings_json(const Method& method) {
    if (method.peer_script) return {{"renderer", method.name}};
    RenderOptions options;
    method.configure(options);
    nlohmann::json settings = {{"method", to_string(options.method)},
                               {"sampler", to_string(options.sampler)},
                               {"sample_offset", options.sample_offset}};
    if (method.filter) settings["filter"] = method.name;
    if (options.method == wedge::Method::aaf) {
        settings["aaf_filter"] = to_string(options.filter);
        settings["adaptive"] = options.adaptive;
    }
    if (method.knob == Knob::mu)
        settings["samples_per_pixel"] =
            options.samples_per_pixel ? nlohmann::json(*options.samples_per_pixel) : "by mu";
    return settings;
}

std::string render_arguments(const RenderOptions& options) {
    std::string text = fmt::format("--method {} --sampler {} --seed {}", to_string(options.method),
                                   to_string(options.sampler), options.seed);
    if (options.samples_per_pixel) text += fmt::format(" --spp {}", *options.samples_per_pixel);
    if (options.method == wedge::Method::aaf)
        text += fmt::format(" --mu {:g} --filter {}{}", options.mu.value_or(kDefaultMu),
                            to_string(options.filter), options.adaptive ? "" : " --uniform");
    return text;
}

}  // namespace wedge::converge
