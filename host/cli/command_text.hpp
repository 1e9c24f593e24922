// The command as it was typed, for reports.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace wedge::cli {

/// `wedge bench NAME` with all options that were given, in the order of --help, quoted for a shell;
/// but for where results go: whoever repeats it has folders of their own.
std::string command_text(const CLI::App& command);

}  // namespace wedge::cli
