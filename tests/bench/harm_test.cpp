// Harm is told from luck: on images whose error is known.
#include "bench/stability/harm.hpp"

#include <doctest/doctest.h>

#include <memory>

#include "bench/stability/luck.hpp"
#include "bench/stability/verdict.hpp"
#include "tests/bench/approx.hpp"
#include "tests/bench/synthetic.hpp"

using namespace wedge;
using namespace wedge::converge;
using test::Synthetic;
using test::SyntheticRung;

namespace {

constexpr int kWidth = 96, kHeight = 80;  // 30 blocks
constexpr int kSeeds = 8;

/// What filters leave: the same error for all pixels of a block, so that a seed tells little of its
/// variance. `scale` is that of the standard deviation, by block.
template <typename Scale>
Image blotchy(Synthetic& synthetic, std::mt19937& random, double sigma, const Scale& scale) {
    Image image = synthetic.image(0);
    std::normal_distribution<double> noise(0, sigma);
    constexpr int kSide = 8;
    for (int top = 0; top < kHeight; top += kSide)
        for (int left = 0; left < kWidth; left += kSide) {
            const auto error =
                float(noise(random) * scale(std::size_t(top / 16 * (kWidth / 16) + left / 16)));
            for (int y = top; y < top + kSide; ++y)
                for (int x = left; x < left + kSide; ++x)
                    for (int c = 0; c < 3; ++c) image.at(x, y, c) += error;
        }
    return image;
}

/// Plain Monte Carlo with variance 0.01 / time at times 1 and 4, and another method at time 2.
struct Trial {
    Synthetic synthetic;
    std::mt19937 random;
    Reference reference;
    std::vector<std::unique_ptr<std::vector<Image>>> images;  ///< that rungs point to
    Curve plain;

    explicit Trial(unsigned seed)
        : synthetic(kWidth, kHeight, seed), random(seed + 1), reference(synthetic.reference(0)) {
        for (double time_s : {1.0, 4.0})
            plain.rungs.push_back(add(time_s, [](std::size_t) { return 1.0; }));
    }

    /// `scale`: RMSE by block over that of plain Monte Carlo in the same time.
    template <typename Scale>
    Rung add(double time_s, const Scale& scale) {
        images.push_back(std::make_unique<std::vector<Image>>());
        for (int s = 0; s < kSeeds; ++s)
            images.back()->push_back(blotchy(synthetic, random, 0.1 / std::sqrt(time_s), scale));
        Rung rung;
        rung.time_s = {time_s, time_s, time_s};
        for (const Image& image : *images.back()) rung.images.push_back(&image);
        return rung;
    }

    template <typename Scale>
    stability::Harm harm(const Scale& scale) {
        return stability::BlockYardstick(reference, plain).harm(add(2, scale));
    }
};

constexpr int kTrials = 40;
constexpr double kLimit = stability::Limits().blocks_worse;

}  // namespace

TEST_CASE("luck_alone_is_not_taken_for_harm") {
    int passed = 0, passed_if_all_counted = 0;
    for (int i = 0; i < kTrials; ++i) {
        const stability::Harm harm = Trial(unsigned(2 * i)).harm([](std::size_t) { return 1.0; });
        passed += harm.shown <= kLimit;
        passed_if_all_counted += harm.seen <= kLimit;
        CHECK(harm.shown <= harm.seen);
    }
    // Without the test over seeds luck alone fails: this is what the rule is for.
    CHECK(passed_if_all_counted < kTrials / 2);
    CHECK(passed >= kTrials - 2);
}

TEST_CASE("harm_in_a_fifth_of_the_blocks_is_seen") {
    // Six of thirty blocks with twice the RMSE, the others with a tenth: the image as a whole is
    // better than plain Monte Carlo.
    int failed = 0;
    for (int i = 0; i < kTrials; ++i)
        failed += Trial(unsigned(2 * i))
                      .harm([](std::size_t block) { return block % 5 == 0 ? 2.0 : 0.1; })
                      .shown > kLimit;
    CHECK(failed >= kTrials - 2);
}

TEST_CASE("errors_where_plain_monte_carlo_has_none_are_harm") {
    Synthetic synthetic(kWidth, kHeight, 1);
    const Reference reference = synthetic.reference(0);
    const auto images = [&](double bias) {
        std::vector<Image> list;
        for (int s = 0; s < kSeeds; ++s) list.push_back(synthetic.image(0, bias));
        return list;
    };
    SyntheticRung exact(images(0), reference), leaks(images(0.01), reference),
        rounded(images(5e-5), reference);
    Curve plain;
    plain.rungs = {exact.rung};
    const stability::BlockYardstick yardstick(reference, plain);
    CHECK(yardstick.harm(leaks.rung).shown == 1);
    // Below a ten thousandth of the mean, which is 1.
    CHECK(yardstick.harm(rounded.rung).shown == 0);
    CHECK(yardstick.harm(exact.rung).seen == 0);
}

TEST_CASE("one_seed_alone_is_believed") {
    CHECK(stability::positive_beyond_luck(std::vector<double>{0.1}));
    CHECK(!stability::positive_beyond_luck(std::vector<double>{-0.1}));
    CHECK(!stability::positive_beyond_luck(std::vector<double>{}));
}

TEST_CASE("chance_of_taking_luck_for_harm_is_as_stated") {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 1);
    constexpr int kTests = 40000;
    int positive = 0;
    for (int i = 0; i < kTests; ++i) {
        std::vector<double> margins(kSeeds);
        for (double& margin : margins) margin = noise(random);
        positive += stability::positive_beyond_luck(margins);
    }
    // 1000 are expected, with a standard deviation of 31.
    CHECK(positive / double(kTests) == test::close_to(stability::kLevel, 0.12));
    // One rare bright sample in one of the seeds says nothing, however bright.
    CHECK(!stability::positive_beyond_luck(std::vector<double>{-1, -1, -1, 1e6, -1, -1, -1, -1}));
}
