// Numbers for people.
#pragma once

#include <cstdint>
#include <string>

namespace wedge::cli {

std::string text_of_count(double count);      ///< "950", "19.7 M"
std::string text_of_bytes(uint64_t bytes);    ///< "950 B", "1.50 GiB"
std::string text_of_seconds(double seconds);  ///< "120 ms", "12.3 s", "4 min 05 s", "1 h 02 min"
std::string text_of_number(uint64_t number);  ///< every digit: "1 234 567"

}  // namespace wedge::cli
