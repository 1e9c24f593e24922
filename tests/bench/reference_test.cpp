// Are references as good as they say, and do they get as good as they must?
#include "bench/converge/reference.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "bench/converge/analysis.hpp"
#include "bench/converge/errors.hpp"
#include "bench/converge/reference_margin.hpp"
#include "bench/converge/report_sections.hpp"
#include "bench/converge/runner.hpp"
#include "bench/stability/suite.hpp"
#include "tests/bench/temporary_folder.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using namespace wedge::converge;
using test::TemporaryFolder;

namespace {

const std::string kGrids = std::string(WEDGE_SOURCE_DIR) + "/scenes/grids.json";

double mean_square_difference(const Image& rgb, const Image& frame) {
    double sum = 0;
    const std::size_t pixels = rgb.pixels.size() / 3, stride = frame.channels.size();
    for (std::size_t p = 0; p < pixels; ++p)
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = double(rgb.pixels[p * 3 + c]) - double(frame.pixels[p * stride + c]);
            sum += d * d;
        }
    return sum / double(rgb.pixels.size());
}

/// Runs that are much better than a reference of few samples.
Config config_with_poor_reference(const std::filesystem::path& folder) {
    Config config;
    config.scenes = {kGrids};
    config.methods = {"mc-sobol"};
    config.budgets = {{16, 64}, {1}, {}};
    config.seeds = 2;
    config.size = "32";
    config.reference_spp = 32;
    config.folder = folder / "out";
    complete(config);
    return config;
}

SceneRuns run_quietly(const Config& config) {
    return run_scene(config, config.scenes[0], {}, [](const std::string&) {});
}

double margin_of(const Config& config, const SceneRuns& scene) {
    std::vector<double> squares;
    for (const RunRecord& run : scene.runs)
        squares.push_back(
            mean_squared_error(read_image(config.folder / run.image), scene.reference));
    return least_median_rmse(scene.runs, squares) /
           std::sqrt(mean_squared_error_of(scene.reference));
}

RunRecord record_of(const char* method, double budget) {
    RunRecord record;
    record.method = method;
    record.budget.value = budget;
    return record;
}

}  // namespace

// Strata must not tie one half to the other.
TEST_CASE("halves_of_a_reference_tell_its_error_with_any_sampler") {
    Scene scene = load_scene(kGrids, {});
    scene.film = {48, 36};
    RenderOptions options;
    options.method = wedge::Method::mc;
    options.sampler = Sampler::sobol;
    options.samples_per_pixel = 4096;
    options.seed = 7;
    const Image truth = render(scene, options).image;
    for (const Sampler sampler :
         {Sampler::hash, Sampler::stratified, Sampler::sobol, Sampler::lattice}) {
        CAPTURE(to_string(sampler));
        const TemporaryFolder folder;
        ReferenceRequest request;
        request.folder = folder.path();
        request.name = "grids";
        request.scene_digest = "digest";
        request.spp = 256;
        request.sampler = sampler;
        const Reference reference = make_reference(scene, request);
        const double ratio =
            mean_squared_error_of(reference) / mean_square_difference(reference.mean, truth);
        CHECK(ratio > 0.75);
        CHECK(ratio < 1.3);
    }
}

// Independent pieces would make it fall with 1 / n.
TEST_CASE("pieces_of_a_reference_complement_each_other") {
    Scene scene = load_scene(kGrids, {});
    scene.film = {48, 36};
    const TemporaryFolder folder;
    ReferenceRequest request;
    request.folder = folder.path();
    request.name = "grids";
    request.scene_digest = "digest";
    request.sampler = Sampler::lattice;
    request.spp = 32;
    const Reference two = make_reference(scene, request);
    REQUIRE(two.piece_samples == 16);
    request.piece_samples = 16;
    request.spp = 32 * 32;
    const Reference more = make_reference(scene, request);
    CHECK(more.spp == uint64_t(request.spp));
    CHECK(mean_squared_error_of(two) / mean_squared_error_of(more) > 1.2 * 32);
}

