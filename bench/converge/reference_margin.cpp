#include "bench/converge/reference_margin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/converge/errors.hpp"
#include "bench/converge/statistics.hpp"
#include "wedge/image_io.hpp"

namespace wedge::converge {
namespace {

/// Images one at a time: there may be hundreds.
std::vector<double> mean_squares(const Config& config, const std::vector<RunRecord>& runs,
                                 const Reference& reference) {
    std::vector<double> squares;
    for (const RunRecord& run : runs)
        squares.push_back(mean_squared_error(read_image(config.folder / run.image), reference));
    return squares;
}

}  // namespace

double least_median_rmse(const std::vector<RunRecord>& runs,
                         const std::vector<double>& mean_squares) {
    std::map<std::pair<std::string, double>, std::vector<double>> rungs;
    for (std::size_t i = 0; i < runs.size(); ++i)
        rungs[{runs[i].method, runs[i].budget.value}].push_back(root(mean_squares[i]));
    double least = INFINITY;
    for (const auto& [rung, errors] : rungs) least = std::min(least, spread_of(errors).median);
    return least;
}

uint64_t samples_wanted(uint64_t spp, int piece_samples, double own_rmse, double least_rmse) {
    const double ratio = kReferenceMargin * own_rmse / std::max(least_rmse, 1e-30);
    const double growth = std::min(ratio * ratio, kLargestGrowth);
    const double pairs = std::ceil(double(spp) * growth / (2.0 * piece_samples));
    return std::max(spp, uint64_t(pairs) * 2 * uint64_t(piece_samples));
}

void improve_reference(const Config& config, const std::vector<RunRecord>& runs,
                       const std::function<Reference(uint64_t spp)>& more,
                       const std::function<void(const std::string&)>& say, Reference& reference) {
    if (runs.empty()) return;
    while (reference.time_s < config.reference_time_s) {
        const double own = std::sqrt(mean_squared_error_of(reference));
        const double least = least_median_rmse(runs, mean_squares(config, runs, reference));
        const uint64_t wanted =
            std::min(samples_wanted(reference.spp, reference.piece_samples, own, least),
                     uint64_t(config.reference_limit));
        if (wanted <= reference.spp) return;
        say(fmt::format(
            "reference: its error is {:.2g}, the least of the runs {:.2g}; it gets up to "
            "{} samples per pixel",
            own, least, wanted));
        const uint64_t before = reference.spp;
        reference = more(wanted);
        if (reference.spp == before) return;
    }
}

}  // namespace wedge::converge
