// How far a render is: a bar on a terminal, plain lines anywhere else.
#pragma once

#include <chrono>
#include <optional>

#include "wedge/render.hpp"

namespace wedge::cli {

/// On a terminal one line, rewritten at most ten times a second. Elsewhere a line at the start,
/// then at every tenth of the work or every ten seconds, whichever comes first, so that a log shows
/// life without filling up.
class ProgressDisplay {
  public:
    explicit ProgressDisplay(std::optional<double> time_limit_s) : time_limit_s_(time_limit_s) {}
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void update(const Progress& progress);

  private:
    using Clock = std::chrono::steady_clock;

    bool is_due(double fraction);

    std::optional<double> time_limit_s_;
    std::optional<Clock::time_point> last_shown_;
    int last_tenth_ = 0;
};

/// Part of the work that is done, in [0, 1]: of the samples or of the time, whichever ends first.
double fraction_done(const Progress& progress, std::optional<double> time_limit_s);

/// "42 %, 3.10 Msamples/s, 12.3 s left"
std::string describe_progress(const Progress& progress, std::optional<double> time_limit_s);

}  // namespace wedge::cli
