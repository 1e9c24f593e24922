// Settings as users write them.
#include <fmt/format.h>

#include "wedge/error.hpp"
#include "wedge/render.hpp"

namespace wedge {

const char* to_string(Sampler sampler) {
    switch (sampler) {
        case Sampler::sobol:
            return "sobol";
        case Sampler::hash:
            return "hash";
        case Sampler::stratified:
            return "stratified";
        case Sampler::lattice:
            return "lattice";
    }
    return "unknown";
}

Sampler parse_sampler(const std::string& name, const std::string& option) {
    std::string known;
    for (Sampler sampler : {Sampler::sobol, Sampler::stratified, Sampler::lattice, Sampler::hash}) {
        if (name == to_string(sampler)) return sampler;
        known += (known.empty() ? "" : ", ") + std::string(to_string(sampler));
    }
    throw Error(ErrorKind::usage,
                fmt::format("{} {}: no such sampler; known: {}", option, name, known));
}

const char* to_string(FilterMode mode) {
    switch (mode) {
        case FilterMode::guarded:
            return "guarded";
        case FilterMode::plain:
            return "plain";
        case FilterMode::none:
            return "none";
    }
    return "unknown";
}

const char* to_string(Method method) {
    return method == Method::aaf ? "aaf" : "mc";
}

}  // namespace wedge
