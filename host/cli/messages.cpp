#include "host/cli/messages.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>

#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

constexpr std::size_t kFallbackColumns = 80;

std::mutex guard;
std::string status;
bool is_quiet = false;

std::size_t terminal_columns() {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kFallbackColumns;
    return size.ws_col;
}

// A full last column would wrap, and the carriage return would then land one line too low.
void draw_status() {
    std::fprintf(stderr, "\r\033[K%s", status.substr(0, terminal_columns() - 1).c_str());
    std::fflush(stderr);
}

void write_line(const std::string& line) {
    const std::lock_guard lock(guard);
    if (!status.empty()) std::fputs("\r\033[K", stderr);
    std::fprintf(stderr, "%s\n", line.c_str());
    if (!status.empty()) draw_status();
}

}  // namespace

void install_messages(bool quiet) {
    is_quiet = quiet;
    set_log_sink([](LogLevel level, const std::string& message) {
        if (level == LogLevel::warning)
            write_line("wedge: warning: " + message);
        else
            say(message);
    });
}

void say(const std::string& line) {
    if (!is_quiet) write_line(line);
}

void say_error(const std::string& message) {
    clear_status();
    write_line("wedge: " + message);
}

bool stderr_is_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

void show_status(const std::string& line) {
    const std::lock_guard lock(guard);
    status = line;
    draw_status();
}

void clear_status() {
    const std::lock_guard lock(guard);
    if (status.empty()) return;
    status.clear();
    draw_status();
}

}  // namespace wedge::cli
