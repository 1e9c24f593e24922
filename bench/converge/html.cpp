#include "bench/converge/html.hpp"

#include <cmath>

namespace wedge::converge {
namespace {

constexpr std::size_t kColours = 20;  // in the style sheet
constexpr double kMark_px = 3.6;      // half a mark's size

}  // namespace

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string short_number(double value) {
    if (!std::isfinite(value)) return "–";
    if (value == 0) return "0";
    const double size = std::abs(value);
    if (size >= 1e5 || size < 1e-4) return fmt::format("{:.2e}", value);
    // Not 1.000 for what rounds up to 1.
    const int decimals = std::max(0, 2 - int(std::floor(std::log10(size * (1 + 0.0005)))));
    return fmt::format("{:.{}f}", value, decimals);
}

std::string short_seconds(double seconds) {
    if (seconds < 1) return short_number(seconds * 1e3) + " ms";
    if (seconds < 120) return short_number(seconds) + " s";
    return short_number(seconds / 60) + " min";
}

std::string short_count(double count) {
    if (count < 1e3) return short_number(count);
    if (count < 1e6) return short_number(count / 1e3) + " k";
    if (count < 1e9) return short_number(count / 1e6) + " M";
    return short_number(count / 1e9) + " G";
}

std::string text_of(const Budget& budget) {
    if (budget.unit == BudgetUnit::mu) return fmt::format("µ {:g}", budget.value);
    return fmt::format("{:g} {}", budget.value, name_of(budget.unit));
}

std::string text_of(const Ratio& ratio) {
    switch (ratio.kind) {
        case Ratio::exact:
            return short_number(ratio.value);
        case Ratio::at_most:
            return "≤ " + short_number(ratio.value);
        case Ratio::unreached:
            return "not reached";
        case Ratio::late:
            return "not done";
        default:
            return "–";
    }
}

std::size_t series_of(const Method& method) {
    return std::size_t(&method - all_methods().data());
}

std::string series_class(std::size_t index) {
    return fmt::format("s{}", index % kColours);
}

std::string marker_svg(std::size_t index, double x, double y) {
    const double r = kMark_px;
    const std::string name = series_class(index);
    const auto polygon = [&](std::initializer_list<std::pair<double, double>> corners) {
        std::string points;
        for (const auto& [dx, dy] : corners)
            points += fmt::format("{:.1f},{:.1f} ", x + dx * r, y + dy * r);
        return fmt::format("<polygon class=\"mark {}\" points=\"{}\"/>", name, points);
    };
    // Where colours come again, marks do not.
    switch ((index + index / kColours) % 5) {
        case 0:
            return fmt::format("<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>",
                               name, x, y, r);
        case 1:
            return polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
        case 2:
            return polygon({{0, -1.3}, {1.2, 0.9}, {-1.2, 0.9}});
        case 3:
            return polygon({{0, -1.4}, {1.4, 0}, {0, 1.4}, {-1.4, 0}});
        default:
            return polygon({{0, 1.3}, {1.2, -0.9}, {-1.2, -0.9}});
    }
}

std::string legend_html(const std::vector<Curve>& curves) {
    std::string html = "<ul class=\"legend\">";
    for (std::size_t i = 0; i < curves.size(); ++i)
        html += fmt::format(
            "<li title=\"{}\"><svg class=\"swatch\" viewBox=\"0 0 26 12\" "
            "aria-hidden=\"true\"><line "
            "class=\"line {}\" x1=\"1\" y1=\"6\" x2=\"25\" y2=\"6\"/>{}</svg>{}</li>",
            escaped(curves[i].method->label), series_class(series_of(*curves[i].method)),
            marker_svg(series_of(*curves[i].method), 13, 6), escaped(curves[i].method->name));
    return html + "</ul>\n";
}

std::string table_html(const Table& table) {
    std::string html = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string& cell : table.head) html += "<th scope=\"col\">" + cell + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            html += i == 0 ? "<th scope=\"row\">" + row[i] + "</th>" : "<td>" + row[i] + "</td>";
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

// Colours: a set that stays apart for the common kinds of colour blindness, darker on white and
// lighter on black.
const char* const kStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #fbfaf8; --card: #ffffff; --ink: #1d1f23; --soft: #62666d; --rule: #dcdad5; --grid: #e9e7e2;
  --good: #1b7a3d; --bad: #b3261e; --note: #fff4d6;
  --c0: #4a4f57; --c1: #8a8f98; --c2: #b58900; --c3: #0b63ce; --c4: #c2410c; --c5: #0f8a6d;
  --c6: #8b3fc0; --c7: #c21d6b; --c8: #5b7c12; --c9: #0891b2;
  --c10: #a0522d; --c11: #2e9e3f; --c12: #7c5cff; --c13: #00a69c; --c14: #a39274; --c15: #1f3fa8;
  --c16: #d97706; --c17: #e05d8a; --c18: #3f7f5f; --c19: #9c27b0;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #131417; --card: #1b1d21; --ink: #e9e7e2; --soft: #a3a7ae; --rule: #34373d; --grid: #2a2d32;
    --good: #6fd08c; --bad: #ff8a80; --note: #3a3015;
    --c0: #d5d7db; --c1: #90959d; --c2: #e2b93b; --c3: #6aa8ff; --c4: #ff9052; --c5: #45cfae;
    --c6: #c792f0; --c7: #ff79b0; --c8: #a8cf4d; --c9: #56d0ea;
    --c10: #d08a62; --c11: #6fdc7d; --c12: #a994ff; --c13: #3fe0cf; --c14: #cfc2ad; --c15: #8fa6ff;
    --c16: #ffb340; --c17: #ff9fc0; --c18: #8fc7a8; --c19: #e08cf0;
  }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem clamp(.75rem, 3vw, 2.5rem) 4rem; max-width: 82rem; background: var(--page);
  color: var(--ink); font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0 .25rem; }
