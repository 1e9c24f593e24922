// Bars: what a run's time goes into, pass by pass.
#include <algorithm>
#include <map>

#include "bench/converge/html.hpp"
#include "bench/converge/report_sections.hpp"

namespace wedge::converge {
namespace {

struct Part {
    std::string name;
    double seconds;
};

/// Medians over seeds of each pass and phase that counts, and what is left of the time.
std::vector<Part> counted_parts(const Rung& rung) {
    std::map<std::string, std::vector<double>> seconds;
    std::vector<std::string> order{"placing", "copying"};
    const auto add = [&](const std::string& name, double s) {
        if (std::find(order.begin(), order.end(), name) == order.end()) order.push_back(name);
        seconds[name].push_back(s);
    };
    for (const RunRecord* run : rung.runs) {
        add("placing", run->flatten_s);
        add("copying", run->upload_s);
        std::map<std::string, double> passes;  // a name may come more than once
        double inside = 0;
        for (const PassStats& pass : run->passes) {
            if (!passes.count(pass.name)) add(pass.name, 0);
            passes[pass.name] += pass.device_s;
            seconds[pass.name].back() = passes[pass.name];
            inside += pass.device_s;
        }
        add("host and waiting", std::max(0.0, run->render_s - inside));
    }
    std::vector<Part> parts;
    for (const std::string& name : order) parts.push_back({name, quantile(seconds[name], 0.5)});
    return parts;
}

double median_of(const Rung& rung, double RunRecord::*field) {
    std::vector<double> values;
    for (const RunRecord* run : rung.runs) values.push_back(run->*field);
    return quantile(values, 0.5);
}

/// Colours of parts, shared by all bars of a scene.
class PartColours {
  public:
    std::size_t of(const std::string& name) {
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found != names_.end()) return std::size_t(found - names_.begin());
        names_.push_back(name);
        return names_.size() - 1;
    }
    std::string chips() const {
        std::string html = "<ul class=\"chips\">";
        for (std::size_t i = 0; i < names_.size(); ++i)
            html += fmt::format("<li class=\"{}\">{}</li>", series_class(i), escaped(names_[i]));
        return html + "</ul>\n";
    }

  private:
    std::vector<std::string> names_;
};

std::string bar(const std::string& name, const std::vector<Part>& parts, double full,
                PartColours& colours) {
    std::string html = fmt::format("<span>{}</span><span class=\"bar\">", escaped(name));
    double sum = 0;
    for (const Part& part : parts) {
        sum += part.seconds;
        html += fmt::format("<span class=\"b {}\" style=\"width:{:.2f}%\" title=\"{}: {}\"></span>",
                            series_class(colours.of(part.name)), 100 * part.seconds / full,
                            escaped(part.name), short_seconds(part.seconds));
    }
    return html + fmt::format("</span><span class=\"num\">{}</span>\n", short_seconds(sum));
}

double total(const std::vector<Part>& parts) {
    double sum = 0;
    for (const Part& part : parts) sum += part.seconds;
    return sum;
}

using Bars = std::vector<std::pair<std::string, std::vector<Part>>>;

std::string bars_html(const Bars& bars) {
    double full = 1e-12;
    for (const auto& [name, parts] : bars) full = std::max(full, total(parts));
    PartColours colours;
    std::string html;
    for (const auto& [name, parts] : bars) html += bar(name, parts, full, colours);
    return colours.chips() + "<div class=\"bars\">\n" + html + "</div>\n";
}

}  // namespace

std::string costs_section(const SceneAnalysis& scene) {
    Bars counted, apart;
    Table table{{"method", "budget", "part", "seconds", "share"}, {}};
    for (const Curve& curve : scene.curves) {
        for (const Rung& rung : curve.rungs) {
            const std::vector<Part> parts = counted_parts(rung);
            for (const Part& part : parts)
                table.rows.push_back({curve.method->name, text_of(rung.budget), escaped(part.name),
                                      short_number(part.seconds),
                                      fmt::format("{:.1f} %", 100 * part.seconds / total(parts))});
        }
        const Rung& last = curve.rungs.back();
        counted.emplace_back(fmt::format("{}, {}", curve.method->name, text_of(last.budget)),
                             counted_parts(last));
        apart.emplace_back(
            curve.method->name,
            std::vector<Part>{{"building the BVH", median_of(last, &RunRecord::bvh_build_s)},
                              {"compiling kernels", median_of(last, &RunRecord::compile_s)}});
    }
    return "<h3>What the time goes into</h3>\n<p class=\"soft\">Highest budget of each method, "
           "medians over seeds.</p>\n" +
           bars_html(counted) +
           "<p class=\"soft\">Not counted above (compiled kernels come from a cache after the "
           "first "
           "run):</p>\n" +
           bars_html(apart) + "<details><summary>All budgets, in numbers</summary>\n" +
           table_html(table) + "</details>\n";
}

}  // namespace wedge::converge
