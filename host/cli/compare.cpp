// wedge compare TEST REFERENCE: how far one image is from another.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "host/cli/commands.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"

namespace wedge::cli {
namespace {

constexpr const char* kRelMseFormula = "mean of (t - r)^2 / (max(r, 0) + 0.01)^2";

struct CompareOptions {
    std::string test, reference, difference_file;
    bool as_json = false;
    float gain = 1;
};

/// Before the work, like everything that can be judged then.
void check_difference_file(const std::filesystem::path& file) {
    if (file.empty()) return;
    if (file.extension() != ".exr" && file.extension() != ".png")
        throw Error(ErrorKind::usage,
                    fmt::format("--diff {}: the name must end in .exr or .png", file.string()));
    check_writable(file);
}

void write_difference(const CompareOptions& options, const Image& test, const Image& reference) {
    const std::filesystem::path file = options.difference_file;
    if (file.empty()) return;
    const Image difference = difference_image(test, reference, options.gain);
    if (file.extension() == ".png")
        write_png(file, difference);
    else
        write_exr(file, difference);
}

void print_table(const ImageDifference& difference) {
    fmt::print("MSE     {:.6g}\n", difference.mse);
    fmt::print("RMSE    {:.6g}\n", difference.rmse);
    fmt::print("relMSE  {:.6g}   {}\n", difference.rel_mse, kRelMseFormula);
    fmt::print("SSIM    {:.6f}   on tone-mapped grey; 1 is equal\n", difference.ssim);
    fmt::print("FLIP    {:.6f}   HDR-FLIP, mean; 0 is equal\n", difference.flip);
    if (difference.non_finite > 0)
        fmt::print("{} pixels are not finite and were left out\n", difference.non_finite);
}

void print_json(const CompareOptions& options, const ImageDifference& difference) {
    const nlohmann::ordered_json json = {
        {"test", options.test},         {"reference", options.reference},
        {"mse", difference.mse},        {"rmse", difference.rmse},
        {"relmse", difference.rel_mse}, {"relmse_formula", kRelMseFormula},
        {"ssim", difference.ssim},      {"flip", difference.flip},
        {"flip_variant", "HDR-FLIP"},   {"non_finite_pixels", difference.non_finite},
    };
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void compare(const CompareOptions& options) {
    check_difference_file(options.difference_file);
    const Image test = read_image(options.test), reference = read_image(options.reference);
    const ImageDifference difference = compare_images(test, reference);
    write_difference(options, test, reference);
    if (options.as_json)
        print_json(options, difference);
    else
        print_table(difference);
}

}  // namespace

void register_compare(CLI::App& app) {
    auto* command = app.add_subcommand("compare", "Say how far an image is from a reference");
    const auto options = std::make_shared<CompareOptions>();
    command->add_option("TEST", options->test, "Image to judge (EXR, PNG, ...)")->required();
    command->add_option("REFERENCE", options->reference, "Image taken as the truth")->required();
    command->add_flag("--json", options->as_json, "Print JSON");
    command->add_option("--diff", options->difference_file,
                        "Write |test - reference| to this .exr or .png");
    command->add_option("--gain", options->gain, "Multiply the difference image")
        ->capture_default_str();
    command->callback([options] { compare(*options); });
}

}  // namespace wedge::cli
