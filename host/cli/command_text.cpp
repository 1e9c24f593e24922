#include "host/cli/command_text.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace wedge::cli {
namespace {

/// Where results go, and what they are called.
constexpr std::array<std::string_view, 4> kPlaces = {"--output", "--references", "--markdown",
                                                     "--title"};

/// As a shell takes it.
std::string quoted(const std::string& word) {
    if (word.find_first_of(" '\"&;|<>()$*?\\") == std::string::npos && !word.empty()) return word;
    std::string text = "'";
    for (char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string option_text(const CLI::Option& option) {
    const std::string name = option.get_positional() ? "" : " " + option.get_name();
    if (option.get_items_expected_max() == 0) return name;  // a flag
    std::vector<std::string> words;
    for (const std::string& word : option.results()) words.push_back(quoted(word));
    if (option.get_delimiter() != '\0')
        return fmt::format("{} {}", name, fmt::join(words, std::string(1, option.get_delimiter())));
    std::string text;
    for (const std::string& word : words) text += name + " " + word;
    return text;
}

}  // namespace

std::string command_text(const CLI::App& command) {
    std::string text = "wedge bench " + command.get_name();
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0 &&
            std::find(kPlaces.begin(), kPlaces.end(), option->get_name()) == kPlaces.end())
            text += option_text(*option);
    return text;
}

}  // namespace wedge::cli
