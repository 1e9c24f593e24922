// Ctrl-C asks a render to end early and keep what it has; a second one ends the program at once.
#pragma once

#include <signal.h>

#include <atomic>

namespace wedge::cli {

/// While one of these lives, the first SIGINT or SIGTERM sets `requested()` and says so on stderr,
/// and hands the signals back to their default, so that the second one kills. A SIGINT that the
/// parent chose to ignore (a background job) stays ignored.
class InterruptScope {
  public:
    InterruptScope();
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;

    static const std::atomic<bool>& requested();

  private:
    struct sigaction old_interrupt_ {};
    struct sigaction old_terminate_ {};
};

}  // namespace wedge::cli
