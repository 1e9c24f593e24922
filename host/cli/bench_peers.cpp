// wedge bench peers: other renderers on the same scene (docs/peers.md). Their script languages and
// packages are not needed to build or test.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "bench/converge/agree.hpp"
#include "bench/converge/session.hpp"
#include "bench/peers/scene_export.hpp"
#include "host/cli/bench_options.hpp"
#include "host/cli/command_text.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/messages.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

/// As typed; what is left out comes from Config.
struct PeersArguments : MeasuringArguments {
    PeersArguments() { methods = {"mc-sobol", "aaf"}; }
    std::vector<std::string> scenes, renderers{"mitsuba"};
    std::string size, python = "python3", title;
    std::optional<int> bounces, reference_limit;
    double reference_time_s = converge::kReferenceTime_s;
    bool check = false, export_only = false;
};

void require_peers(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (!converge::find_method(name).peer_script)
            throw Error(ErrorKind::usage,
                        fmt::format("--renderers {}: is no other renderer; known: {}", name,
                                    converge::peer_names()));
}

converge::Config make_config(const PeersArguments& a, const std::string& command) {
    require_peers(a.renderers);
    converge::Config config;
    config.scenes = a.scenes;
    config.methods = a.methods;
    config.methods.insert(config.methods.end(), a.renderers.begin(), a.renderers.end());
    if (!a.size.empty()) config.size = a.size;
    if (a.bounces) config.bounces = *a.bounces;
    if (a.reference_limit) config.reference_limit = *a.reference_limit;
    config.reference_time_s = a.reference_time_s;
    // Samples of the check have to be independent, for its variances are those of such.
    if (a.check) config.reference_sampler = Sampler::hash;
    config.python = a.python;
    config.title = a.title.empty() ? "Beside other renderers" : a.title;
    config.command = command;
    take_measuring_arguments(a, config);
    if (config.folder.empty())
        config.folder = a.scenes.size() == 1
                            ? "peers-" + std::filesystem::path(a.scenes[0]).stem().string()
                            : std::string("peers");
    converge::complete(config);
    return config;
}

void export_all(const converge::Config& config, const LoadOptions& load) {
    for (const std::string& file : config.scenes) {
        const Scene scene = converge::scene_to_measure(config, file, load, say);
        const std::filesystem::path folder =
            config.folder / std::filesystem::path(file).stem().string();
        peers::export_scene(scene, folder);
        fmt::print("{}\n", (folder / "scene.json").string());
    }
}

void check_all(const converge::Config& config, const LoadOptions& load) {
    bool all = true;
    for (const std::string& file : config.scenes)
        for (const converge::AgreementFiles& found :
             converge::check_agreement(config, file, load, say)) {
            fmt::print("{}\n{}\n", found.text, found.picture.string());
            std::fflush(stdout);
            all = all && found.agrees;
        }
    if (!all) throw Error(ErrorKind::bad_input, "the renderers do not agree; see above");
}

void run(const PeersArguments& arguments, const std::string& command) {
    converge::Config config = make_config(arguments, command);
    measure_until_stopped(config, arguments, [&](const LoadOptions& load) {
        if (arguments.export_only) return export_all(config, load);
        if (arguments.check) return check_all(config, load);
        const converge::Outcome outcome = converge::converge(config, load, {}, say);
        for (const std::string& warning : outcome.warnings) log_warning(warning);
        fmt::print("{}\n{}\n", outcome.json.string(), outcome.report.string());
        std::fflush(stdout);
    });
}

}  // namespace

void register_bench_peers(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("peers", "Other renderers on the same scene");
    auto a = std::make_shared<PeersArguments>();
    command->add_option("scenes", a->scenes, "Scene files (.json) or models (.obj)")->required();
    command->add_flag("--check", a->check,
                      "Compare converged images only: do the renderers compute the same?");
    command->add_flag("--export", a->export_only, "Write the scenes for other renderers only");
    add_list(*command, "--renderers", a->renderers,
             "Separated by commas: " + converge::peer_names() + "; default: mitsuba");
    add_list(*command, "--methods", a->methods,
             "Of this program, as for `bench converge`; default: mc-sobol,aaf");
    add_budgets(*command, *a,
                "Ladder, as for `bench converge`: spp=4,16,64, mu=0.5,1,2 or s=1,2,4");
    command->add_option("--seeds", a->seeds, "Runs of each; default: 3");
    command->add_option("--size", a->size,
                        "Film as WIDTHxHEIGHT, as its largest side, or full, in px; default: 192");
    command->add_option("--bounces", a->bounces, "Indirect bounces; default: the scene's");
    command->add_option("--reference-spp", a->reference_spp,
                        "Samples per pixel of each renderer's converged image");
    command->add_option("--reference-time", a->reference_time_s,
                        "As for `bench converge`; only Wedge's own grows");
    command->add_option("--reference-limit", a->reference_limit, "As for `bench converge`");
    command->add_option("-o,--output", a->folder, "Folder; default: peers-SCENE");
    command->add_option("--references", a->references,
                        "Folder of converged images, to share them; default: that of --output");
    command->add_option("--title", a->title, "Of the report");
    command->add_option("--python", a->python,
                        "Python that has the other renderers; default: python3");
    add_measuring_options(*command, *a);
    command->callback([a, command] { run(*a, command_text(*command)); });
}

}  // namespace wedge::cli
