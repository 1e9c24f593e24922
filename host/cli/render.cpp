// wedge render: a scene in, image files out.
#include "wedge/render.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>

#include "host/base/atomic_file.hpp"
#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/heat.hpp"
#include "host/cli/image_support.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/layers.hpp"
#include "host/cli/messages.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/render_arguments.hpp"
#include "host/cli/render_report.hpp"
#include "host/cli/written_files.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

namespace fs = std::filesystem;

/// Layers and the files of their heat maps.
using HeatFiles = std::vector<std::pair<std::string, fs::path>>;

constexpr const char* kStoppedEarly = "stopped before the first sample; no image was written";

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

HeatFiles heat_files_of(const RenderJob& job, const std::vector<std::string>& layers) {
    HeatFiles files;
    for (const std::string& layer : layers)
        files.emplace_back(layer, heat_file(job.outputs.front(), layer));
    return files;
}

/// Before the scene is read, which may take a while, and again with what it has to draw.
void check_files(const RenderArguments& arguments, const RenderJob& job, const HeatFiles& heat) {
    std::vector<NamedFile> written;
    for (const fs::path& file : job.outputs) written.push_back({"--output", file});
    for (const auto& [layer, file] : heat) written.push_back({"--heat " + layer, file});
    if (!arguments.stats_file.empty()) written.push_back({"--stats", arguments.stats_file});
    if (!arguments.resume_file.empty()) written.push_back({"--resume", arguments.resume_file});
    check_written({{"the scene", arguments.scene}}, written);
}

void replay(const Scene& scene, const RenderJob& job) {
    const std::string text = replay_pixel(scene, job.options, job.pixel->x, job.pixel->y);
    std::fputs(text.c_str(), stdout);
    if (!text.ends_with('\n')) std::fputc('\n', stdout);
}

Frame render_with_progress(const Scene& scene, RenderOptions options) {
    const InterruptScope interrupt;
    ProgressDisplay display(options.time_limit_s);
    options.stop = &InterruptScope::requested();
    options.on_progress = [&](const Progress& progress) { display.update(progress); };
    try {
        return render(scene, options);
    } catch (const Error& error) {
        // A compiler of kernels may catch the same signal, and leave its work undone.
        if (error.kind() != ErrorKind::device || !InterruptScope::requested()) throw;
        say(kStoppedEarly);
        throw Interrupted{};
    }
}

void write_image(const fs::path& file, const Image& image, const std::vector<std::string>& layers,
                 const Develop& develop) {
    // Images of gigabytes are not copied in vain.
    if (output_format(file) != OutputFormat::exr || holds_only(image, layers))
        write_output(file, image, develop);
    else
        write_output(file, select_layers(image, layers), develop);
}

// A file that fails must not take the others with it: all are tried, the first error is thrown.
void write_outputs(const RenderJob& job, const HeatFiles& heat_files, const Image& image,
                   const Develop& develop) {
    std::unique_ptr<Error> first_error;
    const auto attempt = [&](const fs::path& file, const auto& write) {
        try {
            write();
            fmt::print("{}\n", file.string());
        } catch (const Error& error) {
            if (first_error)
                log_warning(error.what());
            else
                first_error = std::make_unique<Error>(error);
        }
    };
    for (const fs::path& file : job.outputs)
        attempt(file, [&] { write_image(file, image, job.layers, develop); });
    for (const auto& [layer, file] : heat_files)
        if (has_heat_layer(image, layer))
            attempt(file,
                    [&, &layer = layer, &file = file] { write_heat(file, image, layer, develop); });
        else
            log_warning("the render ended without the layer " + layer + "; there is no " +
                        file.string());
    std::fflush(stdout);
    if (first_error) throw *first_error;
}

void write_stats(const std::string& file, const std::string& json) {
    write_file_atomically(file, json);
    fmt::print("{}\n", file);
    std::fflush(stdout);
}

[[noreturn]] void end_without_image(const RenderStats& stats) {
    if (!stats.interrupted)
        throw Error(ErrorKind::device, "no sample was rendered; no image was written");
    say(kStoppedEarly);
    throw Interrupted{};
}

/// Once its image is written a whole render needs no state; a broken one does.
void end_state(const RenderArguments& arguments, const RenderStats& stats) {
    if (arguments.resume_file.empty()) return;
    std::error_code ignored;
    if (!stats.interrupted && stats.failure.empty() && !arguments.time_s)
        fs::remove(arguments.resume_file, ignored);
    else
        say("the same command with --resume " + arguments.resume_file + " goes on from here");
}

void run(const RenderArguments& arguments) {
    install_messages(arguments.quiet);
    const RenderJob job = check_arguments(arguments);
    if (!job.pixel) {
        require_image_support("render");
        check_files(arguments, job, {});
    }

    const auto start = std::chrono::steady_clock::now();
    Scene scene = load_scene(arguments.scene, load_options(arguments.asset_paths));
    apply_film(job, scene);
    const double load_s = seconds_since(start);
    if (job.pixel) return replay(scene, job);
    const HeatFiles heat_files =
        heat_files_of(job, choose_heat_layers(job.heat, scene, job.options));
    check_files(arguments, job, heat_files);

    const Frame frame = render_with_progress(scene, job.options);
    const RenderStats& stats = frame.stats;
    if (stats.samples == 0) end_without_image(stats);
    const float exposure = arguments.exposure.value_or(scene.defaults.exposure);
    write_outputs(job, heat_files, frame.image, {exposure, arguments.tone});
    if (!arguments.stats_file.empty())
        write_stats(arguments.stats_file,
                    stats_json(stats, scene, job.options, arguments.scene, load_s));
    report(stats, scene, job.options, load_s);
    end_state(arguments, stats);
    if (!stats.failure.empty())
        throw Error(ErrorKind::device,
                    stats.failure + "\nthe image holds the samples from before this");
    if (stats.interrupted) throw Interrupted{};
}

