// What is kept of a finished run, and the file that keeps it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/converge/config.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {

struct RunRecord {
    std::string key;  ///< see run_key()
    std::string scene, scene_digest, method;
    Budget budget;
    double knob = 0;  ///< samples per pixel or mu it ran with
    uint32_t seed = 0;
    int width = 0, height = 0;  ///< px
    std::string image;          ///< EXR, relative to the folder of the record
    /// Everything but reading files, compiling kernels, building the BVH: what charts show.
    double time_s = 0;
    double flatten_s = 0, bvh_build_s = 0, upload_s = 0, compile_s = 0, render_s = 0;
    std::vector<PassStats> passes;
    uint64_t rays = 0, samples = 0, non_finite_samples = 0;
    double predicted_rmse = -1;  ///< estimated by the render itself; -1: it did not
    std::string device, driver, platform, version, commit;
    std::string program;      ///< program_digest()
    nlohmann::json settings;  ///< the same in every scene
    std::string command;      ///< `wedge render …` that does the same
};

nlohmann::json to_json(const RunRecord& record);
/// Throws nlohmann::json::exception where something is missing.
RunRecord run_record_from(const nlohmann::json& object);

/// Adds one line at the end of `file` in one write and brings it to the disk, so that a killed
/// program leaves whole lines, and at most one that is cut off. Throws Error(output).
void append_line(const std::filesystem::path& file, const std::string& line);

/// JSON objects, one a line; none if there is no file. A line that is not whole is left out, and if
/// it is the last, cut off.
std::vector<nlohmann::json> read_lines(const std::filesystem::path& file);

/// Of everything that decides a run but the build of the program; 16 hexadecimal digits.
std::string run_key(const std::string& scene_digest, const Method& method, const Budget& budget,
                    uint32_t seed, const DeviceInfo& device);

}  // namespace wedge::converge
