#include "bench/converge/strips.hpp"

#include <algorithm>
#include <cmath>

#include "bench/converge/html.hpp"
#include "bench/converge/pictures.hpp"

namespace wedge::converge {
namespace {

constexpr int kPictureSide_px = 320;
constexpr double kInsetShare = 1.0 / 6;  // of the film's larger side
constexpr double kBrightest = 0.98;      // quantile of the yardstick's error that is brightest

const Rung& nearest_rung(const Curve& curve, double time_s) {
    return *std::min_element(curve.rungs.begin(), curve.rungs.end(),
                             [&](const Rung& a, const Rung& b) {
                                 return std::abs(std::log(a.time_s.median / time_s)) <
                                        std::abs(std::log(b.time_s.median / time_s));
                             });
}

/// |t - r| / (r + 0.01) by pixel, root of the mean square over R, G, B.
std::vector<double> relative_error(const Image& test, const Image& reference) {
    std::vector<double> map;
    const std::size_t stride = test.channels.size();
    for (std::size_t i = 0; i < reference.pixels.size(); i += 3) {
        double sum = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            // Runs keep R, G, B first.
            const double r = reference.pixels[i + c], t = test.pixels[i / 3 * stride + c];
            const double relative = (t - r) / (std::max(r, 0.0) + 0.01);
            sum += relative * relative / 3;
        }
        map.push_back(std::isfinite(sum) ? std::sqrt(sum) : 0);
    }
    return map;
}

struct Places {
    Rect noisy;  ///< where the yardstick errs most
    Rect worst;  ///< where a filtered method errs most, compared with the yardstick
};

/// The square in which the sum of `map` is largest, on a grid of half its side.
Rect largest_square(const std::vector<double>& map, int width, int height, int side) {
    Rect best{0, 0, side, side};
    double most = -INFINITY;
    for (int y = 0; y + side <= height; y += std::max(1, side / 2))
        for (int x = 0; x + side <= width; x += std::max(1, side / 2)) {
            double sum = 0;
            for (int j = y; j < y + side; ++j)
                for (int i = x; i < x + side; ++i) sum += map[std::size_t(j) * width + i];
            if (sum > most) {
                most = sum;
                best = {x, y, side, side};
            }
        }
    return best;
}

Places choose_places(const SceneAnalysis& scene, double time_s) {
    const Reference& reference = scene.scene->reference;
    const int width = reference.mean.width, height = reference.mean.height;
    const int side =
        std::min({std::max(8, int(kInsetShare * std::max(width, height))), width, height});
    const auto error_of = [&](const Curve& curve) {
        return relative_error(*nearest_rung(curve, time_s).images.front(), reference.mean);
    };
    const std::vector<double> plain = error_of(scene.curves[scene.yardstick]);
    std::vector<double> excess(plain.size(), 0.0);
    bool any = false;
    for (const Curve& curve : scene.curves) {
        if (!curve.method->biased) continue;
        any = true;
        const std::vector<double> error = error_of(curve);
        for (std::size_t i = 0; i < excess.size(); ++i)
            excess[i] = std::max(excess[i], error[i] - plain[i]);
    }
    Places places;
    places.noisy = largest_square(plain, width, height, side);
    places.worst = any ? largest_square(excess, width, height, side) : places.noisy;
    return places;
}

std::string insets(const Picture& picture, const Places& places, const std::string& name) {
    return "<div class=\"insets\">" +
           img_html(crop_of(picture, places.noisy), name + ", first detail", true) +
           img_html(crop_of(picture, places.worst), name + ", second detail", true) + "</div>";
}

std::string place_text(const Rect& r) {
    return fmt::format("x {}–{}, y {}–{}", r.x, r.x + r.width, r.y, r.y + r.height);
}

}  // namespace

std::string strip_html(const SceneAnalysis& scene) {
    const SceneRuns& runs = *scene.scene;
    const Curve& yardstick = scene.curves[scene.yardstick];
    const double time_s = yardstick.rungs[yardstick.rungs.size() / 2].time_s.median;
    const Places places = choose_places(scene, time_s);
    const int width = runs.film.width, height = runs.film.height;
    const double full =
        std::max(1e-6, quantile(relative_error(*nearest_rung(yardstick, time_s).images.front(),
                                               runs.reference.mean),
                                kBrightest));

    std::string html = fmt::format(
        "<p class=\"soft\">About {} each, first seed. Details: where {} errs most ({}), and where "
        "a "
        "filtered method is worst beside it ({}). Error: |t − r| / (r + 0.01), brightest from {} "
        "on.</p>\n<div class=\"strip\">\n",
        short_seconds(time_s), yardstick.method->name, place_text(places.noisy),
        place_text(places.worst), short_number(full));
    const Picture truth = developed(runs.reference.mean, runs.exposure);
    html += "<figure>" +
            img_html(shrunk(truth, kPictureSide_px), runs.name + ", reference", false) +
            insets(truth, places, "reference") +
            fmt::format("<figcaption><strong>reference</strong> {} samples</figcaption></figure>\n",
                        runs.reference.spp);
    for (const Curve& curve : scene.curves) {
        const Rung& rung = nearest_rung(curve, time_s);
        const Picture picture = developed(*rung.images.front(), runs.exposure);
        const Picture error = heat_map(relative_error(*rung.images.front(), runs.reference.mean),
                                       width, height, full);
        const std::string name = curve.method->name;
        html +=
            "<figure>" +
            img_html(shrunk(picture, kPictureSide_px), runs.name + ", " + name, false) +
            insets(picture, places, name) + "<div style=\"margin-top:4px\">" +
            img_html(shrunk(error, kPictureSide_px), "error of " + name, false) + "</div>" +
            insets(error, places, "error of " + name) +
            fmt::format(
                "<figcaption><strong>{}</strong> {}, {}, {} samples a pixel, RMSE "
                "{}</figcaption></figure>\n",
                name, text_of(rung.budget), short_seconds(rung.time_s.median),
                short_number(rung.samples_per_pixel.median), short_number(rung.metrics[0].median));
    }
    return html + "</div>\n";
}

std::string bias_maps_html(const SceneAnalysis& scene) {
    constexpr double kFull = 0.1;
    std::string figures;
    for (const Curve& curve : scene.curves) {
        if (!curve.bias_map) continue;
        const BiasMap& map = *curve.bias_map;
        const std::vector<double> values(map.relative.pixels.begin(), map.relative.pixels.end());
        figures +=
            "<figure>" +
            img_html(shrunk(signed_map(values, map.relative.width, map.relative.height, kFull),
                            kPictureSide_px),
                     std::string("bias of ") + curve.method->name, false) +
            fmt::format(
                "<figcaption><strong>{}</strong> {}: {:.1f} % of blocks have p &lt; 5 %, {} "
                "of {} remain after correction for their number</figcaption></figure>\n",
                curve.method->name, text_of(curve.rungs.back().budget),
                100 * map.share_below_5_percent, map.significant, map.tests);
    }
    if (figures.empty()) return "";
    return "<h3>Bias maps</h3>\n<p class=\"soft\">Mean over seeds less reference, over reference + "
           "0.01, at the highest budget: blue too dark, red too bright, full colour at 10 %. "
           "Welch's "
           "test on blocks of 4 x 4 px; without bias 5 % have p &lt; 5 %. With few seeds it sees "
           "large bias only.</p>\n<div class=\"strip\">\n" +
           figures + "</div>\n";
}

}  // namespace wedge::converge
