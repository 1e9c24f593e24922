// What the person in front of the program sees on stderr: log lines, and one status line that is
// rewritten in place on a terminal. Safe to call from several threads.
#pragma once

#include <string>

namespace wedge::cli {

/// Sends the library's log here. With `quiet` only warnings are shown.
void install_messages(bool quiet = false);

/// A line for people; dropped if quiet.
void say(const std::string& line);

/// The error that ends the program, as `wedge: …`.
void say_error(const std::string& message);

bool stderr_is_terminal();

/// Replaces the status line; cut to the width of the terminal. Messages appear above it.
void show_status(const std::string& line);

/// Removes the status line, if there is one.
void clear_status();

}  // namespace wedge::cli
