// Wall time.
#pragma once

#include <chrono>

namespace wedge {

class Stopwatch {
  public:
    /// Seconds since the start or the last lap.
    double lap() {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - lap_).count();
        lap_ = now;
        return seconds;
    }
    /// Seconds since the start.
    double total() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lap_ = start_;
};

}  // namespace wedge
