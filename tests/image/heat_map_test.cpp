#include "host/image/heat_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>

#include "host/base/srgb.hpp"
#include "host/image/bitmap_font.hpp"
#include "host/image/codec.hpp"
#include "host/image/color_map.hpp"
#include "host/image/heat_legend.hpp"
#include "host/image/tone.hpp"
#include "tests/image/support.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using namespace wedge::image;

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

HeatLayer layer_of(int width, int height, float least, float step) {
    HeatLayer layer{"width.direct, px", false, Plane<float>(width, height)};
    for (std::size_t i = 0; i < layer.values.values.size(); ++i)
        layer.values.values[i] = least + step * float(i);
    return layer;
}

double luminance_of(RgbCode code) {
    const auto linear = [&](int c) { return srgb_decode(float(code[std::size_t(c)]) / 255); };
    return luminance<double>(linear(0), linear(1), linear(2));
}

/// The dots of a picture as text, one character a dot: a person can check it at a glance.
std::string dots(const RgbCanvas& canvas, int left, int top, int scale) {
    std::string text;
    for (int y = 0; y < kGlyphHeight - 2; ++y) {
        for (int x = 0; x < kGlyphWidth; ++x)
            text += canvas.at(left + x * scale, top + y * scale) == kLegendInk ? '#' : '.';
        text += '\n';
    }
    return text;
}

/// Reads text back from a picture, by comparing dots with every glyph's.
std::string read_text(const RgbCanvas& canvas, const HeatLegend::Text& text, int top, int scale) {
    const std::string known = "0123456789abcdefghijklmnopqrstuvwxyzZ %(),-+./:^";
    std::string read;
    for (std::size_t i = 0; i < text.text.size(); ++i) {
        const int left = text.left + int(i) * kGlyphAdvance * scale;
        for (const char c : known) {
            bool same = true;
            for (int y = 0; y < kGlyphHeight * scale; ++y)
                for (int x = 0; x < kGlyphWidth * scale; ++x)
                    same &= glyph_dot(c, x / scale, y / scale) ==
                            (canvas.at(left + x, top + text.top + y) == kLegendInk);
            if (same) read += c;
        }
    }
    return read;
}

}  // namespace

TEST_CASE("numeral_two_looks_like_a_two") {
    RgbCanvas canvas(20, 20, kLegendBackground);
    draw_text(canvas, 3, 1, "2", 2, kLegendInk);
    CHECK(dots(canvas, 3, 1, 2) ==
          ".###.\n"
          "#...#\n"
          "....#\n"
          "...#.\n"
          "..#..\n"
          ".#...\n"
          "#####\n");
    CHECK(canvas.at(3 + 2 * kGlyphWidth, 1 + 12) == kLegendBackground);
}

TEST_CASE("every_glyph_differs_from_every_other") {
    const std::string known = "0123456789abcdefghijklmnopqrstuvwxyzZ %(),-+./:^\x7f";
    std::set<std::string> shapes;
    for (const char c : known) {
        std::string shape;
        for (int y = 0; y < kGlyphHeight; ++y)
            for (int x = 0; x < kGlyphWidth; ++x) shape += glyph_dot(c, x, y) ? '#' : '.';
        shapes.insert(shape);
    }
    CHECK(shapes.size() == known.size());
    CHECK_FALSE(glyph_dot('8', -1, 0));
    CHECK_FALSE(glyph_dot('8', 0, kGlyphHeight));
}

TEST_CASE("text_beyond_the_canvas_is_cut") {
    RgbCanvas canvas(7, 5, kLegendBackground);
    draw_text(canvas, -4, -3, "888", 3, kLegendInk);
    CHECK(canvas.codes.size() == 3 * 7 * 5);
}

TEST_CASE("heat_colours_are_near_viridis_and_grow_in_luminance") {
    // Entries of the table that its authors published, by index of 255.
    const std::pair<int, RgbCode> published[] = {
        {0, {68, 1, 84}},      {7, {70, 11, 94}},     {23, {72, 33, 115}},   {64, {59, 82, 139}},
        {100, {42, 118, 142}}, {127, {33, 144, 141}}, {200, {112, 207, 87}}, {255, {253, 231, 37}}};
    for (const auto& [index, code] : published)
        for (std::size_t c = 0; c < 3; ++c) {
            CAPTURE(index);
            CHECK(std::abs(int(heat_colour(float(index) / 255)[c]) - int(code[c])) <= 4);
        }
    // In steps that are larger than the rounding to codes.
    for (int i = 1; i <= 100; ++i)
        CHECK(luminance_of(heat_colour(float(i) / 100)) >
              luminance_of(heat_colour(float(i - 1) / 100)));
    CHECK(heat_colour(-3) == heat_colour(0));
    CHECK(heat_colour(7) == heat_colour(1));
    CHECK(heat_colour(kNone) == heat_colour(0));
}

