// From finished runs to what tables and charts show. Everything is computed from images and records
// on the disk, so a report can be made again without rendering.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/converge/errors.hpp"
#include "bench/converge/runner.hpp"
#include "bench/converge/statistics.hpp"

namespace wedge::converge {

/// A number per run, smaller is better.
struct Metric {
    const char* name;     ///< "rmse"
    const char* label;    ///< for people
    const char* formula;  ///< for people
    double (*value)(const Errors&);
};
std::span<const Metric> all_metrics();  ///< the first is the one tables go by: RMSE

/// Runs of one method with one budget.
struct Rung {
    Budget budget;
    double knob = 0;
    std::vector<const RunRecord*> runs;
    std::vector<const Image*> images;
    std::vector<Errors> errors;
    Spread time_s, rays, samples_per_pixel;
    std::vector<Spread> metrics;  ///< in the order of all_metrics()
    /// False if the median RMSE is less than kReferenceMargin times the reference's own: tables
    /// have it, charts and fits do not.
    bool is_plotted = true;

    /// Mean squared error over seeds, and its parts; nothing with a single seed. `bias_squared` is
    /// unbiased, so that it may be slightly negative.
    struct Split {
        double mse = 0, bias_squared = 0, variance = 0;
    };
    std::optional<Split> split;

    /// Share of 16 x 16 blocks with more than 1.1 times the RMSE that the yardstick would have in
    /// the same time, and with more than twice its mean squared error; rounding does not count.
    double blocks_worse = 0, blocks_twice = 0;
};

/// Is the mean of an unfiltered method the reference's? All its runs are pooled; blocks of 8 x 8.
struct ZTest {
    std::size_t tests = 0;        ///< blocks times channels
    double mean_square_z = 0;     ///< 1 for independent samples, less for stratified ones
    double largest_z = 0, p = 0;  ///< p: of the largest, corrected for the number of tests (Sidak)
};

/// Where does a filtered method's mean differ from the reference? At its highest budget, blocks of
/// 4 x 4, Welch's test.
struct BiasMap {
    Image relative;  ///< one channel "B": (mean - reference) / (reference + 0.01) of luminance
    std::size_t tests = 0;
    double share_below_5_percent = 0;  ///< of p-values; 5 % where there is no bias
    std::size_t significant = 0;       ///< blocks at level 5 % after Sidak's correction
};

struct Curve {
    const Method* method = nullptr;
    std::vector<Rung> rungs;
    std::optional<PowerLaw> by_time, by_rays;  ///< of RMSE, through all runs that are plotted
    std::optional<ZTest> z_test;
    std::optional<BiasMap> bias_map;

    LogLogCurve rmse_by_time() const, rmse_by_rays() const;  ///< of medians
};

/// A ratio to the yardstick; below 1 is better than it.
struct Ratio {
    enum Kind {
        exact,
        at_most,
        unreached,  ///< the error, by no budget
        late,       ///< the smallest budget takes longer
        unknown
    } kind = unknown;
    bool has_value() const { return kind == exact || kind == at_most; }
    double value = 0;
};

/// At each rung of the yardstick: same time, error over the yardstick's; same error, time and rays
/// over the yardstick's. By interpolation, straight in log-log, never beyond what was measured.
struct Comparison {
    const Method* method = nullptr;
    std::vector<Ratio> error_at_equal_time, time_at_equal_error, rays_at_equal_error;
};

/// A peer's error by two measures; medians over seeds.
struct OwnError {
    const Method* method = nullptr;
    Budget budget;
    double to_reference = 0, to_own = 0;  ///< RMSE: to Wedge's reference, to the peer's
};

/// Wedge's reference beside that of another renderer.
struct Agreement {
    const Method* method = nullptr;
    std::string version;
    int spp = 0;
    double rmse = 0;
    double rmse_of_noise = 0;              ///< what the noise of both would make it
    double ratio_of_means[3] = {0, 0, 0};  ///< R, G, B: Wedge over peer
    ZTest test;
    std::vector<OwnError> own_errors;
};

struct SceneAnalysis {
    const SceneRuns* scene = nullptr;
    double reference_rmse = 0;  ///< estimated
    double smallest_rmse = 0;   ///< of medians, plotted or not
    std::vector<Curve> curves;
    std::size_t yardstick = 0;  ///< index into curves
    std::vector<Comparison> comparisons;
    std::vector<Agreement> agreements;
    std::vector<std::string> warnings;
};

/// Over all scenes, at one rung of the yardstick.
struct Summary {
    double geometric_mean = 0;  ///< of exact ratios and bounds
    std::size_t scenes = 0, unreached = 0;
    Ratio worst;
    std::string worst_scene;
};
struct MethodSummary {
    const Method* method = nullptr;
    std::vector<Summary> error_at_equal_time, time_at_equal_error;
};

struct Analysis {
    std::vector<SceneAnalysis> scenes;
    std::vector<MethodSummary> summaries;
    std::vector<Budget> yardstick_budgets;
};

/// Images of the runs of a scene, in the order of `SceneRuns::runs`.
std::vector<Image> read_images(const Config& config, const SceneRuns& scene);

/// Errors of all runs; those found in `folder`/errors.jsonl for the same reference are not computed
/// again.
std::vector<Errors> errors_of_runs(const Config& config, const SceneRuns& scene,
                                   const std::vector<Image>& images);

SceneAnalysis analyse(const Config& config, const SceneRuns& scene,
                      const std::vector<Image>& images, const std::vector<Errors>& errors);

/// Throws Error(internal) where a method did not run with the same settings in every scene.
Analysis summarise(std::vector<SceneAnalysis> scenes);

/// (other - reference) / (reference + 0.01) of the mean of R, G, B; one channel, "B".
Image relative_difference(const Reference& reference, const Image& other);

// The parts of `analyse`, each in its file.
void measure_blocks(const Reference& reference, const Curve& yardstick, Curve& curve);
void split_errors(const Reference& reference, Rung& rung);
ZTest z_test(const Reference& reference, const Curve& curve);
std::optional<BiasMap> bias_map(const Reference& reference, const Rung& rung);
Agreement agreement_of(const Reference& reference, const PeerReference& peer,
                       const std::vector<Curve>& curves);
std::vector<Comparison> compare(const std::vector<Curve>& curves, std::size_t yardstick);

}  // namespace wedge::converge
