#include "bench/stability/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/stability/luck.hpp"
#include "bench/stability/measures.hpp"

namespace wedge::stability {
namespace {

using converge::Curve;
using converge::LogLogCurve;
using converge::Rung;

/// Errors below this share of the image's mean are rounding, and equal.
constexpr double kExact = 1e-4;

/// The yardstick's error at any time.
class ErrorAtTime {
  public:
    ErrorAtTime(const Curve& yardstick, const std::function<double(const Rung&)>& error,
                double least)
        : least_(least) {
        std::vector<converge::Point> points;
        for (const Rung& rung : yardstick.rungs)
            points.push_back({rung.time_s.median, std::max(error(rung), least)});
        curve_ = LogLogCurve(points);
    }

    bool beyond(double time) const {
        return curve_.empty() || time < curve_.points().front().x ||
               time > curve_.points().back().x;
    }

    double ratio(double error, double time) const {
        if (curve_.empty()) return 1;  // neither has any error
        return std::max(error, least_) / at(time);
    }

    /// By how much an error is more than `most` times the yardstick's.
    double margin(double error, double time, double most) const {
        if (curve_.empty()) return 0;
        return std::max(error, least_) - most * at(time);
    }

  private:
    double at(double time) const {
        if (const auto inside = curve_.at(time)) return *inside;
        const converge::Point& end =
            time < curve_.points().front().x ? curve_.points().front() : curve_.points().back();
        return std::max(least_, end.y * std::sqrt(end.x / time));
    }

    LogLogCurve curve_;
    double least_;
};

double rmse_of(const Rung& rung) {
    return rung.metrics[0].median;
}

std::optional<double> predicted_ratio(const Rung& rung) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < rung.runs.size(); ++i) {
        const double truth = converge::root(rung.errors[i].mse);
        if (rung.runs[i]->predicted_rmse >= 0 && truth > 0)
            ratios.push_back(rung.runs[i]->predicted_rmse / truth);
    }
    if (ratios.empty()) return {};
    return converge::quantile(ratios, 0.5);
}

class Judge {
  public:
    Judge(const Recipe& recipe, const converge::SceneAnalysis& scene, const Limits& limits)
        : rule_(recipe.rule),
          reference_(scene.scene->reference),
          limits_(limits),
          yardstick_(scene.curves[scene.yardstick]),
          least_(kExact * mean_of(reference_.mean)),
          rmse_(yardstick_, rmse_of, least_),
          own_(
              yardstick_, [this](const Rung& rung) { return measured(rung); }, own_least()),
          blocks_(reference_, yardstick_) {
        for (std::size_t seed = 0; seed < yardstick_.rungs.front().errors.size(); ++seed)
            rmse_by_seed_.emplace_back(
                yardstick_,
                [seed](const Rung& rung) { return converge::root(rung.errors.at(seed).mse); },
                least_);
    }

    Column column(const Curve& curve) const {
        Column column{&curve, {}};
        for (const Rung& rung : curve.rungs) column.verdicts.push_back(verdict(rung));
        return column;
    }

  private:
    double measured(const Rung& rung) const { return measure(rule_, rung, reference_); }

    double own_least() const { return rule_.measure == Measure::rmse ? least_ : kExact; }

    Verdict verdict(const Rung& rung) const {
        const bool is_yardstick = &rung >= yardstick_.rungs.data() &&
                                  &rung < yardstick_.rungs.data() + yardstick_.rungs.size();
        const double time = rung.time_s.median;
        Verdict v;
        v.rung = &rung;
        v.beyond = rmse_.beyond(time);
        v.rmse_ratio = is_yardstick ? 1 : rmse_.ratio(rmse_of(rung), time);
        v.rmse_holds = v.rmse_ratio <= limits_.rmse_ratio;
        v.rmse_is_worse = !v.rmse_holds && positive_beyond_luck(rmse_margins(rung));
        if (!is_yardstick) v.blocks = blocks_.harm(rung);
        v.blocks_hold = v.blocks.shown <= limits_.blocks_worse;
        v.rule = measured(rung);
        if (is_ratio(rule_.measure)) v.rule = is_yardstick ? 1 : own_.ratio(v.rule, time);
        v.rule_holds = v.rule <= rule_.at_most;
        v.predicted_ratio = predicted_ratio(rung);
        return v;
    }

    /// Seed by seed, as blocks are compared.
    std::vector<double> rmse_margins(const Rung& rung) const {
        std::vector<double> margins;
        for (std::size_t s = 0; s < std::min(rung.errors.size(), rmse_by_seed_.size()); ++s)
            margins.push_back(rmse_by_seed_[s].margin(converge::root(rung.errors[s].mse),
                                                      rung.time_s.median, limits_.rmse_ratio));
        return margins;
    }

    const Rule& rule_;
    const converge::Reference& reference_;
    const Limits& limits_;
    const Curve& yardstick_;
    double least_;
    ErrorAtTime rmse_, own_;
    std::vector<ErrorAtTime> rmse_by_seed_;
    BlockYardstick blocks_;
};

template <typename Get>
double largest(const std::vector<Verdict>& verdicts, const Get& get) {
    double value = 0;
    for (const Verdict& v : verdicts) value = std::max(value, get(v));
    return value;
}

}  // namespace

double Column::worst_ratio() const {
    return largest(verdicts, [](const Verdict& v) { return v.rmse_ratio; });
}

double Column::worst_blocks() const {
    return largest(verdicts, [](const Verdict& v) { return v.blocks.shown; });
}

double Column::worst_rule() const {
    return largest(verdicts, [](const Verdict& v) { return v.rule; });
}

bool Column::limits_hold() const {
    return std::all_of(verdicts.begin(), verdicts.end(),
                       [](const Verdict& v) { return v.limits_hold(); });
}

bool Column::does_harm() const {
    return std::any_of(verdicts.begin(), verdicts.end(),
                       [](const Verdict& v) { return v.does_harm(); });
}

bool Column::rule_holds() const {
    return std::all_of(verdicts.begin(), verdicts.end(),
                       [](const Verdict& v) { return v.rule_holds; });
}

Row judge(const Recipe& recipe, const converge::SceneAnalysis& scene, const Limits& limits) {
    const Judge judge(recipe, scene, limits);
    Row row{&recipe, &scene, {}, judge.column(scene.curves[scene.yardstick])};
    for (std::size_t i = 0; i < scene.curves.size(); ++i)
        if (i != scene.yardstick) row.columns.push_back(judge.column(scene.curves[i]));
    return row;
}

}  // namespace wedge::stability
