#include "host/cli/numbers.hpp"

#include <charconv>

#include "wedge/error.hpp"

namespace wedge::cli {

std::vector<int> parse_integers(const std::string& option, const std::string& text,
                                std::string_view separators, std::size_t count,
                                const std::string& form) {
    std::vector<int> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (numbers.size() < count) {
        int number = 0;
        const auto [rest, fault] = std::from_chars(at, end, number);
        if (fault != std::errc{}) break;
        numbers.push_back(number);
        at = rest;
        const bool more = at != end && separators.find(*at) != std::string_view::npos;
        if (numbers.size() == count || !more) break;
        ++at;
    }
    if (numbers.size() != count || at != end)
        throw Error(ErrorKind::usage, option + ": expected " + form + ", got '" + text + "'");
    return numbers;
}

}  // namespace wedge::cli
