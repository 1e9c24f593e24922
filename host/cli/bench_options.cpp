#include "host/cli/bench_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "bench/converge/session.hpp"
#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/messages.hpp"

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

void add_list(CLI::App& command, const std::string& name, std::vector<std::string>& values,
              const std::string& help) {
    command.add_option(name, values, help)->delimiter(',')->allow_extra_args(false);
}

void add_budgets(CLI::App& command, MeasuringArguments& arguments, const std::string& help) {
    command.add_option("--budgets", arguments.budgets, help)->allow_extra_args(false);
}

void add_measuring_options(CLI::App& command, MeasuringArguments& arguments) {
    command.add_option("--asset-path", arguments.asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command.add_option("--device", arguments.device, "Index, part of a name, cpu or gpu");
    command.add_option("--kernel-dir", arguments.kernel_dir, "Read kernels from this source tree");
    command.add_flag("--any-build", arguments.any_build,
                     "Take finished runs of other builds of the program too");
}

void take_measuring_arguments(const MeasuringArguments& arguments, converge::Config& config) {
    for (const std::string& text : arguments.budgets) converge::parse_budgets(text, config.budgets);
    if (arguments.seeds) config.seeds = *arguments.seeds;
    if (arguments.reference_spp) config.reference_spp = *arguments.reference_spp;
    config.folder = arguments.folder;
    config.references = arguments.references;
    config.device = arguments.device;
    config.kernel_dir = arguments.kernel_dir;
    config.any_build = arguments.any_build;
}

std::string command_text(const CLI::App& command) {
    std::string text = "wedge bench " + command.get_name();
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0 &&
            std::find(kPlaces.begin(), kPlaces.end(), option->get_name()) == kPlaces.end())
            text += option_text(*option);
    return text;
}

void measure_until_stopped(converge::Config& config, const MeasuringArguments& arguments,
                           const std::function<void(const LoadOptions& load)>& measure) {
    const LoadOptions load = load_options(arguments.asset_paths);
    const InterruptScope interrupt;
    config.stop = &InterruptScope::requested();
    try {
        measure(load);
    } catch (const converge::Stopped&) {
        say("stopped; the same command goes on from here");
        throw Interrupted{};
    }
}

}  // namespace wedge::cli
