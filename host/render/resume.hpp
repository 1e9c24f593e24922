// The state of an unfinished render in a file, from which it goes on to the same bits.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "host/base/stopwatch.hpp"
#include "host/render/fingerprints.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/schedule.hpp"
#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::rendering {

/// Sums over samples, and how far they go.
struct RenderState {
    Position position;
    std::vector<shared::FilmPixel> film;
};

/// Reads and writes states of one render. The file has a checksum, and fingerprints of the scene,
/// of the options that decide about the image, and of the program's version; it is replaced in one
/// step, so that whenever the process ends there is a whole file, old or new.
class StateFile {
  public:
    StateFile(const Scene& scene, const RenderOptions& options, const PathSettings& settings,
              const RenderStats& stats);

    /// The state if there is a file. Throws Error(bad_input) where it is damaged or another
    /// render's.
    std::optional<RenderState> read() const;
    /// Throws Error(output).
    void write(const RenderState& state) const;

  private:
    /// Of a file, by what it tells from the first fingerprint on.
    std::vector<std::string_view> different_parts(std::string_view header) const;

    std::filesystem::path file_;
    std::vector<Fingerprint> fingerprints_;
    uint64_t pixels_;
};

/// Saves the state of a running render every so often.
class Checkpoints {
  public:
    /// Brings `tracer` to the state in options.resume_file if it is there. Throws as
    /// StateFile::read does, and Error(usage) for methods other than plain Monte Carlo.
    Checkpoints(const Scene& scene, const RenderOptions& options, const PathSettings& settings,
                const RenderStats& stats, PathTracer& tracer);

    /// Lets the schedule go on from the state found. Returns the pixel samples it holds, from
    /// sample `first`.
    uint64_t begin(Schedule& schedule, uint32_t first) const;
    /// To be called between launches; saves if it is time.
    void between_launches(const Position& position);
    /// Saves now. What fails is warned about: a render must not end for it.
    void save(const Position& position);

  private:
    PathTracer& tracer_;
    StateFile file_;
    std::optional<Position> start_;
    double interval_s_;
    Stopwatch since_save_;
};

}  // namespace wedge::rendering
