// wedge bench converge: error charted against time, method by method (docs/bench.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "bench/converge/reference_margin.hpp"
#include "bench/converge/session.hpp"
#include "host/cli/bench_options.hpp"
#include "host/cli/command_text.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/image_support.hpp"
#include "host/cli/messages.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

/// As typed; what is left out comes from the configuration file, else from Config.
struct ConvergeArguments : MeasuringArguments {
    std::vector<std::string> scenes;
    std::string config_file, size, reference_sampler, title, markdown;
    std::optional<int> bounces, reference_limit;
    std::optional<double> reference_time_s;
    bool short_form = false;
};

converge::Config make_config(const ConvergeArguments& a, const std::string& command) {
    converge::Config config;
    config.reference_time_s = converge::kReferenceTime_s;
    if (!a.config_file.empty())
        converge::read_config(a.config_file, a.short_form, config);
    else if (a.short_form)
        throw Error(ErrorKind::usage, "--short: needs a --config that says what its short form is");
    if (!a.scenes.empty()) config.scenes = a.scenes;
    if (!a.methods.empty()) config.methods = a.methods;
    if (!a.size.empty()) config.size = a.size;
    if (a.bounces) config.bounces = *a.bounces;
    if (a.reference_time_s) config.reference_time_s = *a.reference_time_s;
    if (a.reference_limit) config.reference_limit = *a.reference_limit;
    if (!a.reference_sampler.empty())
        config.reference_sampler = parse_sampler(a.reference_sampler, "--reference-sampler");
    if (!a.title.empty()) config.title = a.title;
    config.command = command;
    take_measuring_arguments(a, config);
    converge::complete(config);
    return config;
}

void run(const ConvergeArguments& arguments, const std::string& command) {
    converge::Config config = make_config(arguments, command);
    if (!arguments.markdown.empty()) check_output(arguments.markdown);
    measure_until_stopped(config, arguments, [&](const LoadOptions& load) {
        const converge::Outcome outcome = converge::converge(
            config, load, arguments.markdown, [](const std::string& line) { say(line); });
        for (const std::string& warning : outcome.warnings) log_warning(warning);
        fmt::print("{}\n{}\n", outcome.json.string(), outcome.report.string());
        std::fflush(stdout);
    });
}

}  // namespace

void register_bench_converge(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("converge", "Error against time, method by method");
    auto a = std::make_shared<ConvergeArguments>();
    command->add_option("scenes", a->scenes, "Scene files (.json) or models (.obj)");
    command->add_option("--config", a->config_file,
                        "What to measure, as JSON (docs/bench.md); options go before it");
    command->add_flag("--short", a->short_form, "The configuration's short form");
    add_list(
        *command, "--methods", a->methods,
        "Separated by commas: " + converge::method_names() + "; default: mc-sobol,mc-hash,aaf");
    add_budgets(*command, *a,
                "Ladder, as spp=2,4,8, mu=0.5,1,2 or s=1,2,4 (seconds, for all methods); "
                "repeatable; default: spp=4,8,16,32,64 and mu=0.25,0.5,1,2");
    command->add_option("--seeds", a->seeds, "Runs of each; default: 3");
    command->add_option("--size", a->size,
                        "Film as WIDTHxHEIGHT, as its largest side, or full, in px; default: 192");
    command->add_option("--bounces", a->bounces, "Indirect bounces; default: the scene's");
    command->add_option(
        "--reference-spp", a->reference_spp,
        fmt::format("Samples per pixel the reference starts with; default: {} times the largest "
                    "budget",
                    converge::kReferenceFactor));
    command->add_option("--reference-sampler", a->reference_sampler,
                        "Of the reference: sobol, stratified, lattice or hash; default: lattice, "
                        "which is no method's");
    command->add_option(
        "--reference-time", a->reference_time_s,
        fmt::format("The reference gets more samples until it is {:g} times better than the best "
                    "run, while it has taken less than so many seconds; 0: never; default: {:g}",
                    converge::kReferenceMargin, converge::kReferenceTime_s));
    command->add_option("--reference-limit", a->reference_limit,
                        "Most samples per pixel it gets so; default: 65536");
    command->add_option("-o,--output", a->folder,
                        "Folder of runs and report; default: converge-SCENE");
    command->add_option("--references", a->references,
                        "Folder of references, to share them; default: that of --output");
    command->add_option("--markdown", a->markdown, "Write tables to this file too");
    command->add_option("--title", a->title, "Of the report");
    add_measuring_options(*command, *a);
    command->callback([a, command] { run(*a, command_text(*command)); });
}

}  // namespace wedge::cli
