// Pieces of HTML and of numbers that all parts of the report use.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

/// Safe as text and between double quotes.
std::string escaped(const std::string& text);

/// Three digits: "0.00123", "12.3".
std::string short_number(double value);
std::string short_seconds(double seconds);  ///< "12.3 ms", "1.23 s", "3.4 min"
std::string short_count(double count);      ///< "950", "1.23 M"
std::string text_of(const Budget& budget);  ///< "16 spp", "µ 0.5", "2 s"
std::string text_of(const Ratio& ratio);    ///< "0.52", "≤ 0.5", "not reached", "–"

/// A method's colour and mark in all reports: its place among all methods.
std::size_t series_of(const Method& method);

/// CSS classes that give methods their colour and charts their marks, by series_of().
std::string series_class(std::size_t index);

/// Mark of a method around (x, y) as SVG; shapes differ too, for those who do not see colours.
std::string marker_svg(std::size_t index, double x, double y);

/// Swatch and name.
std::string legend_html(const std::vector<Curve>& curves);

/// <table> in a box that scrolls sideways on small screens. The first cell of a row is its head.
/// Cells hold HTML.
struct Table {
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};
std::string table_html(const Table& table);

/// The style sheet.
extern const char* const kStyle;

}  // namespace wedge::converge
