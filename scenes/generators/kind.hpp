// What a kind of generated geometry is to `generate`: a table of parameters and a function.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "scenes/generators/mesh_builder.hpp"

namespace wedge::scenes {

struct Parameter {
    enum class Type { real, integer };

    const char* name;
    double fallback;      ///< used where the scene says nothing
    double lower, upper;  ///< range, both ends allowed
    const char* meaning;  ///< with its unit
    Type type = Type::real;
};

inline constexpr Parameter::Type kInteger = Parameter::Type::integer;

/// Bounds of a length in world units: wide enough for any unit, narrow enough that squares of
/// lengths stay normal floats.
inline constexpr double kShortest = 1e-9;
inline constexpr double kLongest = 1e9;
inline constexpr double kLargestSeed = 4294967295.0;

/// A value for every parameter of a kind, checked.
class Values {
  public:
    explicit Values(std::map<std::string, double> values) : values_(std::move(values)) {}

    float real(const char* name) const { return float(values_.at(name)); }
    int integer(const char* name) const { return int(values_.at(name)); }
    uint32_t seed() const { return uint32_t(values_.at("seed")); }

  private:
    std::map<std::string, double> values_;
};

struct Kind {
    const char* name;
    Shading shading;
    std::vector<Parameter> parameters;
    void (*build)(const Values&, MeshBuilder&);
};

Kind box_kind();
Kind cornell_kind();
Kind grids_kind();
Kind plane_kind();
Kind room_kind();
Kind sphere_kind();
Kind spheres_kind();
Kind tentacles_kind();
Kind terrain_kind();
Kind wires_kind();

}  // namespace wedge::scenes
