#include "bench/converge/agree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/converge/identity.hpp"
#include "bench/converge/pictures.hpp"
#include "host/base/atomic_file.hpp"

namespace wedge::converge {
namespace {

namespace fs = std::filesystem;

constexpr double kFullDifference = 0.1;  // of the value, where colours end

std::string text_of(const std::string& scene, const Agreement& a, uint64_t spp) {
    return fmt::format(
        "{}: Wedge ({} samples a pixel) and {} ({}) {}\n"
        "  RMSE {:.3g}, of noise alone {:.3g}; means, ours over theirs: {:.5f} {:.5f} {:.5f}\n"
        "  {} blocks of 8 x 8 px and channels: mean z^2 {:.3f}, largest |z| {:.2f}, p {:.3g} "
        "(Sidak)",
        scene, spp, a.version, a.spp, a.test.p >= kAgreementLevel ? "agree" : "DO NOT AGREE",
        a.rmse, a.rmse_of_noise, a.ratio_of_means[0], a.ratio_of_means[1], a.ratio_of_means[2],
        a.test.tests, a.test.mean_square_z, a.test.largest_z, a.test.p);
}

/// Ours, theirs, their difference: from left to right.
Picture side_by_side(const Reference& reference, const PeerReference& peer, float exposure) {
    const Image map = relative_difference(reference, peer.image);
    const std::vector<double> values(map.pixels.begin(), map.pixels.end());
    const Picture parts[] = {developed(reference.mean, exposure), developed(peer.image, exposure),
                             signed_map(values, map.width, map.height, kFullDifference)};
    Picture all{3 * map.width, map.height, {}};
    for (int y = 0; y < all.height; ++y)
        for (const Picture& part : parts) {
            const auto row = part.rgb.begin() + std::ptrdiff_t(y) * part.width * 3;
            all.rgb.insert(all.rgb.end(), row, row + std::ptrdiff_t(part.width) * 3);
        }
    return all;
}

}  // namespace

std::vector<AgreementFiles> check_agreement(const Config& config, const std::string& scene_file,
                                            const LoadOptions& load, const Say& say) {
    const Scene scene = scene_to_measure(config, scene_file, load, say);
    const std::string name = fs::path(scene_file).stem().string(), digest = digest_of(scene);
    PeerRuns runs(config, scene, name, digest);
    const std::vector<PeerReference> peers = runs.references(say);
    const Reference reference = make_reference(scene, reference_request(config, name, digest, say));
    std::vector<AgreementFiles> found;
    for (const PeerReference& peer : peers) {
        AgreementFiles files;
        files.agreement = agreement_of(reference, peer, {});
        files.agrees = files.agreement.test.p >= kAgreementLevel;
        files.text = text_of(name, files.agreement, reference.spp);
        files.picture = config.folder / fmt::format("agreement-{}-{}.png", name, peer.method->name);
        write_file_atomically(files.picture,
                              png_of(side_by_side(reference, peer, scene.defaults.exposure)));
        found.push_back(std::move(files));
    }
    return found;
}

}  // namespace wedge::converge
