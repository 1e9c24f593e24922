// The subcommands of the program. Each adds itself to the app; what it is asked to do runs as a
// CLI11 callback while the command line is parsed, and throws wedge::Error where it cannot be done.
#pragma once

#include <exception>

namespace CLI {
class App;
}

namespace wedge::cli {

void register_render(CLI::App& app);             // render.cpp
void register_devices(CLI::App& app);            // devices.cpp
void register_info(CLI::App& app);               // info.cpp
void register_explain(CLI::App& app);            // explain.cpp
void register_compare(CLI::App& app);            // compare.cpp; needs image support
void register_bench(CLI::App& app);              // bench_trace.cpp; with what the next adds
void register_bench_converge(CLI::App& bench);   // bench_converge.cpp; needs image support
void register_bench_peers(CLI::App& bench);      // bench_peers.cpp; needs image support
void register_bench_stability(CLI::App& bench);  // bench_stability.cpp; needs image support

/// Exit codes beside those of ErrorKind (docs/cli.md).
inline constexpr int kExitInterrupted = 130;  // as shells report SIGINT

/// Thrown when a command was stopped by the user and has saved what there was.
struct Interrupted : std::exception {
    const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace wedge::cli
