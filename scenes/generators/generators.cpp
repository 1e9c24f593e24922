#include "scenes/generators/generators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/generators/kind.hpp"
#include "wedge/error.hpp"

namespace wedge::scenes {
namespace {

/// Sorted by name.
std::vector<Kind> all_kinds() {
    return {box_kind(),    cornell_kind(), grids_kind(),     plane_kind(),   room_kind(),
            sphere_kind(), spheres_kind(), tentacles_kind(), terrain_kind(), wires_kind()};
}

[[noreturn]] void fail(const std::string& message) {
    throw Error(ErrorKind::bad_input, message);
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

Kind find_kind(const std::string& name) {
    for (auto& kind : all_kinds())
        if (name == kind.name) return kind;
    fail(fmt::format("unknown generator \"{}\"; there are {}", name, joined(generator_kinds())));
}

const Parameter& find_parameter(const Kind& kind, const std::string& name) {
    std::vector<std::string> names;
    for (const auto& parameter : kind.parameters) {
        if (name == parameter.name) return parameter;
        names.push_back(parameter.name);
    }
    fail(fmt::format("generator \"{}\" has no parameter \"{}\"; it has {}", kind.name, name,
                     joined(names)));
}

void check_value(const Kind& kind, const Parameter& parameter, double value) {
    const bool whole = parameter.type == Parameter::Type::integer;
    // Written so that NaN fails.
    const bool inside = value >= parameter.lower && value <= parameter.upper;
    if (inside && (!whole || value == std::floor(value))) return;
    fail(fmt::format("generator \"{}\": {} ({}) must be {} in [{:g}, {:g}], got {:g}", kind.name,
                     parameter.name, parameter.meaning, whole ? "a whole number" : "a number",
                     parameter.lower, parameter.upper, value));
}

}  // namespace

std::vector<std::string> generator_kinds() {
    std::vector<std::string> names;
    for (const auto& kind : all_kinds()) names.push_back(kind.name);
    return names;
}

Mesh generate(const std::string& kind_name, const std::map<std::string, double>& parameters,
              std::vector<Material>& materials) {
    const Kind kind = find_kind(kind_name);
    std::map<std::string, double> values;
    for (const auto& parameter : kind.parameters) values[parameter.name] = parameter.fallback;
    for (const auto& [name, value] : parameters) {
        check_value(kind, find_parameter(kind, name), value);
        values[name] = value;
    }

    Mesh mesh;
    mesh.name = kind.name;
    MeshBuilder builder(mesh, materials, kind.shading);
    kind.build(Values(std::move(values)), builder);
    return mesh;
}

}  // namespace wedge::scenes
