// Do two renderers compute the same? Their converged images, block by block.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {
namespace {

constexpr int kChannels = 3;

double mean_of(const Image& image, const std::string& channel) {
    const int c = image.channel(channel);
    const std::size_t stride = image.channels.size();
    double sum = 0;
    for (std::size_t i = std::size_t(c); i < image.pixels.size(); i += stride)
        sum += double(image.pixels[i]);
    return sum / (double(image.width) * image.height);
}

double mean_variance(const Image& image, const char* prefix) {
    double sum = 0;
    for (const char* channel : {"R", "G", "B"})
        sum += mean_of(image, std::string(prefix) + channel) / kChannels;
    return sum;
}

/// Of the two images' pixels; both are linear and have R, G, B first.
double mean_square_difference(const Image& a, const Image& b) {
    const std::size_t stride_a = a.channels.size(), stride_b = b.channels.size();
    const std::size_t pixels = std::size_t(a.width) * a.height;
    double sum = 0;
    for (std::size_t p = 0; p < pixels; ++p)
        for (std::size_t c = 0; c < kChannels; ++c) {
            const double d =
                double(a.pixels[p * stride_a + c]) - double(b.pixels[p * stride_b + c]);
            sum += d * d;
        }
    return sum / (double(pixels) * kChannels);
}

std::vector<OwnError> own_errors(const PeerReference& reference, const std::vector<Curve>& curves) {
    const double noise = mean_variance(reference.image, "variance.");
    std::vector<OwnError> list;
    for (const Curve& curve : curves) {
        if (!curve.method->peer_script ||
            std::strcmp(curve.method->peer_script, reference.method->peer_script) != 0)
            continue;
        for (const Rung& rung : curve.rungs) {
            std::vector<double> errors;
            for (const Image* image : rung.images)
                errors.push_back(root(mean_square_difference(*image, reference.image) - noise));
            list.push_back(
                {curve.method, rung.budget, rung.metrics[0].median, spread_of(errors).median});
        }
    }
    return list;
}

}  // namespace

Agreement agreement_of(const Reference& reference, const PeerReference& peer,
                       const std::vector<Curve>& curves) {
    Agreement a;
    a.method = peer.method;
    a.version = peer.version;
    a.spp = peer.spp;
    a.rmse = std::sqrt(mean_square_difference(reference.mean, peer.image));
    a.rmse_of_noise =
        std::sqrt(mean_variance(reference.variance, "") + mean_variance(peer.image, "variance."));
    const char* const names[kChannels] = {"R", "G", "B"};
    for (int c = 0; c < kChannels; ++c)
        a.ratio_of_means[c] = mean_of(reference.mean, names[c]) / mean_of(peer.image, names[c]);

    RunRecord record;
    record.samples = 1;
    Curve as_curve;
    as_curve.rungs.push_back({{}, 0, {&record}, {&peer.image}, {}});
    a.test = z_test(reference, as_curve);
    a.own_errors = own_errors(peer, curves);
    return a;
}

Image relative_difference(const Reference& reference, const Image& other) {
    const Image& r = reference.mean;
    Image map{r.width, r.height, {"B"}, {}, {}};
    const std::size_t stride = other.channels.size();
    for (std::size_t p = 0; p < std::size_t(r.width) * r.height; ++p) {
        double ours = 0, theirs = 0;
        for (std::size_t c = 0; c < kChannels; ++c) {
            ours += double(r.pixels[p * kChannels + c]) / kChannels;
            theirs += double(other.pixels[p * stride + c]) / kChannels;
        }
        map.pixels.push_back(float((theirs - ours) / (std::max(ours, 0.0) + 0.01)));
    }
    return map;
}

}  // namespace wedge::converge