TEST_CASE("range_is_of_the_1st_and_99th_percentile") {
    std::vector<float> values;  // 1 to 200: 2 of them are at most the 1st percentile
    for (int i = 0; i < 200; ++i) values.push_back(float((i * 77) % 200 + 1));
    const HeatRange range = heat_range(values);
    CHECK(range.least == 2);
    CHECK(range.most == 198);
    CHECK(range.smallest == 1);
    CHECK(range.largest == 200);
    CHECK_FALSE(range.covers_all);
    CHECK_FALSE(range.logarithmic);  // 99 : 1
    CHECK(heat_place(range, 100) == doctest::Approx(0.5));
    CHECK(heat_place(range, 1) == 0);
    CHECK(heat_place(range, 200) == 1);
}

TEST_CASE("range_over_two_decades_is_logarithmic") {
    const std::vector<float> values{0.01f, 0.3f, 100};
    const HeatRange range = heat_range(values);
    CHECK(range.logarithmic);
    CHECK(range.covers_all);
    CHECK(heat_place(range, 1) == doctest::Approx(0.5));
    CHECK(heat_value(range, 0.75f) == doctest::Approx(10));
    CHECK_FALSE(heat_range(std::vector<float>{1, 100}).logarithmic);
    CHECK(heat_range(std::vector<float>{1, 100.1f}).logarithmic);
    // Zeros have no logarithm: they get the first colour and are told as the smallest value.
    const HeatRange with_zeros = heat_range(std::vector<float>{0, 0, 0, 0.01f, 100});
    CHECK(with_zeros.logarithmic);
    CHECK(with_zeros.smallest == 0);
    CHECK(with_zeros.least == 0.01f);
    CHECK(heat_place(with_zeros, 0) == 0);
}

TEST_CASE("range_of_nothing_of_one_value_and_of_rare_values") {
    CHECK(heat_range({}).empty);
    CHECK(heat_range(std::vector<float>{kNone, INFINITY}).empty);
    const HeatRange zero = heat_range(std::vector<float>{0, 0, kNone});
    CHECK_FALSE(zero.empty);
    CHECK(heat_place(zero, 0) == 0.5f);
    CHECK(heat_place(heat_range(std::vector<float>{16, 16}), 16) == 0.5f);
    // 1 of 300 is beyond the percentiles; with them alone the map would be of one colour.
    std::vector<float> rare(300, 16);
    rare[17] = 64;
    CHECK(heat_range(rare).most == 64);
}

TEST_CASE("numerals_have_three_digits_and_no_needless_zeros") {
    const std::pair<float, const char*> expected[] = {{0, "0"},
                                                      {1, "1"},
                                                      {0.5f, "0.5"},
                                                      {12.345f, "12.3"},
                                                      {103.4f, "103"},
                                                      {100, "100"},
                                                      {1234.4f, "1234"},
                                                      {76800, "76800"},
                                                      {0.01234f, "0.0123"},
                                                      {0.00123f, "0.00123"},
                                                      {1.5e-5f, "1.5e-05"},
                                                      {2.5e7f, "2.5e+07"}};
    for (const auto& [value, text] : expected) CHECK(heat_numeral(value) == text);
}

