// `wedge render`: what the command line asks for, checked before anything expensive starts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/image_support.hpp"
#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::cli {

/// Options as typed. Those that are left out take the scene's values.
struct RenderArguments {
    std::string scene;
    std::vector<std::string> outputs;
    std::vector<std::string> layers, heat;
    std::vector<std::string> asset_paths;
    std::string size, crop, pixel;
    std::string sampler = "sobol", method, filter, integrator = "path";
    bool uniform = false;
    std::optional<float> mu;
    std::string bvh = "auto", bvh_quality = "medium";
    std::string stats_file;
    std::optional<float> exposure;
    std::string tone = "srgb";
    std::optional<int> spp, bounces;
    std::optional<double> time_s, target_error;
    std::string target_metric;
    std::string seed = "0";
    uint32_t sample_offset = 0, local_size = 0, tile_pixels = 0;
    std::string device, kernel_dir;
    std::string resume_file;
    std::optional<double> checkpoint_s;
    bool quiet = false;
};

struct Pixel {
    int x = 0, y = 0;  ///< px from the top left
};

/// What a render is to do, from arguments that can be judged without the scene.
struct RenderJob {
    RenderOptions options;
    std::vector<std::filesystem::path> outputs;
    std::vector<std::string> layers;  ///< of the EXR, beside R, G, B, A; see layers.hpp
    std::vector<std::string> heat;    ///< names as typed; see heat.hpp
    std::optional<Film> film;
    bool ambient_occlusion = false;
    std::optional<Pixel> pixel;
};

enum class OutputFormat { exr, png };

/// By the extension, in any case. Throws Error(usage) that names the known ones.
OutputFormat output_format(const std::filesystem::path& file);

/// Throws Error(usage) that names the option, what it needs, and what it got.
RenderJob check_arguments(const RenderArguments& arguments);

/// Applies `--size` to the scene and checks that `--crop` and `--pixel` are on its film.
/// Throws Error(usage).
void apply_film(const RenderJob& job, Scene& scene);

}  // namespace wedge::cli
