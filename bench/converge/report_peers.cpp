// What other renderers and this one make of the same scene, and each by its own measure.
#include <cmath>

#include "bench/converge/html.hpp"
#include "bench/converge/pictures.hpp"
#include "bench/converge/report_sections.hpp"

namespace wedge::converge {
namespace {

constexpr int kPictureSide_px = 320;
constexpr double kFull = 0.1;

std::string agreement_table(const SceneAnalysis& scene) {
    Table table{{"converged image of", "samples a pixel", "RMSE to ours", "of that noise",
                 "ours over theirs, R, G, B", "tests", "mean z²", "largest |z|", "p, corrected"},
                {}};
    for (const Agreement& a : scene.agreements)
        table.rows.push_back({escaped(a.version), std::to_string(a.spp), short_number(a.rmse),
                              short_number(a.rmse_of_noise),
                              fmt::format("{:.5f}, {:.5f}, {:.5f}", a.ratio_of_means[0],
                                          a.ratio_of_means[1], a.ratio_of_means[2]),
                              std::to_string(a.test.tests), short_number(a.test.mean_square_z),
                              short_number(a.test.largest_z), short_number(a.test.p)});
    return table_html(table);
}

std::string own_errors_table(const SceneAnalysis& scene) {
    Table table{{"method", "budget", "RMSE to our reference", "RMSE to their own"}, {}};
    for (const Agreement& a : scene.agreements)
        for (const OwnError& e : a.own_errors)
            table.rows.push_back({e.method->name, text_of(e.budget), short_number(e.to_reference),
                                  short_number(e.to_own)});
    return table.rows.empty() ? "" : table_html(table);
}

std::string differences(const SceneAnalysis& scene) {
    std::string figures;
    const std::vector<PeerReference>& peers = scene.scene->peer_references;
    for (const PeerReference& peer : peers) {
        const Image map = relative_difference(scene.scene->reference, peer.image);
        const std::vector<double> values(map.pixels.begin(), map.pixels.end());
        figures +=
            "<figure>" +
            img_html(shrunk(developed(peer.image, scene.scene->exposure), kPictureSide_px),
                     peer.version, false) +
            img_html(shrunk(signed_map(values, map.width, map.height, kFull), kPictureSide_px),
                     "difference of " + peer.version, false) +
            fmt::format(
                "<figcaption><strong>{}</strong>, and its difference from "
                "ours</figcaption></figure>\n",
                escaped(peer.version));
    }
    return "<div class=\"strip\">\n" + figures + "</div>\n";
}

}  // namespace

std::string peers_section(const SceneAnalysis& scene) {
    if (scene.agreements.empty()) return "";
    return "<h3>Other renderers</h3>\n<p class=\"soft\">Converged images, theirs and ours, in "
           "blocks of 8 x 8 px, each channel: z is the difference over its standard deviation; "
           "mean z² is 1 if they agree, p is that of the largest, corrected for the number of "
           "tests. Differences: theirs less ours, over ours + 0.01; blue theirs is darker, red "
           "brighter, full colour at 10 %.</p>\n" +
           agreement_table(scene) + own_errors_table(scene) + differences(scene);
}

}  // namespace wedge::converge
