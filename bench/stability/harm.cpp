#include "bench/stability/harm.hpp"

#include <algorithm>

#include "bench/stability/luck.hpp"

namespace wedge::stability {
namespace {

struct MarginAndErrors {
    std::vector<double> margins;
    double error = 0, expected = 0;  ///< sums over seeds
};

}  // namespace

BlockYardstick::BlockYardstick(const converge::Reference& reference, const converge::Curve& plain)
    : reference_(reference), rounding_(converge::rounding_error(reference)) {
    for (const converge::Rung& rung : plain.rungs) {
        by_seed_.resize(std::max(by_seed_.size(), rung.images.size()));
        for (std::size_t seed = 0; seed < rung.images.size(); ++seed)
            by_seed_[seed].add(rung.time_s.median,
                               converge::block_errors(reference, *rung.images[seed]));
    }
}

Harm BlockYardstick::harm(const converge::Rung& rung) const {
    const std::size_t seeds = std::min(rung.images.size(), by_seed_.size());
    std::vector<MarginAndErrors> blocks;
    for (std::size_t seed = 0; seed < seeds; ++seed) {
        const converge::BlockErrors errors = converge::block_errors(reference_, *rung.images[seed]);
        blocks.resize(errors.size());
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const double expected = by_seed_[seed].at(i, rung.time_s.median);
            blocks[i].margins.push_back(errors[i] - converge::kTenthMore * expected - rounding_);
            blocks[i].error += errors[i];
            blocks[i].expected += expected;
        }
    }
    Harm harm;
    for (const MarginAndErrors& block : blocks) {
        const double most =
            converge::kTenthMore * std::max(block.expected, 0.0) + double(seeds) * rounding_;
        if (!(block.error > most)) continue;
        harm.seen += 1;
        harm.shown += positive_beyond_luck(block.margins);
    }
    const auto count = double(std::max<std::size_t>(blocks.size(), 1));
    return {harm.seen / count, harm.shown / count};
}

}  // namespace wedge::stability
