// Errors of an image against a reference that has noise of its own.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/converge/reference.hpp"

namespace wedge::converge {

/// Share of pixels, those with the largest errors, that trimmed means leave out: fireflies.
inline constexpr double kTrimmedShare = 0.001;

/// Mean squares have the reference's own mean square subtracted, so they may come out negative
/// where a run is better than the reference; SSIM and FLIP are as measured.
struct Errors {
    double mse = 0, mse_trimmed = 0;
    double rel_mse = 0, rel_mse_trimmed = 0;  ///< (t - r)^2 / (max(r, 0) + 0.01)^2
    double mse_measured = 0;                  ///< nothing subtracted
    double ssim = 0, flip = 0;
    uint64_t non_finite = 0;  ///< pixels left out
};

nlohmann::json to_json(const Errors& errors);
Errors errors_from(const nlohmann::json& object);

/// Throws Error(bad_input) where sizes differ.
Errors measure_errors(const Image& test, const Reference& reference);

/// `Errors::mse` alone, which is quick.
double mean_squared_error(const Image& test, const Reference& reference);

/// Square root for charts; 0 for a mean square that came out negative.
double root(double mean_square);

/// Squared error per pixel, mean over R, G, B, the reference's own subtracted. Row 0 at the top.
std::vector<double> squared_error_map(const Image& test, const Reference& reference);

}  // namespace wedge::converge
