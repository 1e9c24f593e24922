#include "host/cli/render_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "host/cli/bvh_options.hpp"
#include "host/cli/heat.hpp"
#include "host/cli/layers.hpp"
#include "host/cli/numbers.hpp"
#include "wedge/error.hpp"

namespace wedge::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorKind::usage, message);
}

void check_numbers(const RenderArguments& a) {
    if (a.spp && *a.spp < 1) refuse(fmt::format("--spp: must be at least 1, got {}", *a.spp));
    if (a.bounces && *a.bounces < 0)
        refuse(fmt::format("--bounces: must be at least 0, got {}", *a.bounces));
    if (a.time_s && !(*a.time_s > 0 && std::isfinite(*a.time_s)))
        refuse(fmt::format("--time: must be a positive number of seconds, got {}", *a.time_s));
    if (a.target_error && !(*a.target_error > 0 && std::isfinite(*a.target_error)))
        refuse(fmt::format("--target-error: must be positive, got {}", *a.target_error));
    if (a.checkpoint_s && !(*a.checkpoint_s >= 0))
        refuse(fmt::format("--checkpoint: must not be negative, got {}", *a.checkpoint_s));
    if (a.exposure && !std::isfinite(*a.exposure))
        refuse(fmt::format("--exposure: must be a number of stops, got {}", *a.exposure));
    if (a.sample_offset % kSampleBatch != 0)
        refuse(fmt::format("--sample-offset: must be a multiple of {}, got {}", kSampleBatch,
                           a.sample_offset));
}

Film parse_size(const std::string& text) {
    const auto sides = parse_integers("--size", text, "xX", 2, "WIDTHxHEIGHT in pixels");
    const auto [smallest, largest] = std::minmax(sides[0], sides[1]);
    if (smallest < 1 || largest > kLargestSide_px)
        refuse(fmt::format("--size: each side must be 1 to {} px, got {}", kLargestSide_px, text));
    if ((long long)(sides[0]) * sides[1] > kMostPixels)
        refuse(fmt::format("--size: {} are more than {} pixels", text, kMostPixels));
    return Film{sides[0], sides[1]};
}

Rect parse_crop(const std::string& text) {
    const auto n = parse_integers("--crop", text, ",", 4, "X,Y,WIDTH,HEIGHT in pixels");
    if (n[0] < 0 || n[1] < 0 || n[2] < 1 || n[3] < 1)
        refuse("--crop: X and Y must be at least 0, WIDTH and HEIGHT at least 1, got " + text);
    return Rect{n[0], n[1], n[2], n[3]};
}

Pixel parse_pixel(const std::string& text) {
    const auto n = parse_integers("--pixel", text, ",", 2, "X,Y in pixels");
    return Pixel{n[0], n[1]};
}

/// By hand: the parser of options would take -1, and numbers too large, for the largest.
uint64_t parse_seed(const std::string& text) {
    uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc{} || end != text.data() + text.size())
        refuse("--seed: must be a whole number from 0 to 18446744073709551615, got " + text);
    return seed;
}

Method parse_method(const std::string& name) {
    if (name == "mc") return Method::mc;
    if (name == "aaf") return Method::aaf;
    refuse("--method " + name + ": no such method; known: mc, aaf");
}

/// The one that was asked for; else filtering, but for what only plain Monte Carlo can do.
Method choose_method(const RenderArguments& a) {
    if (!a.method.empty()) return parse_method(a.method);
    const bool only_mc = !a.resume_file.empty() || a.sample_offset > 0 || !a.pixel.empty();
    return only_mc ? Method::mc : Method::aaf;
}

BvhOptions parse_bvh(const RenderArguments& a) {
    const auto layout = kBvhLayouts.find(a.bvh);
    if (layout == kBvhLayouts.end())
        refuse("--bvh " + a.bvh + ": no such layout; known: auto, wide, compressed, binary");
    const auto quality = kBvhQualities.find(a.bvh_quality);
    if (quality == kBvhQualities.end())
        refuse("--bvh-quality " + a.bvh_quality + ": no such quality; known: medium, high");
    return {.layout = layout->second, .quality = quality->second};
}

ErrorMetric parse_metric(const std::string& name) {
    if (name.empty() || name == "relmse") return ErrorMetric::rel_mse;
    if (name == "rmse") return ErrorMetric::rmse;
    refuse("--target-metric " + name + ": no such metric; known: relmse, rmse");
}

FilterMode parse_filter(const std::string& name) {
    if (name.empty()) return FilterMode::guarded;
    for (FilterMode mode : {FilterMode::guarded, FilterMode::plain, FilterMode::none})
        if (name == to_string(mode)) return mode;
    refuse("--filter " + name + ": no such way to filter; known: guarded, plain, none");
}

bool is_ambient_occlusion(const std::string& integrator) {
    if (integrator == "path") return false;
    if (integrator == "ao") return true;
    refuse("--integrator " + integrator + ": no such integrator; known: path, ao");
}