h2 { font-size: 1.35rem; margin: 2.5rem 0 .5rem; padding-top: .75rem; border-top: 2px solid var(--ink); }
h3 { font-size: 1.05rem; margin: 1.75rem 0 .4rem; }
p, li { max-width: 72ch; }
.lead, .soft { color: var(--soft); }
.soft { font-size: .875rem; margin: .25rem 0 .75rem; }
nav { margin-bottom: 1rem; } nav a { color: inherit; margin-right: .9rem; display: inline-block; }
code { font: .84em/1.45 ui-monospace, "SFMono-Regular", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
pre { white-space: pre-wrap; background: var(--card); border: 1px solid var(--rule); border-radius: 6px; padding: .6rem .8rem; }
.warn { background: var(--note); border-left: 4px solid var(--c2); padding: .5rem .9rem; border-radius: 4px; }
.warn ul { margin: .2rem 0; padding-left: 1.1rem; }
.findings { background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: .5rem 1rem; }
.findings ul { padding-left: 1.1rem; }
.cards { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 27rem), 1fr)); }
figure { margin: 0; background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: .5rem; min-width: 0; }
figcaption { font-size: .875rem; color: var(--soft); padding: 0 .25rem; }
figcaption strong { color: var(--ink); }
figure > svg { display: block; width: 100%; height: auto; }
svg text { fill: var(--ink); font-size: 13px; font-family: inherit; }
svg text.tick { fill: var(--soft); font-size: 12px; }
.grid { stroke: var(--grid); stroke-width: 1; }
.grid.minor { stroke-width: .5; }
.frame { stroke: var(--rule); stroke-width: 1; fill: none; }
.line { fill: none; stroke-width: 2; stroke-linejoin: round; }
.ribbon { stroke: none; opacity: .16; }
.mark { stroke: var(--card); stroke-width: 1; }
.guide { stroke: var(--soft); stroke-width: 1; stroke-dasharray: 3 4; fill: none; }
.legend { list-style: none; display: flex; flex-wrap: wrap; gap: .15rem 1rem; margin: .5rem 0; padding: 0; font-size: .9rem; }
.legend li { display: flex; align-items: center; gap: .35rem; }
.swatch { width: 26px; height: 12px; flex: none; }
.tables { display: flex; flex-wrap: wrap; gap: 0 2.5rem; } .tables > div { max-width: 100%; }
.scroll { overflow-x: auto; margin: .25rem 0 .5rem; }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .6rem; text-align: right; border-bottom: 1px solid var(--rule); white-space: nowrap; }
th:first-child { text-align: left; position: sticky; left: 0; background: var(--page); }
thead th { font-weight: 600; color: var(--soft); vertical-align: bottom; }
tbody th { font-weight: 600; }
td small { color: var(--soft); display: block; }
.good { color: var(--good); font-weight: 600; } .bad { color: var(--bad); font-weight: 600; }
.strip { display: grid; gap: .6rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 13.5rem), 1fr)); }
.strip img { width: 100%; height: auto; display: block; border-radius: 3px; }
.strip .insets { display: grid; grid-template-columns: 1fr 1fr; gap: 4px; margin-top: 4px; }
img.pixels { image-rendering: pixelated; }
.bars { display: grid; grid-template-columns: max-content 1fr max-content; gap: .3rem .6rem; align-items: center; font-size: .85rem; }
.bar { display: flex; height: 1.05rem; background: var(--grid); border-radius: 3px; overflow: hidden; }
.bar span { display: block; height: 100%; border-right: 1px solid var(--card); }
.bars .num { text-align: right; font-variant-numeric: tabular-nums; color: var(--soft); }
.chips { display: flex; flex-wrap: wrap; gap: .15rem .9rem; font-size: .85rem; margin: .4rem 0; padding: 0; list-style: none; }
.chips li::before { content: ""; display: inline-block; width: .75rem; height: .75rem; border-radius: 2px; margin-right: .35rem;
  background: var(--chip); vertical-align: -1px; }
