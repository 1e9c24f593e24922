#include "bench/converge/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "bench/converge/run_record.hpp"
#include "host/base/atomic_file.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"
#include "wedge/log.hpp"

namespace wedge::converge {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kFirstSeed = 1u << 20;  // of the two halves; runs count up from 0
constexpr int kLargestPiece = 256;         // samples per pixel between two visits to the disk

constexpr const char* kPieces = "wedge:pieces";
constexpr const char* kPieceSamples = "wedge:pieceSamples";
constexpr const char* kTime = "wedge:time_s";

/// Sums of the pieces so far, in double: thousands of samples must not be lost to rounding.
struct Halves {
    int width = 0, height = 0;
    int pieces = 0;         ///< in both halves together, even ones in the first
    int piece_samples = 0;  ///< per pixel
    double time_s = 0;
    std::vector<double> sum[2];
    std::vector<double> variance_sum;  ///< of the pieces' means
};

const std::vector<std::string> kChannels = {"R",   "G",          "B",          "a.R",
                                            "a.G", "a.B",        "b.R",        "b.G",
                                            "b.B", "variance.R", "variance.G", "variance.B"};

/// Adds `factor` times the layer's R, G, B.
void add_layer(const Image& image, const std::string& prefix, double factor,
               std::vector<double>& sum) {
    const int rgb[3] = {image.channel(prefix + "R"), image.channel(prefix + "G"),
                        image.channel(prefix + "B")};
    if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0)
        throw Error(ErrorKind::bad_input, "there is no layer " + prefix + "R, G, B");
    for (std::size_t i = 0; i < sum.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum[i * 3 + c] +=
                factor * double(image.pixels[i * image.channels.size() + std::size_t(rgb[c])]);
}

void add_piece(Halves& halves, const Image& image) {
    add_layer(image, "", 1, halves.sum[halves.pieces % 2]);
    add_layer(image, "variance.", 1, halves.variance_sum);
    ++halves.pieces;
}

Image to_image(const Halves& halves) {
    Image image{halves.width, halves.height, kChannels, {}, {}};
    const double n = halves.pieces;
    for (std::size_t i = 0; i < halves.sum[0].size(); i += 3) {
        const auto rgb = [&](const auto& value) {
            for (std::size_t c = i; c < i + 3; ++c) image.pixels.push_back(float(value(c)));
        };
        rgb([&](std::size_t c) { return (halves.sum[0][c] + halves.sum[1][c]) / n; });
        rgb([&](std::size_t c) { return halves.sum[0][c] * 2 / n; });
        rgb([&](std::size_t c) { return halves.sum[1][c] * 2 / n; });
        rgb([&](std::size_t c) { return halves.variance_sum[c] / (n * n); });
    }
    image.metadata[kPieces] = std::to_string(halves.pieces);
    image.metadata[kPieceSamples] = std::to_string(halves.piece_samples);
    image.metadata[kTime] = fmt::format("{:.3f}", halves.time_s);
    return image;
}

Halves empty_halves(const Film& film, int piece_samples) {
    Halves halves{film.width, film.height, 0, piece_samples, 0, {}, {}};
    for (auto* sum : {&halves.sum[0], &halves.sum[1], &halves.variance_sum})
        sum->assign(std::size_t(film.width) * film.height * 3, 0.0);
    return halves;
}

/// What an earlier call left; nothing if it is not there or cannot be used.
std::optional<Halves> read_halves(const fs::path& file, const Film& film, int piece_samples) {
    if (!fs::exists(file)) return {};
    try {
        const Image image = read_image(file);
        Halves halves = empty_halves(film, piece_samples);
        halves.pieces = std::stoi(image.metadata.at(kPieces));
        const bool fits = image.width == film.width && image.height == film.height &&
                          halves.pieces > 0 && halves.pieces % 2 == 0 &&
                          std::stoi(image.metadata.at(kPieceSamples)) == piece_samples;
        if (!fits) return {};
        if (image.metadata.count(kTime)) halves.time_s = std::stod(image.metadata.at(kTime));
        const double n = halves.pieces;
        add_layer(image, "a.", n / 2, halves.sum[0]);
        add_layer(image, "b.", n / 2, halves.sum[1]);
        add_layer(image, "variance.", n * n, halves.variance_sum);
        return halves;
    } catch (const std::exception& error) {
        log_warning(fmt::format("{}: not a reference, made anew: {}", file.string(), error.what()));
        return {};
    }
}

Image select_rgb(const Image& image, const std::string& prefix) {
    Image out{image.width, image.height, {"R", "G", "B"}, {}, {}};
    const int rgb[3] = {image.channel(prefix + "R"), image.channel(prefix + "G"),
                        image.channel(prefix + "B")};
    const std::size_t stride = image.channels.size();
    for (std::size_t i = 0; i * stride < image.pixels.size(); ++i)
        for (int c : rgb) out.pixels.push_back(image.pixels[i * stride + std::size_t(c)]);
    return out;
}

/// Half of `spp`, as far as that is a piece.
int samples_of_piece(int spp) {
    constexpr int kBatch = int(kSampleBatch);
    return std::clamp((spp / 2 + kBatch - 1) / kBatch * kBatch, kBatch, kLargestPiece);
}

RenderOptions piece_options(const ReferenceRequest& request, const Halves& halves) {
    RenderOptions options;
    options.device = request.device;
    options.kernel_dir = request.kernel_dir;
    options.sampler = request.sampler;
    options.samples_per_pixel = halves.piece_samples;
    // A half is one sequence of samples, so that a sampler which spreads them evenly goes on doing
    // so: the error of independent pieces would fall as slowly as that of independent samples.
    options.seed = kFirstSeed + uint32_t(halves.pieces % 2);
    options.sample_offset = uint32_t(halves.pieces / 2) * uint32_t(halves.piece_samples);
    options.stop = request.stop;
    return options;
}

void render_pieces(const Scene& scene, const ReferenceRequest& request, int wanted,
                   const fs::path& file, Halves& halves) {
    double pair_s = halves.pieces ? 2 * halves.time_s / halves.pieces : 0;
    while (halves.pieces < wanted && !(halves.time_s + pair_s > request.limit_s)) {
        const auto start = std::chrono::steady_clock::now();
        for (int half = 0; half < 2; ++half) {
            const Frame frame = render(scene, piece_options(request, halves));
            if (frame.stats.interrupted) throw Stopped{};
            if (!frame.stats.failure.empty())
                throw Error(ErrorKind::device, "reference: " + frame.stats.failure);
            add_piece(halves, frame.image);
        }
        pair_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        halves.time_s += pair_s;
        write_exr(file, to_image(halves));
        if (request.say)
            request.say(fmt::format("reference {}: {} of {} samples per pixel", request.name,
                                    halves.pieces * halves.piece_samples,
                                    wanted * halves.piece_samples));
    }
}

}  // namespace

