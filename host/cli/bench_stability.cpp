// wedge bench stability: scenes where filters are known to go wrong (docs/stability.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "bench/stability/session.hpp"
#include "host/cli/bench_options.hpp"
#include "host/cli/command_text.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/image_support.hpp"
#include "host/cli/messages.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

/// As typed; what is left out comes from the suite's file.
struct StabilityArguments : MeasuringArguments {
    StabilityArguments() { folder = "stability"; }
    std::vector<std::string> recipes;
    std::string suite = "bench/stability.json", markdown;
    bool short_form = false, cpu_clock = false;
};

converge::Config make_config(const StabilityArguments& a, const std::string& command,
                             stability::Suite& suite) {
    converge::Config config;
    suite = stability::read_suite(a.suite, a.short_form, config);
    stability::keep_only(a.recipes, suite);
    if (!a.methods.empty()) config.methods = a.methods;
    // Without plain Monte Carlo there is nothing to compare with.
    if (config.methods.front() != "mc-sobol") {
        std::erase(config.methods, "mc-sobol");
        config.methods.insert(config.methods.begin(), "mc-sobol");
    }
    config.estimate_errors = true;
    config.cpu_clock = a.cpu_clock;
    config.command = command;
    take_measuring_arguments(a, config);
    return config;
}

void run(const StabilityArguments& arguments, const std::string& command) {
    stability::Suite suite;
    converge::Config config = make_config(arguments, command, suite);
    if (!arguments.markdown.empty()) check_output(arguments.markdown);
    measure_until_stopped(config, arguments, [&](const LoadOptions& load) {
        const stability::Outcome outcome = stability::run_suite(
            suite, config, load, arguments.markdown, [](const std::string& line) { say(line); });
        for (const std::string& warning : outcome.warnings) log_warning(warning);
        fmt::print("{}{}\n{}\n", outcome.table, outcome.results.string(), outcome.report.string());
        std::fflush(stdout);
    });
}

}  // namespace

void register_bench_stability(CLI::App& bench) {
    CLI::App* command =
        bench.add_subcommand("stability", "Scenes where filters are known to go wrong");
    auto a = std::make_shared<StabilityArguments>();
    command->add_option("recipes", a->recipes,
                        "Ids or scenes of the suite (F02, wires, …); default: all");
    command->add_option("--suite", a->suite, "The table of recipes; default: bench/stability.json");
    command->add_flag("--short", a->short_form,
                      "The table's short form: fewer budgets, poorer references");
    add_list(*command, "--methods", a->methods,
             "Beside mc-sobol, separated by commas: " + converge::method_names() +
                 "; default: the table's");
    add_budgets(*command, *a,
                "Ladder, as spp=4,16,64 or mu=0.25,1,4; repeatable; default: the table's");
    command->add_option("--seeds", a->seeds, "Runs of each; default: the table's");
    command->add_option("--reference-spp", a->reference_spp,
                        "Samples per pixel of references; default: the table's");
    command->add_option("-o,--output", a->folder, "Folder of runs and report; default: stability");
    command->add_option("--references", a->references,
                        "Folder of references, to share them; default: that of --output");
    command->add_option("--markdown", a->markdown, "Write tables to this file too");
    command->add_flag("--cpu-clock", a->cpu_clock,
                      "Count processor time over compute units instead of wall time: for CPUs that "
                      "others use too");
    add_measuring_options(*command, *a);
    command->callback([a, command] { run(*a, command_text(*command)); });
}

}  // namespace wedge::cli
