// Messages to the person in front of the program. They go to stderr; results go to stdout or files.
#pragma once

#include <functional>
#include <string>

namespace wedge {

enum class LogLevel { info, warning };

using LogSink = std::function<void(LogLevel, const std::string&)>;

/// Replaces where messages go (default: stderr, one line each). Not to be called while others log.
void set_log_sink(LogSink sink);

void log_info(const std::string& message);
void log_warning(const std::string& message);

}  // namespace wedge
