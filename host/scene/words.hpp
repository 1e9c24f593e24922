// Lines and words of the text formats, OBJ and MTL.
#pragma once

#include <charconv>
#include <cmath>
#include <string_view>

namespace wedge::scene {

inline constexpr std::string_view kBlank = " \t\r";

inline std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Takes the first line off `text`; trimmed.
inline std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return trimmed(line);
}

/// Takes the first word off a trimmed line.
inline std::string_view take_word(std::string_view& line) {
    const std::size_t end = line.find_first_of(kBlank);
    const std::string_view word = line.substr(0, end);
    line = end == std::string_view::npos ? std::string_view() : trimmed(line.substr(end));
    return word;
}

/// The number a whole word stands for; NaN where it is none or does not fit single precision.
inline double number_in(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc::invalid_argument || end != word.data() + word.size()) return NAN;
    // A magnitude below the smallest double is reported as out of range too, but is as good as 0.
    if (error == std::errc::result_out_of_range) return word.find("e-") == word.npos ? NAN : 0;
    return std::isfinite(float(number)) ? number : NAN;
}

}  // namespace wedge::scene
