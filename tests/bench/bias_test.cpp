// Splits, tests and blocks on images whose bias and variance are known.
#include <doctest/doctest.h>

#include <cmath>

#include "bench/converge/blocks.hpp"
#include "tests/bench/approx.hpp"
#include "tests/bench/synthetic.hpp"
#include "wedge/error.hpp"

using namespace wedge;
using namespace wedge::converge;
using test::Synthetic;
using test::SyntheticRung;

namespace {

constexpr int kSide = 128;

std::vector<Image> images(Synthetic& synthetic, int count, double variance, double bias = 0) {
    std::vector<Image> list;
    for (int i = 0; i < count; ++i) list.push_back(synthetic.image(variance, bias));
    return list;
}

}  // namespace

TEST_CASE("error_is_split_into_known_bias_and_variance") {
    Synthetic synthetic(kSide, kSide, 1);
    const Reference reference = synthetic.reference(1e-4);
    SyntheticRung s(images(synthetic, 3, 0.01, 0.2), reference);
    split_errors(reference, s.rung);
    REQUIRE(s.rung.split);
    CHECK(s.rung.split->variance == test::close_to(0.01, 0.03));
    CHECK(s.rung.split->bias_squared == test::close_to(0.04, 0.03));
}

TEST_CASE("unbiased_runs_show_no_bias_in_the_mean") {
    Synthetic synthetic(kSide, kSide, 2);
    const Reference reference = synthetic.reference(1e-3);
    SyntheticRung s(images(synthetic, 4, 0.01), reference);
    split_errors(reference, s.rung);
    CHECK(std::abs(s.rung.split->bias_squared) < 0.03 * 0.01);
    SyntheticRung single(images(synthetic, 1, 0.01), reference);
    split_errors(reference, single.rung);
    CHECK_FALSE(single.rung.split);
}

TEST_CASE("z_test_passes_noise_and_catches_a_bias_below_it") {
    Synthetic synthetic(kSide, kSide, 3);
    const Reference reference = synthetic.reference(1e-3);
    for (const double bias : {0.0, 0.02}) {
        SyntheticRung s(images(synthetic, 3, 0.01, bias), reference);
        // Pooled with runs of four times the samples.
        SyntheticRung longer(images(synthetic, 3, 0.0025, bias), reference);
        for (RunRecord& record : longer.records) record.samples = 4;
        Curve curve;
        curve.rungs = {s.rung, longer.rung};
        const ZTest test = z_test(reference, curve);
        CHECK(test.tests == 3 * (kSide / 8) * (kSide / 8));
        if (bias == 0) {
            // 768 squares: a deviation of 5 %.
            CHECK(test.mean_square_z == test::close_to(1, 0.2));
            CHECK(test.p > 1e-3);
        } else {
            CHECK(test.mean_square_z > 2);
            CHECK(test.p < 1e-3);
        }
    }
}

TEST_CASE("bias_map_shows_five_percent_without_bias_and_most_with_it") {
    Synthetic synthetic(kSide, kSide, 4);
    const Reference reference = synthetic.reference(1e-5);
    SyntheticRung clean(images(synthetic, 8, 0.01), reference);
    SyntheticRung biased(images(synthetic, 8, 0.01, 0.1), reference);
    const auto without = bias_map(reference, clean.rung);
    const auto with = bias_map(reference, biased.rung);
    REQUIRE(without);
    REQUIRE(with);
    // 1024 blocks: a deviation of 0.7 %.
    CHECK(without->share_below_5_percent == test::close_to(0.05, 0.6));
    CHECK(without->significant <= 2);
    CHECK(with->share_below_5_percent > 0.9);
    CHECK(with->significant > with->tests / 2);
}

TEST_CASE("blocks_lose_where_the_error_is_above_the_yardstick_at_equal_time") {
    Synthetic synthetic(kSide, kSide, 5);
    const Reference reference = synthetic.reference(0);
    // Plain Monte Carlo: variance 0.01 / time.
    SyntheticRung at_1(images(synthetic, 2, 0.01), reference, 1);
    SyntheticRung at_4(images(synthetic, 2, 0.0025), reference, 4);
    Curve yardstick;
    yardstick.rungs = {at_1.rung, at_4.rung};
    // At time 2 it has 0.005: half of this one's blocks are far above, half far below.
    Image mixed = synthetic.image(0);
    for (std::size_t p = 0; p < std::size_t(kSide) * kSide; ++p)
        for (std::size_t c = 0; c < 3; ++c)
            mixed.pixels[p * 6 + c] += p % kSide < kSide / 2 ? 0.2f : 0.01f;
    SyntheticRung other({mixed}, reference, 2);
    Curve curve;
    curve.rungs = {other.rung};
    measure_blocks(reference, yardstick, curve);
    CHECK(curve.rungs[0].blocks_worse == test::close_to(0.5, 1e-6));
    CHECK(curve.rungs[0].blocks_twice == test::close_to(0.5, 1e-6));
    // Beyond the yardstick's rungs its error goes on as 1 / time: at 100, 0.01^2 is as much.
    SyntheticRung late({mixed}, reference, 400);
    curve.rungs = {late.rung};
    measure_blocks(reference, yardstick, curve);
    CHECK(curve.rungs[0].blocks_worse == test::close_to(1, 1e-6));
}

