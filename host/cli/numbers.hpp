// Small lists of numbers in one argument: 640x480, 10,20,64,64.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wedge::cli {

/// Exactly `count` integers separated by one of `separators`. Throws Error(usage):
/// "OPTION: expected FORM, got 'TEXT'".
std::vector<int> parse_integers(const std::string& option, const std::string& text,
                                std::string_view separators, std::size_t count,
                                const std::string& form);

}  // namespace wedge::cli