double mean_squared_error_of(const Reference& reference) {
    double sum = 0;
    const auto &a = reference.half_a.pixels, &b = reference.half_b.pixels;
    for (std::size_t i = 0; i < a.size(); ++i) sum += squared_error_of_mean(a[i], b[i]);
    return a.empty() ? 0 : sum / double(a.size());
}

Reference make_reference(const Scene& scene, const ReferenceRequest& request) {
    make_folder(request.folder);
    // Pieces do not depend on the samples asked for, so that more can be added; only short
    // references have short ones.
    const int piece_samples =
        request.piece_samples ? request.piece_samples : samples_of_piece(request.spp);
    const int wanted = 2 * int(std::ceil(request.spp / (2.0 * piece_samples)));
    const std::string stem = fmt::format("{}-{}-{}-{}", request.name, request.scene_digest,
                                         to_string(request.sampler), piece_samples);
    const fs::path file = request.folder / (stem + ".exr");
    Halves halves = read_halves(file, scene.film, piece_samples)
                        .value_or(empty_halves(scene.film, piece_samples));
    render_pieces(scene, request, wanted, file, halves);

    const Image image = to_image(halves);
    Reference reference{select_rgb(image, ""), select_rgb(image, "a."), select_rgb(image, "b."),
                        select_rgb(image, "variance.")};
    reference.spp = uint64_t(halves.pieces) * uint64_t(halves.piece_samples);
    reference.piece_samples = piece_samples;
    reference.time_s = halves.time_s;
    reference.id = fmt::format("{}-{}", stem, halves.pieces);
    reference.sampler = to_string(request.sampler);
    reference.file = file;
    return reference;
}

}  // namespace wedge::converge
