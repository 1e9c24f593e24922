#include "host/scene/mtl_text.hpp"

#include <fmt/format.h>

#include "host/scene/materials.hpp"
#include "host/scene/words.hpp"
#include "wedge/shared/radiance.h"

namespace wedge::scene {
namespace {

constexpr std::size_t kMostListed = 3;

/// What is wrong with the colour on a line, if anything.
const char* flaw_of_color(std::string_view line, bool is_emission) {
    // Spectra and CIE coordinates have names of their own, and nobody writes them.
    if (line.starts_with("spectral") || line.starts_with("xyz")) return nullptr;
    for (int channel = 0; channel < 3 && !line.empty(); ++channel) {
        const double value = number_in(take_word(line));
        if (std::isnan(value)) return "no finite number; 0 is used";
        if (value < 0) return "negative; 0 is used";
        if (is_emission && value > WEDGE_LARGEST_RADIANCE) return "above 2^51, which is used";
    }
    return nullptr;
}

const char* flaw_of_exponent(std::string_view line) {
    const double value = number_in(take_word(line));
    if (std::isnan(value)) return "no finite number; 0 is used";
    if (value < 0) return "negative; 0 is used";
    return value > kLargestExponent ? "above 1000000, which is used" : nullptr;
}

/// Options come first and the file name, which may hold blanks, last.
const char* flaw_of_texture(std::string_view line) {
    while (line.starts_with('-')) {
        const std::string_view option = take_word(line);
        int numbers = option == "-s" || option == "-o" || option == "-t" ? 3
                      : option == "-mm"                                  ? 2
                      : option == "-bm" || option == "-boost"            ? 1
                                                                         : 0;
        if (numbers == 0) take_word(line);
        // Fewer than three are allowed, and then the file name follows.
        for (bool first = true; numbers > 0; --numbers, first = false) {
            std::string_view rest = line;
            const bool is_number = !std::isnan(number_in(take_word(rest)));
            if (!is_number && first) return "no finite number; the option's default is used";
            if (!is_number) break;
            line = rest;
        }
    }
    return nullptr;
}

const char* flaw_of(std::string_view keyword, std::string_view line) {
    if (keyword == "Kd" || keyword == "Ks" || keyword == "Ke")
        return flaw_of_color(line, keyword == "Ke");
    if (keyword == "Ns") return flaw_of_exponent(line);
    const bool texture = keyword.starts_with("map_") || keyword == "bump" || keyword == "norm";
    return texture ? flaw_of_texture(line) : nullptr;
}

}  // namespace

std::string describe_bad_numbers(std::string_view mtl) {
    std::string list;
    std::size_t number = 0, flaws = 0;
    for (std::string_view rest = mtl; !rest.empty();) {
        std::string_view line = take_line(rest);
        const std::string_view whole = line;
        ++number;
        const char* flaw = flaw_of(take_word(line), line);
        if (flaw && ++flaws <= kMostListed)
            list += fmt::format("{}:{}: {}: {}", flaws > 1 ? "; " : "", number, whole.substr(0, 60),
                                flaw);
    }
    if (flaws > kMostListed) list += fmt::format("; and {} more lines", flaws - kMostListed);
    return list;
}

std::string with_white_beside_maps(std::string_view mtl) {
    std::string text;
    bool has_color = false;
    for (std::string_view rest = mtl; !rest.empty();) {
        const std::string_view before = rest;
        std::string_view line = take_line(rest);
        const std::string_view keyword = take_word(line);
        if (keyword == "newmtl") has_color = false;
        if (keyword == "map_Kd" && !has_color) text += "Kd 1 1 1\n";
        if (keyword == "Kd" || keyword == "map_Kd") has_color = true;
        text += before.substr(0, before.size() - rest.size());
    }
    return text;
}

}  // namespace wedge::scene
