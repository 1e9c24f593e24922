#include "host/image/tone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wedge/error.hpp"

namespace wedge {
namespace image {

/// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a rational fit to the ACES reference
/// transform.
static float narkowicz_filmic(float x) {
    return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

float apply_tone_curve(ToneCurve curve, float radiance) {
    if (!(radiance > 0)) return 0;
    // Beyond this every curve is flat in 8 bits, and infinity / infinity never arises.
    const float x = std::min(radiance, 1e8f);
    switch (curve) {
        case ToneCurve::srgb:
            return std::min(x, 1.0f);
        case ToneCurve::filmic:
            return std::min(narkowicz_filmic(x), 1.0f);
        case ToneCurve::reinhard:
            return x / (1 + x);
    }
    return 0;
}

}  // namespace image

ToneCurve parse_tone_curve(const std::string& name) {
    if (name == "srgb") return ToneCurve::srgb;
    if (name == "filmic") return ToneCurve::filmic;
    if (name == "reinhard") return ToneCurve::reinhard;
    throw Error(ErrorKind::usage,
                fmt::format("no tone curve is called '{}'; choose srgb, filmic or reinhard", name));
}

}  // namespace wedge