TEST_CASE("what_a_reference_cannot_judge_is_not_plotted") {
    const TemporaryFolder folder;
    Config config = config_with_poor_reference(folder.path());
    config.budgets.spp = {4, 1024};
    config.reference_spp = 512;
    const SceneRuns scene = run_quietly(config);
    const std::vector<Image> images = read_images(config, scene);
    const SceneAnalysis analysis =
        analyse(config, scene, images, errors_of_runs(config, scene, images));
    const std::vector<Rung>& rungs = analysis.curves[0].rungs;
    REQUIRE(rungs.size() == 2);
    CHECK(rungs[0].is_plotted);
    CHECK_FALSE(rungs[1].is_plotted);
    CHECK_FALSE(analysis.curves[0].by_time);
    const std::string charts = charts_section(analysis);
    CHECK(charts.find("4 spp, ") != std::string::npos);
    CHECK(charts.find("1024 spp, ") == std::string::npos);
    REQUIRE(analysis.warnings.size() == 1);
    CHECK(analysis.warnings[0].find("mc-sobol spp=1024") != std::string::npos);
}

TEST_CASE("a_reference_that_is_too_poor_gets_more_samples") {
    const TemporaryFolder folder;
    Config config = config_with_poor_reference(folder.path());
    const SceneRuns poor = run_quietly(config);
    CHECK(poor.reference.spp == 32);
    REQUIRE(margin_of(config, poor) < kReferenceMargin);

    config.reference_time_s = 300;
    const SceneRuns better = run_quietly(config);
    CHECK(margin_of(config, better) >= kReferenceMargin);
    CHECK(better.reference.time_s > poor.reference.time_s);
    // What is there is kept, and is good enough the next time.
    CHECK(run_quietly(config).reference.id == better.reference.id);
}

TEST_CASE("a_reference_stops_at_the_limits_of_samples_and_of_time") {
    const TemporaryFolder folder;
    Config config = config_with_poor_reference(folder.path());
    config.reference_time_s = 300;
    config.reference_limit = 96;
    CHECK(run_quietly(config).reference.spp == 96);
    config.reference_limit = 65536;
    config.reference_time_s = 1e-6;
    CHECK(run_quietly(config).reference.spp == 96);
}

TEST_CASE("the_least_error_is_that_of_medians_over_seeds") {
    const std::vector<RunRecord> runs = {record_of("a", 1), record_of("a", 1), record_of("a", 1),
                                         record_of("a", 2), record_of("b", 1)};
    CHECK(least_median_rmse(runs, {1, 4, 100, 9, 16}) == doctest::Approx(2));
    CHECK(least_median_rmse(runs, {1, 400, 100, 9, 16}) == doctest::Approx(3));
    CHECK(std::isinf(least_median_rmse({}, {})));
}

TEST_CASE("wanted_samples_bring_the_error_down_by_one_over_n") {
    // Two and a half times better; four times as many samples make five.
    CHECK(samples_wanted(900, 50, 1, 2.5) == 3600);
    CHECK(samples_wanted(900, 256, 1, 2.5) == 4096);
    CHECK(samples_wanted(1024, 256, 1, 7) == 1024);
    CHECK(samples_wanted(1024, 256, 1, 0) == 4096);
}

TEST_CASE("a_reference_shares_its_sampler_with_no_method") {
    const std::string bench = std::string(WEDGE_SOURCE_DIR) + "/bench/";
    for (bool short_form : {false, true}) {
        Config standard, suite;
        read_config(bench + "standard.json", short_form, standard);
        stability::read_suite(bench + "stability.json", short_form, suite);
        for (const Config& config : {standard, suite})
            for (const wedge::converge::Method& method : all_methods()) {
                CAPTURE(method.name);
                if (!method.peer_script && !method.external_source)
                    CHECK(options_for(method, 1, 0).sampler != config.reference_sampler);
            }
    }
}
