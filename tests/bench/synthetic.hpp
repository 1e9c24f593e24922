// Images of known truth, noise and bias.
#pragma once

#include <random>

#include "bench/converge/analysis.hpp"

namespace wedge::test {

/// R, G, B (and variance.R, G, B if it is positive) around `truth`, which rises across the image.
class Synthetic {
  public:
    Synthetic(int width, int height, unsigned seed)
        : width_(width), height_(height), random_(seed) {}

    double truth(std::size_t pixel) const { return 0.5 + double(pixel % width_) / width_; }

    Image image(double variance, double bias = 0) {
        std::normal_distribution<double> noise(0, std::sqrt(variance));
        Image out{
            width_, height_, {"R", "G", "B", "variance.R", "variance.G", "variance.B"}, {}, {}};
        for (std::size_t p = 0; p < std::size_t(width_) * height_; ++p) {
            for (int c = 0; c < 3; ++c)
                out.pixels.push_back(float(truth(p) + bias + noise(random_)));
            for (int c = 0; c < 3; ++c) out.pixels.push_back(float(variance));
        }
        return out;
    }

    /// Each half with twice `variance`, so that their mean has `variance`.
    converge::Reference reference(double variance) {
        converge::Reference r;
        r.half_a = rgb_of(image(2 * variance));
        r.half_b = rgb_of(image(2 * variance));
        r.mean = r.variance = r.half_a;
        for (std::size_t i = 0; i < r.mean.pixels.size(); ++i) {
            r.mean.pixels[i] = 0.5f * (r.half_a.pixels[i] + r.half_b.pixels[i]);
            r.variance.pixels[i] = float(variance);
        }
        r.spp = 1;
        r.id = "synthetic";
        return r;
    }

    static Image rgb_of(const Image& image) {
        Image out{image.width, image.height, {"R", "G", "B"}, {}, {}};
        for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
            out.pixels.insert(out.pixels.end(), &image.pixels[i], &image.pixels[i] + 3);
        return out;
    }

  private:
    int width_, height_;
    std::mt19937 random_;
};

/// A rung whose runs have these images; keeps what the rung points to.
struct SyntheticRung {
    std::vector<Image> images;
    std::vector<converge::RunRecord> records;
    converge::Rung rung;

    SyntheticRung(std::vector<Image> from, const converge::Reference& reference, double time_s = 1)
        : images(std::move(from)), records(images.size()) {
        for (std::size_t i = 0; i < images.size(); ++i) {
            records[i].samples = 1;
            records[i].time_s = time_s;
            rung.images.push_back(&images[i]);
            rung.runs.push_back(&records[i]);
            rung.errors.push_back(converge::measure_errors(images[i], reference));
        }
        rung.time_s = {time_s, time_s, time_s};
    }
    SyntheticRung(const SyntheticRung&) = delete;
};

}  // namespace wedge::test
