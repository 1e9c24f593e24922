#include "host/scene/obj_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "host/scene/words.hpp"

namespace wedge::scene {
namespace {

bool looks_like_number(std::string_view word) {
    const std::size_t sign = !word.empty() && (word[0] == '+' || word[0] == '-');
    return word.size() > sign && (word[sign] == '.' || (word[sign] >= '0' && word[sign] <= '9'));
}

void join_continued_lines(std::string& text) {
    for (std::size_t at = text.find("\\\n"); at != std::string::npos; at = text.find("\\\n", at))
        text.replace(at, 2, "  ");
    for (std::size_t at = text.find("\\\r\n"); at != std::string::npos;
         at = text.find("\\\r\n", at))
        text.replace(at, 3, "   ");
}

/// A `\r` alone ends a line for the parser.
void unify_line_ends(std::string& text) {
    for (std::size_t at = text.find('\r'); at != std::string::npos; at = text.find('\r', at + 1))
        if (at + 1 == text.size() || text[at + 1] != '\n') text[at] = '\n';
}

/// Whether the one word on the line that begins at `start` has a blank after it.
bool has_blank_after(const std::string& text, std::size_t start) {
    const std::size_t end = text.find_first_of(" \t\r\n", text.find_first_not_of(" \t", start));
    return end != std::string::npos && (text[end] == ' ' || text[end] == '\t');
}

/// Only long numbers and those with an exponent can overflow; others need not be read twice.
bool overflows(std::string_view word) {
    constexpr std::size_t kDigitsOfFloat = 38;
    const bool may = word.size() > kDigitsOfFloat || word.find_first_of("eE") != word.npos;
    return may && std::isnan(number_in(word));
}

/// Counts a line of which one of the first `least` words, or any further, is no number.
void count_bad(BadLines& bad, std::string_view line, int least, std::size_t line_number) {
    bool sound = true;
    for (int i = 0; i < 3 && sound && (i < least || !line.empty()); ++i) {
        const std::string_view word = take_word(line);
        sound = looks_like_number(word) && !overflows(word);
    }
    if (sound) return;
    if (bad.count++ == 0) bad.first_line = line_number;
}

bool has_long_number(std::string_view line) {
    constexpr int kDigitsOfInt = 10;
    int run = 0;
    for (const char c : line) {
        run = c >= '0' && c <= '9' ? run + 1 : 0;
        if (run >= kDigitsOfInt) return true;
    }
    return false;
}

/// How many positions, texture coordinates and normals: in the order a corner names them.
struct Counts {
    long long of[3] = {0, 0, 0};

    void count(std::string_view keyword) {
        if (keyword == "v") ++of[0];
        if (keyword == "vt") ++of[1];
        if (keyword == "vn") ++of[2];
    }
};

constexpr const char* kIndexName[3] = {"vertex", "texture coordinate", "normal"};
constexpr const char* kCountName[3] = {"vertices", "texture coordinates", "normals"};

/// What is wrong with one corner, `v/vt/vn`.
std::optional<std::string> flaw(std::string_view corner, const Counts& so_far,
                                const Counts& total) {
    for (int part = 0; part < 3 && !corner.empty(); ++part) {
        const std::size_t slash = corner.find('/');
        const std::string_view digits = corner.substr(0, slash);
        corner.remove_prefix(slash == std::string_view::npos ? corner.size() : slash + 1);
        if (part == 1 && digits.empty()) continue;  // v//vn
        long long index = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), index);
        if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
            return fmt::format("\"{}\" is no {} index", digits, kIndexName[part]);
        const bool named =
            index > 0 ? index <= total.of[part] : index < 0 && -index <= so_far.of[part];
        if (error == std::errc::result_out_of_range || !named)
            return fmt::format("{} index {} is out of range, the file has {} {}", kIndexName[part],
                               digits, total.of[part], kCountName[part]);
    }
    return std::nullopt;
}

}  // namespace

ObjFacts scan_obj(std::string& text) {
    unify_line_ends(text);
    join_continued_lines(text);
    ObjFacts facts;
    std::size_t vertex = 0, line_number = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t start = std::size_t(rest.data() - text.data());
        std::string_view line = take_line(rest);
        ++line_number;
        const std::string_view keyword = take_word(line);
        if (keyword == "mtllib" && !line.empty()) facts.mtllib_lines.emplace_back(line);
        if (keyword == "f" && !facts.may_overflow) facts.may_overflow = has_long_number(line);
        // Tags of subdivision surfaces and weights of skins are not rendered, and the parser
        // believes any size and any index they claim: they become comments.
        if (keyword == "t" || keyword == "vw") text[text.find(keyword[0], start)] = '#';
        if (keyword == "vn") count_bad(facts.bad_normals, line, 3, line_number);
        if (keyword == "vt") count_bad(facts.bad_uvs, line, 1, line_number);
        // A bare `v` without a blank is no vertex to the parser.
        if (keyword != "v" || (line.empty() && !has_blank_after(text, start))) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (!looks_like_number(take_word(line)))
                facts.bad_coordinates.push_back({vertex, axis});
        ++vertex;
    }
    return facts;
}

std::size_t line_of_vertex(std::string_view text, std::size_t vertex) {
    std::size_t line_number = 0;
    for (std::string_view rest = text; !rest.empty();) {
        std::string_view line = take_line(rest);
        ++line_number;
        if (take_word(line) == "v" && vertex-- == 0) return line_number;
    }
    return 0;
}

std::string describe_bad_face(std::string_view text) {
    Counts total;
    for (std::string_view rest = text; !rest.empty();) {
        std::string_view line = take_line(rest);
        total.count(take_word(line));
    }

    Counts so_far;
    std::size_t line_number = 0, face = 0;
    for (std::string_view rest = text; !rest.empty();) {
        std::string_view line = take_line(rest);
        ++line_number;
        const std::string_view keyword = take_word(line);
        so_far.count(keyword);
        if (keyword != "f") continue;
        ++face;
        std::size_t corners = 0;
        for (; !line.empty(); ++corners)
            if (const auto what = flaw(take_word(line), so_far, total))
                return fmt::format(":{}: face {}: {}", line_number, face, *what);
        if (corners > kMostCorners)
            return fmt::format(
                ":{}: face {}: has {} corners, the limit is {}; triangulate the mesh", line_number,
                face, corners, kMostCorners);
    }
    return "";
}

}  // namespace wedge::scene
