#include "host/cli/interrupt.hpp"

#include <unistd.h>

#include <string_view>

namespace wedge::cli {
namespace {

std::atomic<bool> is_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

constexpr std::string_view kNotice =
    "\nwedge: stopping after this batch, the image so far is kept; once more to quit at once\n";

// Only what POSIX allows in a signal handler.
void on_signal(int) {
    is_requested = true;
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kNotice.data(), kNotice.size());
}

void catch_signal(int number, struct sigaction& old) {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(number, nullptr, &old);
    if (old.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
}

}  // namespace

InterruptScope::InterruptScope() {
    is_requested = false;
    catch_signal(SIGINT, old_interrupt_);
    catch_signal(SIGTERM, old_terminate_);
}

InterruptScope::~InterruptScope() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
}

const std::atomic<bool>& InterruptScope::requested() {
    return is_requested;
}

}  // namespace wedge::cli
