// wedge explain: which effects of a scene are modelled how, and what that takes. Needs no device.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/render_arguments.hpp"
#include "wedge/render.hpp"

namespace wedge::cli {
namespace {

void run(RenderArguments arguments) {
    arguments.outputs = {"none.exr"};
    const RenderJob job = check_arguments(arguments);
    Scene scene = load_scene(arguments.scene, load_options(arguments.asset_paths));
    apply_film(job, scene);
    std::fputs(explain(scene, job.options).c_str(), stdout);
    std::fflush(stdout);
}

}  // namespace

void register_explain(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("explain", "Tell which effects of a scene are modelled how, and why");
    auto arguments = std::make_shared<RenderArguments>();
    arguments->method = "aaf";
    RenderArguments& a = *arguments;
    command->add_option("scene", a.scene, "Scene file (.json) or model (.obj)")->required();
    command->add_option("--method", a.method, "mc or aaf; default: aaf");
    command->add_option("--mu", a.mu, "aaf: bandwidth scale; default: 1");
    command->add_option("--bounces", a.bounces, "Indirect bounces; default: the scene's");
    command->add_option("--size", a.size, "Film as WIDTHxHEIGHT in px; default: the scene's");
    command->add_option("--asset-path", a.asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace wedge::cli
