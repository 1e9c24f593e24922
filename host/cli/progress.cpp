#include "host/cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/cli/messages.hpp"
#include "host/cli/text.hpp"

namespace wedge::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kRewriteInterval = 100ms;
constexpr auto kLineInterval = 10s;
constexpr auto kShortestLineInterval = 1s;  // of lines at tenths, so that a short render is brief
constexpr int kBarCells = 30;

std::string bar(double fraction) {
    const int filled = std::clamp(int(fraction * kBarCells), 0, kBarCells);
    return "[" + std::string(filled, '#') + std::string(kBarCells - filled, '.') + "]";
}

}  // namespace

double fraction_done(const Progress& progress, std::optional<double> time_limit_s) {
    double fraction = 0;
    if (progress.samples_total > 0)
        fraction = double(progress.samples_done) / double(progress.samples_total);
    if (time_limit_s && *time_limit_s > 0)
        fraction = std::max(fraction, progress.elapsed_s / *time_limit_s);
    return std::clamp(fraction, 0.0, 1.0);
}

std::string describe_progress(const Progress& progress, std::optional<double> time_limit_s) {
    const double fraction = fraction_done(progress, time_limit_s);
    std::string text = fmt::format("{:3.0f} %", 100 * fraction);
    if (progress.samples_done == 0 || progress.elapsed_s <= 0) return text;
    const double rate = double(progress.samples_done) / progress.elapsed_s;
    const double left_s = fraction > 0 ? progress.elapsed_s * (1 - fraction) / fraction : 0;
    return text +
           fmt::format(", {} samples/s, {} left", text_of_count(rate), text_of_seconds(left_s));
}

ProgressDisplay::~ProgressDisplay() {
    clear_status();
}

void ProgressDisplay::update(const Progress& progress) {
    const double fraction = fraction_done(progress, time_limit_s_);
    if (!is_due(fraction)) return;
    const std::string text = describe_progress(progress, time_limit_s_);
    if (stderr_is_terminal())
        show_status(bar(fraction) + " " + text);
    else
        say(text);
}

bool ProgressDisplay::is_due(double fraction) {
    const auto now = Clock::now();
    const int tenth = int(10 * fraction);
    Clock::duration interval = kRewriteInterval;
    if (!stderr_is_terminal())
        interval = tenth > last_tenth_ ? kShortestLineInterval : kLineInterval;
    if (last_shown_ && now - *last_shown_ < interval) return false;
    last_shown_ = now;
    last_tenth_ = tenth;
    return true;
}

}  // namespace wedge::cli
