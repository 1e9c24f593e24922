// How far an image is from the truth, estimated while it is rendered.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wedge/math.hpp"
#include "wedge/render.hpp"
#include "wedge/shared/frame.h"

namespace wedge::rendering {

/// Of plain Monte Carlo with any sampler, from the image at rising powers of two of its samples.
///
/// Let V(n) be the mean squared error with n samples a pixel. The image with 2n is the mean of two
/// halves that are alike, so E[(image(2n) - image(n))^2] = V(n) - V(2n), whether or not the halves
/// are independent. If V falls as n^-p, such differences tell p, and with it V. Two in a row are
/// added, because points of a Sobol sequence are best at powers of four. Variances of samples
/// within pixels would not do: stratified samples are better than these say.
class ErrorEstimate {
  public:
    explicit ErrorEstimate(Sampler sampler) : sampler_(sampler) {}

    /// The sums of all pixels, with `samples` in each: powers of two, each twice the last.
    void add(uint32_t samples, std::span<const shared::FilmPixel> film);

    /// With so many samples, at least as many as were added last. Nothing before the first add().
    std::optional<EstimatedError> at(uint32_t samples) const;

    /// Samples that the target takes by what is known now.
    double samples_for(double target, ErrorMetric metric) const;

  private:
    struct Change {
        double mse = 0, rel_mse = 0;
    };
    /// Of two changes in a row: from n to 4 n.
    double two_from(std::size_t first, double Change::*metric) const;
    double rate(double Change::*metric) const;
    double level(double Change::*metric) const;

    Sampler sampler_;
    uint32_t samples_ = 0;
    std::vector<float> mean_;  ///< R, G, B of all pixels at the last add()
    Change sampled_;           ///< from the variance of samples, until there is a difference
    std::vector<Change> changes_;
};

/// Of two parts of an image, by their pixels.
EstimatedError joined(const EstimatedError& a, double pixels_a, const EstimatedError& b,
                      double pixels_b);

/// Of a filtered image, from the mean square errors of its pixels (told_error.hpp). `film` has the
/// filtered light in its place.
EstimatedError estimate_of_filtered(std::span<const shared::FilmPixel> film,
                                    std::span<const Vec3> squares);

}  // namespace wedge::rendering
