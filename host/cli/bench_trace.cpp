// wedge bench trace: how many rays a second a device traces, kind by kind, beside Embree where the
// build has it (docs/tracing.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/trace_bench.hpp"
#include "host/base/atomic_file.hpp"
#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/text.hpp"
#include "wedge/error.hpp"

namespace wedge::cli {
namespace {

using nlohmann::ordered_json;

struct BenchArguments {
    std::vector<std::string> scenes;
    std::vector<std::string> asset_paths;
    std::string device, json_file;
    std::string layout = "auto", quality = "medium";
    bench::TraceBenchOptions options;
    bool no_embree = false;
};

const std::map<std::string, std::vector<BvhLayout>> kLayouts = {
    {"auto", {BvhLayout::automatic}},
    {"wide", {BvhLayout::wide}},
    {"compressed", {BvhLayout::compressed}},
    {"binary", {BvhLayout::binary}},
    {"all", {BvhLayout::wide, BvhLayout::compressed, BvhLayout::binary}}};

const std::map<std::string, std::vector<BvhQuality>> kQualities = {
    {"medium", {BvhQuality::medium}},
    {"high", {BvhQuality::high}},
    {"all", {BvhQuality::medium, BvhQuality::high}}};

const char* name_of(BvhLayout layout) {
    return layout == BvhLayout::binary       ? "binary"
           : layout == BvhLayout::compressed ? "compressed"
                                             : "wide";
}

const char* name_of(BvhQuality quality) {
    return quality == BvhQuality::high ? "high" : "medium";
}

void print_report(const bench::TraceReport& report) {
    fmt::print("{}, {} {}: {} triangles, tree {} in {}", report.scene, name_of(report.layout),
               name_of(report.quality), text_of_number(report.triangles),
               text_of_bytes(report.tree_bytes), text_of_seconds(report.build_s));
    if (report.embree_build_s)
        fmt::print(" (Embree {} in {}: {:.2f} of its memory, {:.2f} of its time)",
                   text_of_bytes(*report.embree_bytes), text_of_seconds(*report.embree_build_s),
                   double(report.tree_bytes) / double(*report.embree_bytes),
                   *report.build_ratio_embree);
    fmt::print("\n  {:<10}{:>10}{:>7}{:>10}{:>9}{:>10}{:>9}{:>8}{:>11}\n", "rays", "count", "hits",
               "Mray/s", "spread", "Embree", "spread", "ratio", "differing");
    for (const bench::TraceRow& row : report.rows) {
        fmt::print("  {:<10}{:>10}{:>6.0f}%{:>10.2f}{:>8.0f}%", row.kind, row.rays,
                   100 * row.hit_share, row.wedge.mrays_per_s, 100 * row.wedge.spread);
        if (row.embree)
            fmt::print("{:>10.2f}{:>8.0f}%{:>8.2f}{:>11}", row.embree->mrays_per_s,
                       100 * row.embree->spread, *row.ratio_embree, row.differing);
        fmt::print("\n");
    }
    std::fflush(stdout);
}

ordered_json json_of(const bench::TraceReport& report) {
    ordered_json json{{"scene", report.scene},
                      {"layout", name_of(report.layout)},
                      {"quality", name_of(report.quality)},
                      {"triangles", report.triangles},
                      {"nodes", report.nodes},
                      {"blocks", report.blocks},
                      {"tree_bytes", report.tree_bytes},
                      {"depth", report.depth},
                      {"build_s", report.build_s},
                      {"rows", ordered_json::array()}};
    if (report.embree_build_s) {
        json["embree_build_s"] = *report.embree_build_s;
        json["build_ratio_embree"] = *report.build_ratio_embree;
        json["embree_bytes"] = *report.embree_bytes;
    }
    for (const bench::TraceRow& row : report.rows) {
        ordered_json item{{"kind", row.kind},
                          {"rays", row.rays},
                          {"hit_share", row.hit_share},
                          {"mrays_per_s", row.wedge.mrays_per_s},
                          {"spread", row.wedge.spread}};
        if (row.embree) {
            item["embree_mrays_per_s"] = row.embree->mrays_per_s;
            item["embree_spread"] = row.embree->spread;
            item["ratio_embree"] = *row.ratio_embree;
            item["differing"] = row.differing;
        }
        json["rows"].push_back(item);
    }
    return json;
}

void print_mean_ratio(const std::vector<bench::TraceReport>& reports) {
    double sum = 0;
    int count = 0;
    for (const bench::TraceReport& report : reports)
        for (const bench::TraceRow& row : report.rows)
            if (row.ratio_embree && *row.ratio_embree > 0) {
                sum += std::log(*row.ratio_embree);
                ++count;
            }
    if (count)
        fmt::print("geometric mean of the ratios to Embree: {:.2f}\n", std::exp(sum / count));
}

void write_json(const std::string& file, const device::Device& device,
                const std::vector<bench::TraceReport>& reports) {
    ordered_json json{{"device", device.info().name},
                      {"driver", device.info().driver},
                      {"scenes", ordered_json::array()}};
    for (const bench::TraceReport& report : reports) json["scenes"].push_back(json_of(report));
    write_file_atomically(file,
                          json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

/// Rays do not see colours, so no image is read.
TextureImage white_texel(const std::filesystem::path&, bool) {
    return {1, 1, TextureFormat::linear8, {255, 255, 255, 255}};
}

void run(const BenchArguments& arguments) {
    bench::TraceBenchOptions options = arguments.options;
    options.height = options.width * 3 / 4;
    options.embree = !arguments.no_embree;
    LoadOptions load = load_options(arguments.asset_paths);
    load.load_texture = white_texel;

    options.layouts = kLayouts.at(arguments.layout);
    options.qualities = kQualities.at(arguments.quality);

    device::Device device(arguments.device);
    fmt::print("{} ({})\n", device.info().name, device.info().driver);
    std::vector<bench::TraceReport> reports;
    const auto measure = [&](const Scene& scene) {
        for (const bench::TraceReport& report : bench::measure_tracing(device, scene, options)) {
            print_report(report);
            reports.push_back(report);
        }
    };
    if (arguments.scenes.empty()) measure(bench::made_up_scene());
    for (const std::string& file : arguments.scenes) measure(load_scene(file, load));
    print_mean_ratio(reports);
    if (!arguments.json_file.empty()) write_json(arguments.json_file, device, reports);
}

}  // namespace

void register_bench(CLI::App& app) {
    CLI::App* group = app.add_subcommand("bench", "Measure speed");
    group->require_subcommand(1);
    CLI::App* command = group->add_subcommand("trace", "Rays a second, by kind of ray");
    auto arguments = std::make_shared<BenchArguments>();
    command->add_option("scenes", arguments->scenes,
                        "Scene files (.json) or models (.obj); none: a field of spheres");
    command->add_option("--asset-path", arguments->asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command->add_option("--device", arguments->device, "Index, part of a name, cpu or gpu");
    command->add_option("--repeats", arguments->options.repeats, "Timed runs of each kind of ray")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--builds", arguments->options.build_repeats, "Timed builds of each tree")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command
        ->add_option("--bvh", arguments->layout,
                     "Layout of the tree: auto, wide, compressed, binary or all")
        ->check(CLI::IsMember(kLayouts))
        ->capture_default_str();
    command->add_option("--bvh-quality", arguments->quality, "medium, high (spatial splits) or all")
        ->check(CLI::IsMember(kQualities))
        ->capture_default_str();
    command->add_option("--size", arguments->options.width, "Primary rays along the film's width")
        ->check(CLI::Range(16, 16384))
        ->capture_default_str();
    command->add_option("--local-size", arguments->options.local_size,
                        "Work-group size; 0: what suits the device");
    command->add_flag("--cpu-time", arguments->options.processor_time,
                      "Measure processor time: for a machine that is busy otherwise");
    command->add_option("--json", arguments->json_file, "Write the numbers to this file");
    command->add_flag("--no-embree", arguments->no_embree, "Do not measure Embree");
    command->callback([arguments] { run(*arguments); });
#if WEDGE_WITH_IMAGE
    register_bench_converge(*group);
    register_bench_stability(*group);
    register_bench_peers(*group);
#endif
}

}  // namespace wedge::cli
