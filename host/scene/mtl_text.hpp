// Numbers in the text of an MTL file that cannot be meant; the parser takes them without a word.
#pragma once

#include <string>
#include <string_view>

namespace wedge::scene {

/// `:3: Kd -1 0 0: …; :7: …; and 2 more`: lines whose colours are negative or no numbers, whose
/// exponents are out of range, whose texture options are no numbers. Empty if there are none.
std::string describe_bad_numbers(std::string_view mtl);

}  // namespace wedge::scene
