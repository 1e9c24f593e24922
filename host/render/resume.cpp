#include "host/render/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "host/base/atomic_file.hpp"
#include "host/base/sha256.hpp"
#include "host/render/fingerprints.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::rendering {
namespace {

constexpr std::string_view kAnyMagic = "wedge state ", kMagic = "wedge state 2\n";
constexpr std::size_t kHexDigits = 64;
/// Saving takes no more than about this share of the time.
constexpr double kMostTimeSaving = 0.05;

std::string_view bytes_of(const Position& position) {
    return {reinterpret_cast<const char*>(&position), sizeof(position)};
}

}  // namespace

StateFile::StateFile(const Scene& scene, const RenderOptions& options, const PathSettings& settings,
                     const RenderStats& stats)
    : file_(options.resume_file),
      fingerprints_(fingerprints_of(scene, options, settings, stats)),
      pixels_(uint64_t(settings.crop.width) * uint64_t(settings.crop.height)) {}

std::optional<RenderState> StateFile::read() const {
    const auto fail = [&](const std::string& what) {
        throw Error(
            ErrorKind::bad_input,
            fmt::format("{}: {}; remove it, or name another with --resume", file_.string(), what));
    };
    if (!std::filesystem::exists(file_)) return std::nullopt;
    std::ifstream stream(file_, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::size_t film_bytes = pixels_ * sizeof(shared::FilmPixel);
    const std::size_t header = kMagic.size() + kHexDigits * fingerprints_.size();
    if (text.starts_with(kAnyMagic) && !text.starts_with(kMagic))
        fail("is the state of a render by another version");
    if (!text.starts_with(kMagic) || text.size() < header + kHexDigits)
        fail("is no state of a render");
    const std::string_view body(text.data(), text.size() - kHexDigits);
    if (text.substr(body.size()) != to_hex(sha256(body))) fail("is damaged");
    if (const auto others = different_parts(body.substr(kMagic.size())); !others.empty())
        fail(fmt::format("is the state of another render; not the same: {}",
                         fmt::join(others, ", ")));
    if (body.size() != header + sizeof(Position) + film_bytes) fail("is damaged");
    RenderState state;
    state.film.resize(pixels_);
    std::memcpy(&state.position, body.data() + header, sizeof(Position));
    std::memcpy(state.film.data(), body.data() + header + sizeof(Position), film_bytes);
    return state;
}

std::vector<std::string_view> StateFile::different_parts(std::string_view header) const {
    std::vector<std::string_view> parts;
    for (std::size_t i = 0; i < fingerprints_.size(); ++i)
        if (header.substr(kHexDigits * i, kHexDigits) != fingerprints_[i].hex)
            parts.push_back(fingerprints_[i].part);
    return parts;
}

void StateFile::write(const RenderState& state) const {
    std::string text(kMagic);
    for (const Fingerprint& print : fingerprints_) text += print.hex;
    text += bytes_of(state.position);
    text.append(reinterpret_cast<const char*>(state.film.data()),
                state.film.size() * sizeof(shared::FilmPixel));
    text += to_hex(sha256(text));
    write_file_atomically(file_, text);
}

Checkpoints::Checkpoints(const Scene& scene, const RenderOptions& options,
                         const PathSettings& settings, const RenderStats& stats, PathTracer& tracer)
    : tracer_(tracer),
      file_(scene, options, settings, stats),
      interval_s_(options.checkpoint_interval_s) {
    if (options.method != Method::mc)
        throw Error(ErrorKind::usage, "only plain Monte Carlo renders (method mc) can be resumed");
    const std::optional<RenderState> state = file_.read();
    if (!state) return;
    tracer_.write_film(state->film);
    start_ = state->position;
    log_info(fmt::format("{}: goes on after {} samples a pixel", options.resume_file,
                         start_->sample - options.sample_offset));
}

uint64_t Checkpoints::begin(Schedule& schedule, uint32_t first) const {
    if (!start_) return 0;
    schedule.go_on_from(*start_);
    return uint64_t(start_->sample - first) * tracer_.pixel_count() +
           uint64_t(start_->pixel) * start_->pass_samples;
}

void Checkpoints::between_launches(const Position& position) {
    if (since_save_.total() >= interval_s_) save(position);
}

void Checkpoints::save(const Position& position) {
    const Stopwatch watch;
    try {
        file_.write({position, tracer_.read_film()});
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::output) throw;
        log_warning(error.what());
    }
    interval_s_ = std::max(interval_s_, watch.total() / kMostTimeSaving);
    since_save_ = Stopwatch();
}

}  // namespace wedge::rendering
