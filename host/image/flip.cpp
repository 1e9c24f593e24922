#include "host/image/flip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/base/parallel.hpp"
#include "host/image/color_spaces.hpp"

namespace wedge::image {
namespace {

using std::numbers::pi;

constexpr float kQc = 0.7f;               // exponent of the colour difference
constexpr float kPc = 0.4f;               // share of the colour range mapped linearly ...
constexpr float kPt = 0.95f;              // ... to this share of [0, 1]
constexpr float kQf = 0.5f;               // exponent of the feature difference
constexpr double kEdgeWidth_deg = 0.082;  // w

/// A Gaussian of the contrast sensitivity functions, a sqrt(pi / b) exp(-pi^2 x^2 / b), x in
/// degrees.
struct SensitivityTerm {
    double a, b;
};
constexpr SensitivityTerm kAchromatic{1, 0.0047};
constexpr SensitivityTerm kRedGreen{1, 0.0053};
constexpr SensitivityTerm kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

double sigma_px(SensitivityTerm term) {
    return std::sqrt(term.b / (2 * pi * pi)) * kFlipPixelsPerDegree;
}

/// The paper cuts all three filters at three deviations of the widest.
int sensitivity_radius_px() {
    return int(std::ceil(3 * sigma_px(kBlueYellow[0])));
}

Plane<float> blur(const Plane<float>& plane, SensitivityTerm term) {
    // Beyond six deviations the weights are below float32's resolution of the sum.
    const int radius = std::min(sensitivity_radius_px(), int(std::ceil(6 * sigma_px(term))));
    const auto weights = gaussian_weights<float>(sigma_px(term), radius);
    return filter_separable(plane, weights, weights, Border::nearest);
}

/// Sum over the filter's support of one term in two dimensions, before it is scaled to 1.
double weight_of(SensitivityTerm term) {
    double line = 0;
    const int radius = sensitivity_radius_px();
    for (int x = -radius; x <= radius; ++x) {
        const double x_deg = x / kFlipPixelsPerDegree;
        line += std::exp(-pi * pi * x_deg * x_deg / term.b);
    }
    return term.a * std::sqrt(pi / term.b) * line * line;
}

/// The eye's contrast sensitivity at this viewing distance (Sec. 4.1.1).
Planes filter_by_sensitivity(const Planes& ycxcz) {
    Plane<float> cz = blur(ycxcz[2], kBlueYellow[0]);
    const Plane<float> narrow = blur(ycxcz[2], kBlueYellow[1]);
    const double wide_weight = weight_of(kBlueYellow[0]), narrow_weight = weight_of(kBlueYellow[1]);
    const float share = float(wide_weight / (wide_weight + narrow_weight));
    for (std::size_t i = 0; i < cz.values.size(); ++i)
        cz.values[i] = share * cz.values[i] + (1 - share) * narrow.values[i];
    return {blur(ycxcz[0], kAchromatic), blur(ycxcz[1], kRedGreen), std::move(cz)};
}

/// L*a*b* with chroma that fades in the dark (the Hunt effect, Sec. 4.1.2).
Colour hunt_lab(Colour rgb) {
    for (float& value : rgb) value = std::clamp(value, 0.0f, 1.0f);
    Colour lab = lab_from_rgb(rgb);
    lab[1] *= 0.01f * lab[0];
    lab[2] *= 0.01f * lab[0];
    return lab;
}

/// Abasi et al. 2020: city-block in lightness, Euclidean in chroma.
float hyab(const Colour& p, const Colour& q) {
    const float da = p[1] - q[1], db = p[2] - q[2];
    return std::abs(p[0] - q[0]) + std::sqrt(da * da + db * db);
}

/// Compresses large differences: kPc of the range takes kPt of the scale (Sec. 4.1.3).
float redistribute(float difference, float largest) {
    const float knee = kPc * largest;
    return difference < knee ? kPt / knee * difference
                             : kPt + (difference - knee) / (largest - knee) * (1 - kPt);
}

/// First or second derivative of a Gaussian, its positive and its negative part each scaled to 1.
std::vector<float> derivative_weights(int order, double sigma, int radius) {
    std::vector<double> weights;
    double positive = 0, negative = 0;
    for (int x = -radius; x <= radius; ++x) {
        const double gaussian = std::exp(-0.5 * x * x / (sigma * sigma));
        const double w = order == 1 ? -x * gaussian : (x * x / (sigma * sigma) - 1) * gaussian;
        weights.push_back(w);
        (w > 0 ? positive : negative) += std::abs(w);
    }
    std::vector<float> scaled;
    for (double w : weights) scaled.push_back(float(w / (w > 0 ? positive : negative)));
    return scaled;
}

/// Strength of edges (order 1) or points (order 2) in lightness (Sec. 4.2).
Plane<float> features(const Plane<float>& lightness, int order) {
    const double sigma = 0.5 * kEdgeWidth_deg * kFlipPixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    const auto smooth = gaussian_weights<float>(sigma, radius);
    const auto derivative = derivative_weights(order, sigma, radius);
    Plane<float> across = filter_separable(lightness, derivative, smooth, Border::nearest);
    const Plane<float> down = filter_separable(lightness, smooth, derivative, Border::nearest);
    for (std::size_t i = 0; i < across.values.size(); ++i)
        across.values[i] =
            std::sqrt(across.values[i] * across.values[i] + down.values[i] * down.values[i]);
    return across;
}

template <typename Body>
void for_pixels(const Plane<float>& like, const Body& body) {
    parallel_ranges(like.values.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}

Colour pixel(const Planes& planes, std::size_t i) {
    return {planes[0].values[i], planes[1].values[i], planes[2].values[i]};
}

Planes ycxcz_of(const Planes& rgb) {
    Planes result = rgb;
    for_pixels(rgb[0], [&](std::size_t i) {
        const Colour colour = ycxcz_from_rgb(pixel(rgb, i));
        for (std::size_t c = 0; c < 3; ++c) result[c].values[i] = colour[c];
    });
    return result;
}

/// What the two pipelines of the paper take from one image.
struct Perceived {
    Planes filtered;  ///< YCxCz as the eye resolves it
    Plane<float> edges, points;
};

Perceived perceive(const Planes& rgb) {
    const Planes ycxcz = ycxcz_of(rgb);
    Plane<float> lightness = ycxcz[0];
    for (float& value : lightness.values) value = (value + 16) / 116;
    return {filter_by_sensitivity(ycxcz), features(lightness, 1), features(lightness, 2)};
}

}  // namespace

Plane<float> ldr_flip_map(const Planes& test, const Planes& reference) {
    const Perceived t = perceive(test), r = perceive(reference);
    // Green against blue is the largest difference there is.
    const float largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kQc);
    Plane<float> map(reference[0].width, reference[0].height);
    for_pixels(map, [&](std::size_t i) {
        const float colour =
            redistribute(std::pow(hyab(hunt_lab(rgb_from_ycxcz(pixel(t.filtered, i))),
                                       hunt_lab(rgb_from_ycxcz(pixel(r.filtered, i)))),
                                  kQc),
                         largest);
        const float edges = std::abs(t.edges.values[i] - r.edges.values[i]);
        const float points = std::abs(t.points.values[i] - r.points.values[i]);
        const float feature = std::pow(std::max(edges, points) / std::numbers::sqrt2_v<float>, kQf);
        map.values[i] = std::pow(colour, 1 - std::clamp(feature, 0.0f, 1.0f));
    });
    return map;
}

}  // namespace wedge::image
