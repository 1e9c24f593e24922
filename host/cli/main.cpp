// wedge: the command-line program. Each subcommand has its own file; here they are put together,
// and errors become one message on stderr and an exit code (docs/cli.md).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "host/base/edit_distance.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/image_support.hpp"
#include "host/cli/messages.hpp"
#include "wedge/error.hpp"
#include "wedge/render.hpp"

namespace wedge::cli {
namespace {

constexpr std::size_t kHelpColumn = 32;

void set_up(CLI::App& app) {
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("wedge ") + version());
    app.get_formatter()->column_width(kHelpColumn);
    app.footer("`wedge COMMAND --help` lists the options of a command.");
    register_render(app);
    register_devices(app);
    register_info(app);
    register_explain(app);
    register_compare_if_supported(app);
    register_bench(app);
}

/// The innermost command that was named, and how.
struct Named {
    const CLI::App* command;
    std::string words;
};

Named innermost(const CLI::App& app) {
    Named named{&app, "wedge"};
    while (!named.command->get_subcommands().empty()) {
        named.command = named.command->get_subcommands().front();
        named.words += " " + named.command->get_name();
    }
    return named;
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> command_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

/// `--sppp: no such option of wedge render; did you mean "--spp"?`, or the like for a command.
/// Empty where neither is the trouble.
std::string unknown_word(const CLI::App& app, const Named& named) {
    // Only long names are near others; of a short one nothing can be guessed.
    for (const std::string& word : app.remaining(true)) {
        const std::string name = word.substr(0, word.find('='));
        const std::vector<std::string> options = option_names(*named.command);
        const bool known = std::find(options.begin(), options.end(), name) != options.end();
        if (name.starts_with("--") && !known)
            return name + ": no such option of " + named.words + suggestion(name, options);
        const std::vector<std::string> commands = command_names(*named.command);
        if (!name.starts_with("-") && !commands.empty())
            return name + ": no such command of " + named.words + suggestion(name, commands);
    }
    return "";
}

int explain(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const Named named = innermost(app);
    const std::string unknown = unknown_word(app, named);
    say_error((unknown.empty() ? error.what() : unknown) + "\nsee " + named.words + " --help");
    return int(ErrorKind::usage);
}

int run(int argc, char** argv) {
    install_messages();
    CLI::App app{"Wedge: physically based rendering on any OpenCL device", "wedge"};
    set_up(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return explain(app, error);
    } catch (const Interrupted&) {
        return kExitInterrupted;
    } catch (const Error& error) {
        say_error(error.what());
        return int(error.kind());
    }
    return 0;
}

}  // namespace
}  // namespace wedge::cli

int main(int argc, char** argv) {
    using namespace wedge;
    try {
        return cli::run(argc, argv);
    } catch (const std::bad_alloc&) {
        cli::say_error("there is not enough memory; render a smaller film or scene");
        return int(ErrorKind::device);
    } catch (const std::exception& error) {
        cli::say_error(std::string("internal error: ") + error.what());
    }
    return int(ErrorKind::internal);
}