/// What would be asked for in vain is a mistake.
void check_combinations(const RenderArguments& a, Method method) {
    const auto refuse_if = [](bool given, const char* option, const char* why) {
        if (given) refuse(std::string(option) + ": " + why);
    };
    if (method == Method::mc) {
        const char* why = "has no meaning without filters; leave it out, or --method aaf";
        refuse_if(a.mu.has_value(), "--mu", why);
        refuse_if(!a.filter.empty(), "--filter", why);
        refuse_if(a.uniform, "--uniform", why);
    }
    refuse_if(!a.resume_file.empty() && method != Method::mc, "--resume",
              "only renders by --method mc can be resumed");
    refuse_if(!a.pixel.empty() && method != Method::mc, "--pixel",
              "replays path tracing alone; leave --method out");
    refuse_if(a.checkpoint_s && a.resume_file.empty(), "--checkpoint",
              "says how often --resume saves, which is not given");
    refuse_if(!a.target_metric.empty() && !a.target_error, "--target-metric",
              "says what --target-error is, which is not given");
    refuse_if(a.target_error && a.uniform && method == Method::aaf, "--target-error",
              "needs samples that differ from pixel to pixel; leave out --uniform");
    refuse_if(a.target_error && !a.resume_file.empty(), "--target-error",
              "such a render cannot be resumed; give --spp instead");
    refuse_if(a.bounces && is_ambient_occlusion(a.integrator), "--bounces",
              "ambient occlusion has none");
}

std::vector<fs::path> output_files(const RenderArguments& arguments) {
    std::vector<fs::path> files(arguments.outputs.begin(), arguments.outputs.end());
    if (files.empty()) {
        const std::string stem = fs::path(arguments.scene).stem().string();
        files = {stem + ".exr", stem + ".png"};
    }
    for (const fs::path& file : files) output_format(file);
    return files;
}

}  // namespace

OutputFormat output_format(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".exr") return OutputFormat::exr;
    if (extension == ".png") return OutputFormat::png;
    refuse(file.string() + ": unknown image extension '" + extension + "'; known: .exr, .png");
}

RenderJob check_arguments(const RenderArguments& arguments) {
    check_numbers(arguments);
    check_tone(arguments.tone);

    RenderJob job;
    job.options.device = arguments.device;
    job.options.samples_per_pixel = arguments.spp;
    job.options.bounces = arguments.bounces;
    job.options.time_limit_s = arguments.time_s;
    if (!arguments.crop.empty()) job.options.crop = parse_crop(arguments.crop);
    job.options.seed = parse_seed(arguments.seed);
    job.options.sample_offset = arguments.sample_offset;
    job.options.sampler = parse_sampler(arguments.sampler, "--sampler");
    job.options.bvh = parse_bvh(arguments);
    job.options.method = choose_method(arguments);
    check_combinations(arguments, job.options.method);
    if (arguments.mu && !(*arguments.mu > 0))
        refuse(fmt::format("--mu {}: must be positive", *arguments.mu));
    job.options.mu = arguments.mu;
    job.options.filter = parse_filter(arguments.filter);
    job.options.adaptive = !arguments.uniform;
    job.ambient_occlusion = is_ambient_occlusion(arguments.integrator);
    if (job.ambient_occlusion) job.options.bounces = 0;
    job.options.kernel_dir = arguments.kernel_dir;
    job.options.estimate_error = true;
    job.options.target_error = arguments.target_error;
    job.options.target_metric = parse_metric(arguments.target_metric);
    job.options.resume_file = arguments.resume_file;
    if (arguments.checkpoint_s) job.options.checkpoint_interval_s = *arguments.checkpoint_s;
    job.options.local_size = arguments.local_size;
    job.options.tile_pixels = arguments.tile_pixels;

    job.outputs = output_files(arguments);
    job.layers = parse_layers(arguments.layers);
    check_layers(job.layers, job.options.method);
    check_heat_names(arguments.heat);
    job.heat = arguments.heat;
    if (!arguments.size.empty()) job.film = parse_size(arguments.size);
    if (!arguments.pixel.empty()) job.pixel = parse_pixel(arguments.pixel);
    return job;
}

void apply_film(const RenderJob& job, Scene& scene) {
    if (job.film) scene.film = *job.film;
    if (job.ambient_occlusion) make_ambient_occlusion(scene);
    const Film& film = scene.film;
    if (const auto& crop = job.options.crop) {
        // Differences, because sums of large numbers could overflow.
        const bool inside = crop->x < film.width && crop->y < film.height &&
                            crop->width <= film.width - crop->x &&
                            crop->height <= film.height - crop->y;
        if (!inside)
            refuse(fmt::format("--crop {},{},{},{}: reaches outside the film of {}x{} px", crop->x,
                               crop->y, crop->width, crop->height, film.width, film.height));
    }
    if (const auto& pixel = job.pixel) {
        const bool inside =
            pixel->x >= 0 && pixel->y >= 0 && pixel->x < film.width && pixel->y < film.height;
        if (!inside)
            refuse(fmt::format("--pixel {},{}: outside the film of {}x{} px", pixel->x, pixel->y,
                               film.width, film.height));
    }
}

}  // namespace wedge::cli
