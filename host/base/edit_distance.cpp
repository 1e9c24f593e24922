#include "host/base/edit_distance.hpp"

#include <algorithm>
#include <cctype>

namespace wedge {
namespace {

constexpr std::size_t kLongestWord = 256;
constexpr std::size_t kMostListed = 12;

std::string lower(std::string_view word) {
    std::string result(word);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    a = a.substr(0, kLongestWord);
    b = b.substr(0, kLongestWord);

    // Three rows of the usual table are enough: the swap looks back two.
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitute = last[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitute});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
    if (known.empty()) return "";
    const std::string wanted = lower(word);
    const auto distance = [&](const std::string& other) {
        // A beginning (vertical_fov of vertical_fov_deg) is one slip, however much is missing.
        constexpr std::size_t kShortestBeginning = 3;
        const std::string name = lower(other);
        const bool begins = wanted.size() >= kShortestBeginning && name.starts_with(wanted);
        const std::size_t edits = edit_distance(wanted, name);
        return begins ? std::min<std::size_t>(edits, 1) : edits;
    };
    const auto nearest = std::min_element(
        known.begin(), known.end(),
        [&](const std::string& a, const std::string& b) { return distance(a) < distance(b); });

    // Half of the letters of a short word wrong, or three of a long one, is still a slip.
    if (distance(*nearest) <= std::clamp<std::size_t>(word.size() / 2, 1, 3))
        return "; did you mean \"" + *nearest + "\"?";

    std::string list = "; known are ";
    for (std::size_t i = 0; i < std::min(known.size(), kMostListed); ++i)
        list += (i ? ", \"" : "\"") + known[i] + "\"";
    return list + (known.size() > kMostListed ? ", ..." : "");
}

}  // namespace wedge
