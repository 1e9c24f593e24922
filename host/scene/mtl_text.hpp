// The text of an MTL file before it is parsed: the parser takes what cannot be meant, and makes up
// what is left unsaid, without a word.
#pragma once

#include <string>
#include <string_view>

namespace wedge::scene {

/// `:3: Kd -1 0 0: …; :7: …; and 2 more`: lines whose colours are negative or no numbers, whose
/// exponents are out of range, whose texture options are no numbers. Empty if there are none.
std::string describe_bad_numbers(std::string_view mtl);

/// With `Kd 1 1 1` before each `map_Kd` that stands before any other Kd of its material. The parser
/// would take 0.6.
std::string with_white_beside_maps(std::string_view mtl);

}  // namespace wedge::scene
