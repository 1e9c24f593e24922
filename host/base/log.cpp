#include "wedge/log.hpp"

#include <cstdio>
#include <utility>

namespace wedge {
namespace {

void write_to_stderr(LogLevel level, const std::string& message) {
    const char* prefix = level == LogLevel::warning ? "warning: " : "";
    std::fprintf(stderr, "%s%s\n", prefix, message.c_str());
}

LogSink& sink() {
    static LogSink instance = write_to_stderr;
    return instance;
}

}  // namespace

void set_log_sink(LogSink new_sink) {
    sink() = new_sink ? std::move(new_sink) : write_to_stderr;
}
void log_info(const std::string& message) {
    sink()(LogLevel::info, message);
}
void log_warning(const std::string& message) {
    sink()(LogLevel::warning, message);
}

}  // namespace wedge
