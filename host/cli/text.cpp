#include "host/cli/text.hpp"

#include <fmt/format.h>

#include <array>

namespace wedge::cli {
namespace {

// Three significant digits, enough for rates and sizes that vary by per cents from run to run.
std::string three_digits(double value) {
    const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
    return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

std::string text_of_count(double count) {
    constexpr std::array<const char*, 5> kPrefixes{"", " k", " M", " G", " T"};
    std::size_t prefix = 0;
    while (count >= 999.5 && prefix + 1 < kPrefixes.size()) count /= 1000, ++prefix;
    if (prefix == 0) return fmt::format("{:.0f}", count);
    return three_digits(count) + kPrefixes[prefix];
}

std::string text_of_bytes(uint64_t bytes) {
    constexpr std::array<const char*, 5> kUnits{"B", "KiB", "MiB", "GiB", "TiB"};
    double value = double(bytes);
    std::size_t unit = 0;
    while (value >= 1023.5 && unit + 1 < kUnits.size()) value /= 1024, ++unit;
    if (unit == 0) return fmt::format("{} B", bytes);
    return three_digits(value) + " " + kUnits[unit];
}

std::string text_of_seconds(double seconds) {
    if (seconds < 0.9995) return fmt::format("{:.0f} ms", 1000 * seconds);
    if (seconds < 59.95) return three_digits(seconds) + " s";
    const auto whole = uint64_t(seconds + 0.5);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string text_of_number(uint64_t number) {
    const std::string digits = std::to_string(number);
    std::string grouped;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) grouped += ' ';
        grouped += digits[i];
    }
    return grouped;
}

}  // namespace wedge::cli
