#include "host/cli/bench_options.hpp"

#include "bench/converge/session.hpp"
#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/messages.hpp"

namespace wedge::cli {

void add_list(CLI::App& command, const std::string& name, std::vector<std::string>& values,
              const std::string& help) {
    command.add_option(name, values, help)->delimiter(',')->allow_extra_args(false);
}

void add_budgets(CLI::App& command, MeasuringArguments& arguments, const std::string& help) {
    command.add_option("--budgets", arguments.budgets, help)->allow_extra_args(false);
}

void add_measuring_options(CLI::App& command, MeasuringArguments& arguments) {
    command.add_option("--asset-path", arguments.asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command.add_option("--device", arguments.device, "Index, part of a name, cpu or gpu");
    command.add_option("--kernel-dir", arguments.kernel_dir, "Read kernels from this source tree");
    command.add_flag("--any-build", arguments.any_build,
                     "Take finished runs of other builds of the program too");
}

void take_measuring_arguments(const MeasuringArguments& arguments, converge::Config& config) {
    for (const std::string& text : arguments.budgets) converge::parse_budgets(text, config.budgets);
    if (arguments.seeds) config.seeds = *arguments.seeds;
    if (arguments.reference_spp) config.reference_spp = *arguments.reference_spp;
    config.folder = arguments.folder;
    config.references = arguments.references;
    config.device = arguments.device;
    config.kernel_dir = arguments.kernel_dir;
    config.any_build = arguments.any_build;
}

void measure_until_stopped(converge::Config& config, const MeasuringArguments& arguments,
                           const std::function<void(const LoadOptions& load)>& measure) {
    const LoadOptions load = load_options(arguments.asset_paths);
    const InterruptScope interrupt;
    config.stop = &InterruptScope::requested();
    try {
        measure(load);
    } catch (const converge::Stopped&) {
        say("stopped; the same command goes on from here");
        throw Interrupted{};
    }
}

}  // namespace wedge::cli