TEST_CASE("legend_says_name_unit_and_the_values_at_its_ticks") {
    // Odd and even sizes, one that is enlarged, one whose letters are.
    const std::pair<int, int> sizes[] = {{320, 7}, {33, 201}, {1, 1}, {3, 2}, {1440, 2}};
    for (const auto& [width, height] : sizes) {
        CAPTURE(width);
        const float step = width * height > 1 ? 8.0f / float(width * height - 1) : 0;
        const HeatLayer layer = layer_of(width, height, 2, step);
        const HeatMap map = draw_heat_map(layer);
        const int scale = map.layout.text_scale;
        const HeatLegend legend =
            lay_out_legend(layer.title, map.range, false, width * map.layout.enlargement, scale);
        REQUIRE(map.canvas.width == legend.width);
        REQUIRE(map.canvas.height == map.layout.legend_top + legend.height);
        REQUIRE(legend.lines.size() == 3);
        CHECK(legend.lines[0].text == "width.direct, px");
        CHECK(legend.numerals.size() == (width * height > 1 ? 4 : 1));
        int free_from = 0;
        for (std::size_t i = 0; i < legend.numerals.size(); ++i) {
            const HeatLegend::Text& numeral = legend.numerals[i];
            CHECK(numeral.left >= free_from);  // they do not run into each other
            free_from = numeral.left + text_width(numeral.text, scale) + 2 * scale;
            CHECK(read_text(map.canvas, numeral, map.layout.legend_top, scale) == numeral.text);
            // The colour above the tick is that of the number below it.
            const int y = map.layout.legend_top + legend.bar_top + legend.bar_height / 2;
            const RgbCode shown = map.canvas.at(legend.ticks[i], y);
            const RgbCode meant = heat_colour(heat_place(map.range, std::stof(numeral.text)));
            for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(int(shown[c]) - int(meant[c])) <= 4);
        }
        CHECK(free_from <= legend.width);
        for (const HeatLegend::Text& line : legend.lines)
            CHECK(read_text(map.canvas, line, map.layout.legend_top, scale) == line.text);
    }
}

TEST_CASE("legend_tells_percentiles_logarithms_and_gaps") {
    HeatLayer layer = layer_of(40, 30, 1, 1);  // 1 to 1200
    layer.values.values[5] = kNone;
    const HeatMap map = draw_heat_map(layer);
    const HeatLegend legend = lay_out_legend(layer.title, map.range, true, 10, 1);
    CHECK(legend.lines[1].text == "colours span 1-99 %");
    CHECK(legend.lines[2].text == "values 1 to 1200, grey: none");
    const HeatRange wide = heat_range(std::vector<float>{0.01f, 100});
    CHECK(lay_out_legend("x", wide, false, 10, 1).lines[1].text ==
          "colours span all values, log scale");
    CHECK(lay_out_legend("x", heat_range({}), true, 10, 1).lines[1].text == "no pixel has a value");
}

TEST_CASE("film_is_enlarged_by_whole_factors_and_gaps_are_grey") {
    HeatLayer layer = layer_of(5, 3, 1, 1);
    layer.values.row(1)[3] = kNone;
    const HeatMap map = draw_heat_map(layer);
    const int k = map.layout.enlargement;
    CHECK(k == kLeastHeatSide_px / 5);
    for (int y = 0; y < 3 * k; ++y)
        for (int x = 0; x < 5 * k; ++x) {
            const float value = layer.values.row(y / k)[x / k];
            const RgbCode expected = std::isnan(value) ? kNoValue : heat_colour((value - 1) / 14);
            REQUIRE(map.canvas.at(map.layout.left + x, y) == expected);
        }
    // Large films keep their size.
    CHECK(draw_heat_map(layer_of(kLeastHeatSide_px, 2, 1, 1)).layout.enlargement == 1);
}

TEST_CASE("shares_have_colours_from_0_to_1") {
    HeatLayer layer = layer_of(2, 1, 0.25f, 0.5f);
    layer.is_share = true;
    const HeatMap map = draw_heat_map(layer);
    CHECK(map.range.least == 0);
    CHECK(map.range.most == 1);
    CHECK(map.canvas.at(map.layout.left, 0) == heat_colour(0.25f));
}

TEST_CASE("heat_map_file_holds_the_canvas") {
    const test::TemporaryFolder folder;
    const HeatLayer layer = layer_of(17, 9, 0.001f, 1);
    write_heat_map(folder / "heat.png", layer);
    const HeatMap map = draw_heat_map(layer);
    const DecodedImage file = decode(folder / "heat.png", true);
    REQUIRE(file.width == map.canvas.width);
    REQUIRE(file.height == map.canvas.height);
    REQUIRE(file.channels.size() == 3);
    CHECK(std::equal(map.canvas.codes.begin(), map.canvas.codes.end(), file.as_bytes()));
    CHECK(test::error_message(ErrorKind::output, [&] {
              write_heat_map(folder / "no/heat.png", layer);
          }).find("no/heat.png") != std::string::npos);
}
