// wedge bench converge: error charted against time, method by method (docs/bench.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "bench/converge/reference_margin.hpp"
#include "bench/converge/session.hpp"
#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/messages.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

/// As typed; what is left out comes from the configuration file, else from Config.
struct ConvergeArguments {
    std::vector<std::string> scenes, methods, budgets, asset_paths;
    std::string config_file, size, folder, references, reference_sampler, device, kernel_dir, title;
    std::string markdown;
    std::optional<int> seeds, bounces, reference_spp, reference_limit;
    std::optional<double> reference_time_s;
    bool short_form = false, any_build = false;
};

std::string command_line(const ConvergeArguments& a) {
    std::string text = "wedge bench converge";
    const auto add = [&](const std::string& words) { text += " " + words; };
    const auto add_option = [&](const char* name, const std::string& value) {
        if (!value.empty()) add(name + (" " + value));
    };
    for (const std::string& scene : a.scenes) add(scene);
    add_option("--config", a.config_file);
    if (a.short_form) add("--short");
    if (!a.methods.empty()) add(fmt::format("--methods {}", fmt::join(a.methods, ",")));
    for (const std::string& budgets : a.budgets) add("--budgets " + budgets);
    if (a.seeds) add(fmt::format("--seeds {}", *a.seeds));
    add_option("--size", a.size);
    if (a.bounces) add(fmt::format("--bounces {}", *a.bounces));
    if (a.reference_spp) add(fmt::format("--reference-spp {}", *a.reference_spp));
    add_option("--reference-sampler", a.reference_sampler);
    if (a.reference_time_s) add(fmt::format("--reference-time {:g}", *a.reference_time_s));
    if (a.reference_limit) add(fmt::format("--reference-limit {}", *a.reference_limit));
    add_option("--device", a.device);
    add_option("--kernel-dir", a.kernel_dir);
    if (a.any_build) add("--any-build");
    return text;
}

converge::Config make_config(const ConvergeArguments& a) {
    converge::Config config;
    config.reference_time_s = converge::kReferenceTime_s;
    if (!a.config_file.empty())
        converge::read_config(a.config_file, a.short_form, config);
    else if (a.short_form)
        throw Error(ErrorKind::usage, "--short: needs a --config that says what its short form is");
    if (!a.scenes.empty()) config.scenes = a.scenes;
    if (!a.methods.empty()) config.methods = a.methods;
    for (const std::string& text : a.budgets) converge::parse_budgets(text, config.budgets);
    if (a.seeds) config.seeds = *a.seeds;
    if (!a.size.empty()) config.size = a.size;
    if (a.bounces) config.bounces = *a.bounces;
    if (a.reference_spp) config.reference_spp = *a.reference_spp;
    if (a.reference_time_s) config.reference_time_s = *a.reference_time_s;
    if (a.reference_limit) config.reference_limit = *a.reference_limit;
    if (!a.reference_sampler.empty())
        config.reference_sampler = parse_sampler(a.reference_sampler, "--reference-sampler");
    config.folder = a.folder;
    config.references = a.references;
    config.device = a.device;
    config.kernel_dir = a.kernel_dir;
    config.any_build = a.any_build;
    if (!a.title.empty()) config.title = a.title;
    config.command = command_line(a);
    converge::complete(config);
    return config;
}

void run(const ConvergeArguments& arguments) {
    converge::Config config = make_config(arguments);
    const LoadOptions load = load_options(arguments.asset_paths);
    const InterruptScope interrupt;
    config.stop = &InterruptScope::requested();
    try {
        const converge::Outcome outcome = converge::converge(
            config, load, arguments.markdown, [](const std::string& line) { say(line); });
        for (const std::string& warning : outcome.warnings) log_warning(warning);
        fmt::print("{}\n{}\n", outcome.json.string(), outcome.report.string());
        std::fflush(stdout);
    } catch (const converge::Stopped&) {
        say("stopped; the same command goes on from here");
        throw Interrupted{};
    }
}

}  // namespace

void register_bench_converge(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("converge", "Error against time, method by method");
    auto a = std::make_shared<ConvergeArguments>();
    command->add_option("scenes", a->scenes, "Scene files (.json) or models (.obj)");
    command->add_option("--config", a->config_file,
                        "What to measure, as JSON (docs/bench.md); options go before it");
    command->add_flag("--short", a->short_form, "The configuration's short form");
    command
        ->add_option(
            "--methods", a->methods,
            "Separated by commas: " + converge::method_names() + "; default: mc-sobol,mc-hash,aaf")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--budgets", a->budgets,
                     "Ladder, as spp=2,4,8, mu=0.5,1,2 or s=1,2,4 (seconds, for all methods); "
                     "repeatable; default: spp=4,8,16,32,64 and mu=0.25,0.5,1,2")
        ->allow_extra_args(false);
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
    command->add_option("--asset-path", a->asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command->add_option("--device", a->device, "Index, part of a name, cpu or gpu");
    command->add_option("--kernel-dir", a->kernel_dir, "Read kernels from this source tree");
    command->add_flag("--any-build", a->any_build,
                      "Take finished runs of other builds of the program too");
    command->callback([a] { run(*a); });
}

}  // namespace wedge::cli
