// Names that a person may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wedge {

/// Levenshtein distance with swaps of neighbours counted as one edit (optimal string alignment).
/// Words are cut at 256 characters, which bounds the work.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// `; did you mean "x"?` with the nearest of `known`, or `; known are "x", "y"` where none is near.
/// Empty if nothing is known.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}  // namespace wedge
