// Chance that is the same everywhere: the distributions of the C++ library differ between
// libraries, a hash of integers does not.
#pragma once

#include <cstdint>

#include "wedge/math.hpp"

namespace wedge::scenes {

/// Bijective mixing of 32 bits (the finaliser of MurmurHash3).
inline uint32_t mix(uint32_t h) {
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

inline uint32_t hash(uint32_t a, uint32_t b) {
    return mix(a + 0x9e3779b9u * (mix(b) + 1));
}
inline uint32_t hash(uint32_t a, uint32_t b, uint32_t c) {
    return hash(hash(a, b), c);
}

/// The upper 24 bits as a float in [0, 1), exactly.
inline float to_unit_float(uint32_t h) {
    return float(h >> 8) * 0x1p-24f;
}

/// A sequence of numbers that depends on the seed and the stream alone. Streams keep things apart:
/// one more sphere does not move the others.
class Random {
  public:
    Random(uint32_t seed, uint32_t stream) : key_(hash(seed, stream)) {}

    uint32_t next() { return hash(key_, counter_++); }
    float uniform(float lower, float upper) {
        return lower + (upper - lower) * to_unit_float(next());
    }
    Vec3 uniform(const Vec3& lower, const Vec3& upper) {
        const float x = uniform(lower.x, upper.x);
        const float y = uniform(lower.y, upper.y);
        const float z = uniform(lower.z, upper.z);
        return {x, y, z};
    }

  private:
    uint32_t key_;
    uint32_t counter_ = 0;
};

}  // namespace wedge::scenes