details { margin: .75rem 0; } summary { cursor: pointer; font-weight: 600; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1rem; font-size: .9rem; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
@media (max-width: 34rem) {
  body { font-size: 15px; } dl { grid-template-columns: 1fr; } dd { margin-bottom: .4rem; }
  .strip { grid-template-columns: 1fr 1fr; }
  svg text { font-size: 15px; } svg text.tick { font-size: 14px; }
}
@media print { body { max-width: none; } details:not([open]) > summary { display: none; } }
)css"
                           R"css(
.s0 { stroke: var(--c0); fill: var(--c0); --chip: var(--c0); } .s1 { stroke: var(--c1); fill: var(--c1); --chip: var(--c1); }
.s2 { stroke: var(--c2); fill: var(--c2); --chip: var(--c2); } .s3 { stroke: var(--c3); fill: var(--c3); --chip: var(--c3); }
.s4 { stroke: var(--c4); fill: var(--c4); --chip: var(--c4); } .s5 { stroke: var(--c5); fill: var(--c5); --chip: var(--c5); }
.s6 { stroke: var(--c6); fill: var(--c6); --chip: var(--c6); } .s7 { stroke: var(--c7); fill: var(--c7); --chip: var(--c7); }
.s8 { stroke: var(--c8); fill: var(--c8); --chip: var(--c8); } .s9 { stroke: var(--c9); fill: var(--c9); --chip: var(--c9); }
.s10 { stroke: var(--c10); fill: var(--c10); --chip: var(--c10); } .s11 { stroke: var(--c11); fill: var(--c11); --chip: var(--c11); }
.s12 { stroke: var(--c12); fill: var(--c12); --chip: var(--c12); } .s13 { stroke: var(--c13); fill: var(--c13); --chip: var(--c13); }
.s14 { stroke: var(--c14); fill: var(--c14); --chip: var(--c14); } .s15 { stroke: var(--c15); fill: var(--c15); --chip: var(--c15); }
.s16 { stroke: var(--c16); fill: var(--c16); --chip: var(--c16); } .s17 { stroke: var(--c17); fill: var(--c17); --chip: var(--c17); }
.s18 { stroke: var(--c18); fill: var(--c18); --chip: var(--c18); } .s19 { stroke: var(--c19); fill: var(--c19); --chip: var(--c19); }
.line { fill: none; } .ribbon { stroke: none; } .mark { stroke: var(--card); } .bar .b { background: var(--chip); }
)css";

}  // namespace wedge::converge
