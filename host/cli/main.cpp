// wedge: the command-line program. Each subcommand has its own file; here they are put together,
// and errors become one message on stderr and an exit code (docs/cli.md).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

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
    register_compare_if_supported(app);
    register_bench(app);
}

// The innermost command that was named: the one whose help would have been of use.
std::string help_command(const CLI::App& app) {
    std::string command = "wedge";
    const CLI::App* at = &app;
    while (!at->get_subcommands().empty()) {
        at = at->get_subcommands().front();
        command += " " + at->get_name();
    }
    return command + " --help";
}

int explain(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    say_error(std::string(error.what()) + "\nsee " + help_command(app));
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
        cli::say_error("out of memory");
    } catch (const std::exception& error) {
        cli::say_error(std::string("internal error: ") + error.what());
    }
    return int(ErrorKind::internal);
}
