// wedge bench stability: scenes where filters are known to go wrong (docs/stability.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "bench/stability/session.hpp"
#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/messages.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

/// As typed; what is left out comes from the suite's file.
struct StabilityArguments {
    std::vector<std::string> recipes, methods, budgets, asset_paths;
    std::string suite = "bench/stability.json", folder = "stability", references, markdown;
    std::string device, kernel_dir;
    std::optional<int> seeds, reference_spp;
    bool short_form = false, any_build = false, cpu_clock = false;
};

std::string command_line(const StabilityArguments& a) {
    std::string text = "wedge bench stability";
    for (const std::string& recipe : a.recipes) text += " " + recipe;
    if (a.short_form) text += " --short";
    if (!a.methods.empty()) text += fmt::format(" --methods {}", fmt::join(a.methods, ","));
    if (a.cpu_clock) text += " --cpu-clock";
    for (const std::string& budgets : a.budgets) text += " --budgets " + budgets;
    if (a.seeds) text += fmt::format(" --seeds {}", *a.seeds);
    if (a.reference_spp) text += fmt::format(" --reference-spp {}", *a.reference_spp);
    return text;
}

converge::Config make_config(const StabilityArguments& a, stability::Suite& suite) {
    converge::Config config;
    suite = stability::read_suite(a.suite, a.short_form, config);
    stability::keep_only(a.recipes, suite);
    if (!a.methods.empty()) config.methods = a.methods;
    // Without plain Monte Carlo there is nothing to compare with.
    if (config.methods.front() != "mc-sobol") {
        std::erase(config.methods, "mc-sobol");
        config.methods.insert(config.methods.begin(), "mc-sobol");
    }
    for (const std::string& text : a.budgets) converge::parse_budgets(text, config.budgets);
    if (a.seeds) config.seeds = *a.seeds;
    if (a.reference_spp) config.reference_spp = *a.reference_spp;
    config.folder = a.folder;
    config.references = a.references;
    config.device = a.device;
    config.kernel_dir = a.kernel_dir;
    config.any_build = a.any_build;
    config.estimate_errors = true;
    config.cpu_clock = a.cpu_clock;
    config.command = command_line(a);
    return config;
}

void run(const StabilityArguments& arguments) {
    stability::Suite suite;
    converge::Config config = make_config(arguments, suite);
    const LoadOptions load = load_options(arguments.asset_paths);
    const InterruptScope interrupt;
    config.stop = &InterruptScope::requested();
    try {
        const stability::Outcome outcome = stability::run_suite(
            suite, config, load, arguments.markdown, [](const std::string& line) { say(line); });
        for (const std::string& warning : outcome.warnings) log_warning(warning);
        fmt::print("{}{}\n{}\n", outcome.table, outcome.results.string(), outcome.report.string());
        std::fflush(stdout);
    } catch (const converge::Stopped&) {
        say("stopped; the same command goes on from here");
        throw Interrupted{};
    }
}

}  // namespace

void register_bench_stability(CLI::App& bench) {
    CLI::App* command =
        bench.add_subcommand("stability", "Scenes where filters are known to go wrong");
    auto a = std::make_shared<StabilityArguments>();
    command->add_option("recipes", a->recipes,
                        "Ids or scenes of the suite (F02, wires, …); default: all");
    command->add_option("--suite", a->suite, "The table of recipes; default: bench/stability.json");
    command->add_flag("--short", a->short_form, "Fewer budgets and seeds");
    command
        ->add_option("--methods", a->methods,
                     "Beside mc-sobol, separated by commas: " + converge::method_names() +
                         "; default: the table's")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--budgets", a->budgets,
                     "Ladder, as spp=4,16,64 or mu=0.25,1,4; repeatable; default: the table's")
        ->allow_extra_args(false);
    command->add_option("--seeds", a->seeds, "Runs of each; default: the table's");
    command->add_option("--reference-spp", a->reference_spp,
                        "Samples per pixel of references; default: the table's");
    command->add_option("-o,--output", a->folder, "Folder of runs and report; default: stability");
    command->add_option("--references", a->references,
                        "Folder of references, to share them; default: that of --output");
    command->add_option("--markdown", a->markdown, "Write tables to this file too");
    command->add_option("--asset-path", a->asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command->add_option("--device", a->device, "Index, part of a name, cpu or gpu");
    command->add_option("--kernel-dir", a->kernel_dir, "Read kernels from this source tree");
    command->add_flag("--cpu-clock", a->cpu_clock,
                      "Count processor time over compute units instead of wall time: for CPUs that "
                      "others use too");
    command->add_flag("--any-build", a->any_build,
                      "Take finished runs of other builds of the program too");
    command->callback([a] { run(*a); });
}

}  // namespace wedge::cli
