// Wall time, and processor time.
#pragma once

#include <chrono>
#include <ctime>

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

/// Of all threads of the process together: what other programs on the machine hardly change.
class CpuStopwatch {
  public:
    double total() const { return now() - start_; }

  private:
    static double now() { return double(std::clock()) / CLOCKS_PER_SEC; }
    double start_ = now();
};

}  // namespace wedge