void add_what_to_render(CLI::App& command, RenderArguments& a) {
    command.add_option("scene", a.scene, "Scene file (.json) or model (.obj)")
        ->type_name("FILE")
        ->required();
    command.add_option(
        "--spp", a.spp,
        "Samples per pixel, with aaf the most; default: the scene's, with aaf 128 max(1, mu)");
    command.add_option("--bounces", a.bounces,
                       "Indirect bounces, 0 is direct light only; default: the scene's");
    command.add_option("--size", a.size, "Film as WIDTHxHEIGHT in px; default: the scene's");
    command.add_option("--crop", a.crop,
                       "Render X,Y,WIDTH,HEIGHT in px only, the rest stays 0; default: all");
    command.add_option("--time", a.time_s,
                       "End after this many seconds, or where --spp or --mu ends it, whichever is "
                       "first; default: no limit");
    command.add_option("--target-error", a.target_error,
                       "Go on until the estimated error is this small, or until --spp, --mu or "
                       "--time; default: none");
    command.add_option("--target-metric", a.target_metric,
                       "What --target-error is: relmse or rmse; default: relmse");
    command.add_option("--seed", a.seed, "Seed of all random numbers, 0 to 2^64 - 1; default: 0");
    command.add_option(
        "--method", a.method,
        "mc or aaf; default: aaf, but mc with --resume, --sample-offset and --pixel");
    command.add_option("--mu", a.mu,
                       "aaf: bandwidth scale, samples against bias; default: 1, with --time and "
                       "--target-error as high as they need");
    command.add_option("--filter", a.filter,
                       "aaf: guarded, plain (as in the papers) or none; default: guarded");
    command.add_flag("--uniform", a.uniform,
                     "aaf: the same number of paths in every pixel, --spp or the probe's");
    command.add_option("--integrator", a.integrator,
                       "path, or ao: ambient occlusion, white surfaces under a white sky; default: "
                       "path");
    command.add_option("--bvh", a.bvh,
                       "Layout of the tree: auto, wide, compressed or binary; default: auto");
    command.add_option("--bvh-quality", a.bvh_quality, "medium or high; default: medium");
    command.add_option("--sampler", a.sampler,
                       "sobol, stratified, lattice or hash; default: sobol");
    command.add_option(
        "--sample-offset", a.sample_offset,
        fmt::format("First sample of each pixel, a multiple of {}; default: 0", kSampleBatch));
    command.add_option("--asset-path", a.asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
}

void add_results(CLI::App& command, RenderArguments& a) {
    command
        .add_option("-o,--output", a.outputs,
                    "Image to write, .exr or .png; repeatable; default: the scene's name, both, "
                    "in the current folder")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        .add_option("--aov", a.layers,
                    "Layers of the EXR, separated by commas: " + layer_names() +
                        ", all or none; default: all")
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--heat", a.heat,
                    "Write these layers as heat maps with a legend, OUTPUT.LAYER.png, separated by "
                    "commas: " +
                        heat_layer_names() + ", or all; default: none")
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--exposure", a.exposure,
                       "Exposure of the PNG in stops; default: the scene's");
    command.add_option("--tone", a.tone,
                       "Tone curve of the PNG: srgb, filmic or reinhard; default: srgb");
    command
        .add_option("--stats", a.stats_file, "Write times, rays and sizes as JSON; default: none")
        ->type_name("FILE");
    command
        .add_option(
            "--resume", a.resume_file,
            "Keep the state of the render in this file while it runs, and go on from it if it is "
            "there (method mc); default: none")
        ->type_name("FILE");
    command.add_option("--checkpoint", a.checkpoint_s,
                       "Seconds between two saves of that state; default: 30");
    command.add_option("--pixel", a.pixel,
                       "Replay the paths of pixel X,Y (px) in words on stdout, write no image");
    command.add_flag("--quiet", a.quiet, "Only warnings and errors on stderr");
}

void add_device(CLI::App& command, RenderArguments& a) {
    command.add_option("--device", a.device,
                       "Index, part of a name, cpu or gpu (see `wedge devices`); default: "
                       "WEDGE_DEVICE, else the first GPU, else the first device");
    command.add_option("--local-size", a.local_size,
                       "Work-items in a work-group; default: 0, what suits the device");
    command.add_option("--tile", a.tile_pixels,
                       "Pixels in one launch; default: 0, what suits the device");
    command
        .add_option("--kernel-dir", a.kernel_dir,
                    "Read kernels from this source tree; default: those in the program")
        ->type_name("DIR");
}

}  // namespace

void register_render(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to EXR and PNG files");
    auto arguments = std::make_shared<RenderArguments>();
    add_what_to_render(*command, *arguments);
    add_results(*command, *arguments);
    add_device(*command, *arguments);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace wedge::cli
