#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "host/scene/json_reader.hpp"
#include "wedge/error.hpp"

namespace wedge::scene {
namespace {

constexpr int kDeepestNesting = 64;

/// `line:column`, both from 1, of a byte of the text.
std::string line_and_column(const std::string& text, std::size_t byte) {
    byte = std::min(byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(byte), '\n');
    const std::size_t newline = byte ? text.rfind('\n', byte - 1) : std::string::npos;
    const std::size_t column = newline == std::string::npos ? byte + 1 : byte - newline;
    return fmt::format("{}:{}", line, column);
}

/// The part of the library's message that is about the text, without its own ids and places.
std::string reason(const std::string& message) {
    std::size_t start = message.find("parse error");
    if (start != std::string::npos) start = message.find(": ", start);
    if (start == std::string::npos) start = message.find("] ");
    return start == std::string::npos ? message : message.substr(start + 2);
}

[[noreturn]] void fail_at(const std::string& file, const std::string& text, std::size_t byte,
                          const std::string& message) {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}:{}: {}", file, line_and_column(text, byte), message));
}

/// Looks at keys and nesting while the parser goes: the library keeps the last of two equal keys
/// and builds any depth.
class Guard {
  public:
    explicit Guard(const std::string& file) : file_(file) {}

    bool operator()(int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        using Event = nlohmann::json::parse_event_t;
        if (depth > kDeepestNesting)
            throw Error(ErrorKind::bad_input,
                        fmt::format("{}: nested deeper than {} levels", file_, kDeepestNesting));
        if (event == Event::object_start) open_.emplace_back();
        if (event == Event::object_end) open_.pop_back();
        if (event == Event::key) take_key(parsed.get<std::string>());
        return true;
    }

  private:
    struct Object {
        std::set<std::string> keys;
        std::string last;  ///< of these
    };

    void take_key(const std::string& key) {
        Object& object = open_.back();
        object.last = key;
        if (object.keys.insert(key).second) return;
        std::string place = open_.size() > 1 ? "in " : "at the top";
        for (std::size_t i = 0; i + 1 < open_.size(); ++i) place += "/" + open_[i].last;
        throw Error(
            ErrorKind::bad_input,
            fmt::format("{}: the key \"{}\" is given twice in one object, {}", file_, key, place));
    }

    const std::string& file_;
    std::vector<Object> open_;  ///< from the outermost on
};

}  // namespace

JsonDocument::JsonDocument(const std::string& text, std::string file) : file_(std::move(file)) {
    // The library copies its callback; the state must be one.
    Guard guard(file_);
    const auto callback = [&guard](int depth, nlohmann::json::parse_event_t event,
                                   nlohmann::json& parsed) { return guard(depth, event, parsed); };
    try {
        value_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(text, callback,
                                                                        /*allow_exceptions=*/true,
                                                                        /*ignore_comments=*/true));
    } catch (const nlohmann::json::parse_error& error) {
        fail_at(file_, text, error.byte ? error.byte - 1 : 0, reason(error.what()));
    } catch (const nlohmann::json::out_of_range& error) {
        // A number beyond double precision; the message quotes it, and that is all there is.
        const std::string message = error.what();
        const std::size_t open = message.find('\''), close = message.rfind('\'');
        const std::string token =
            close > open ? message.substr(open + 1, close - open - 1) : std::string();
        fail_at(file_, text, token.empty() ? 0 : text.find(token),
                "the number " + token + " is too large");
    }
}

}  // namespace wedge::scene