TEST_CASE("a_tenth_and_rounding_do_not_make_a_block_worse") {
    Synthetic synthetic(kSide, kSide, 6);
    const Reference reference = synthetic.reference(0);
    const auto worse = [&](float plain, float other) {
        const auto off_by = [&](float difference) {
            Image image = synthetic.image(0);
            for (std::size_t i = 0; i < image.pixels.size(); i += 6)
                for (std::size_t c = 0; c < 3; ++c) image.pixels[i + c] += difference;
            return image;
        };
        SyntheticRung yardstick_rung({off_by(plain)}, reference, 1);
        SyntheticRung rung({off_by(other)}, reference, 1);
        Curve yardstick, curve;
        yardstick.rungs = {yardstick_rung.rung};
        curve.rungs = {rung.rung};
        measure_blocks(reference, yardstick, curve);
        return curve.rungs[0].blocks_worse;
    };
    const float mean = std::sqrt(float(rounding_error(reference))) * 1e4f;
    CHECK(worse(0.1f * mean, 0.105f * mean) == 0);
    CHECK(worse(0.1f * mean, 0.115f * mean) == 1);
    CHECK(worse(1e-6f * mean, 9e-5f * mean) == 0);
    CHECK(worse(1e-6f * mean, 3e-4f * mean) == 1);
}

TEST_CASE("ratios_to_the_yardstick_say_what_was_not_measured") {
    const auto curve_of = [](std::initializer_list<Point> points) {
        Curve curve;
        curve.method = &all_methods()[0];
        for (const Point& p : points) {
            Rung rung;
            rung.time_s = rung.rays = {p.x, p.x, p.x};
            rung.metrics = {{p.y, p.y, p.y}};
            curve.rungs.push_back(rung);
        }
        return curve;
    };
    // Errors 1, 1/2, 1/4 at times 1, 4, 16; the other has 1/2, 1/4 at 2, 8: half the time.
    const std::vector<Curve> curves{curve_of({{1, 1}, {4, 0.5}, {16, 0.25}}),
                                    curve_of({{2, 0.5}, {8, 0.25}})};
    const Comparison c = compare(curves, 0)[1];
    CHECK(c.error_at_equal_time[0].kind == Ratio::late);
    CHECK(c.error_at_equal_time[1].value == test::close_to(std::sqrt(0.5), 1e-6));
    CHECK(c.error_at_equal_time[2].kind == Ratio::at_most);
    CHECK(c.error_at_equal_time[2].value == test::close_to(1, 1e-6));
    CHECK(c.time_at_equal_error[0].kind == Ratio::at_most);
    CHECK(c.time_at_equal_error[0].value == test::close_to(2, 1e-6));
    CHECK(c.time_at_equal_error[1].kind == Ratio::exact);
    CHECK(c.time_at_equal_error[1].value == test::close_to(0.5, 1e-6));
    CHECK(c.time_at_equal_error[2].value == test::close_to(0.5, 1e-6));
    const std::vector<Curve> worse{curves[0], curve_of({{1, 2}, {16, 0.6}})};
    CHECK(compare(worse, 0)[1].time_at_equal_error[1].kind == Ratio::unreached);
}

TEST_CASE("methods_must_have_the_same_settings_in_every_scene") {
    SceneRuns a, b;
    a.name = "a";
    b.name = "b";
    a.runs.resize(1);
    b.runs.resize(1);
    a.runs[0].method = b.runs[0].method = "aaf";
    a.runs[0].settings = {{"k", 3}};
    b.runs[0].settings = {{"k", 4.5}};
    std::vector<SceneAnalysis> scenes(2);
    scenes[0].scene = &a;
    scenes[1].scene = &b;
    CHECK_THROWS_AS(summarise(scenes), Error);
}
