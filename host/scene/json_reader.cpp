#include "host/scene/json_reader.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/base/edit_distance.hpp"
#include "wedge/error.hpp"
#include "wedge/shared/radiance.h"

namespace wedge::scene {
namespace {

/// Of a value in a message: short, whatever it is.
std::string shown(const nlohmann::json& value) {
    constexpr std::size_t kLongest = 40;
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
    return text;
}

/// RFC 6901: `~` and `/` inside a key are written `~0` and `~1`.
std::string escaped(const std::string& key) {
    std::string result;
    for (char c : key) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return result;
}

std::string wording(const NumberRange& range) {
    if (range.lower == 0 && std::isinf(range.upper))
        return range.open ? "must be positive" : "must not be negative";
    const char* between = range.open ? "between {} and {}, both excluded" : "between {} and {}";
    return "must be " + fmt::format(fmt::runtime(between), range.lower, range.upper);
}

bool contains(const NumberRange& range, double x) {
    return range.open ? x > range.lower && x < range.upper : x >= range.lower && x <= range.upper;
}

}  // namespace

void JsonView::fail(const std::string& message) const {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: {}: {}", *file_, pointer_.empty() ? "/" : pointer_, message));
}

bool JsonView::is_null() const {
    return value_->is_null();
}
bool JsonView::is_object() const {
    return value_->is_object();
}
bool JsonView::is_array() const {
    return value_->is_array();
}
bool JsonView::is_number() const {
    return value_->is_number();
}
bool JsonView::is_string() const {
    return value_->is_string();
}

std::optional<JsonView> JsonView::find(const std::string& key) const {
    if (!value_->is_object()) fail("must be an object, got " + shown(*value_));
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return JsonView(*member, pointer_ + "/" + escaped(key), *file_);
}

JsonView JsonView::require(const std::string& key) const {
    const auto member = find(key);
    if (!member) fail(fmt::format("\"{}\" is missing", key));
    return *member;
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
    if (!value_->is_object()) fail("must be an object, got " + shown(*value_));
    std::vector<std::pair<std::string, JsonView>> result;
    for (const auto& [key, value] : value_->items())
        result.emplace_back(key, JsonView(value, pointer_ + "/" + escaped(key), *file_));
    return result;
}

std::vector<JsonView> JsonView::elements() const {
    if (!value_->is_array()) fail("must be an array, got " + shown(*value_));
    std::vector<JsonView> result;
    result.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i)
        result.emplace_back((*value_)[i], fmt::format("{}/{}", pointer_, i), *file_);
    return result;
}

void JsonView::allow_only(std::initializer_list<const char*> keys) const {
    const std::vector<std::string> known(keys.begin(), keys.end());
    for (const auto& [key, value] : members())
        if (std::find(known.begin(), known.end(), key) == known.end())
            value.fail("unknown key" + suggestion(key, known));
}

float JsonView::number(const NumberRange& range) const {
    if (!value_->is_number()) fail("must be a number, got " + shown(*value_));
    const double x = value_->get<double>();
    if (!contains(range, x)) fail(fmt::format("{}, got {}", wording(range), shown(*value_)));
    const float rounded = float(x);
    if (!std::isfinite(rounded)) fail("is too large for single precision: " + shown(*value_));
    // A positive number must stay positive when it is rounded.
    if (!contains(range, rounded)) fail("is too small for single precision: " + shown(*value_));
    return rounded;
}

int JsonView::integer(int lower, int upper) const {
    const bool whole =
        value_->is_number() && std::floor(value_->get<double>()) == value_->get<double>();
    if (!whole) fail("must be a whole number, got " + shown(*value_));
    const double x = value_->get<double>();
    if (x < lower || x > upper)
        fail(fmt::format("must be between {} and {}, got {}", lower, upper, shown(*value_)));
    return int(x);
}

bool JsonView::boolean() const {
    if (!value_->is_boolean()) fail("must be true or false, got " + shown(*value_));
    return value_->get<bool>();
}

std::string JsonView::string() const {
    if (!value_->is_string()) fail("must be a string, got " + shown(*value_));
    return value_->get<std::string>();
}

Vec2 JsonView::vec2() const {
    if (!value_->is_array() || value_->size() != 2)
        fail("must be an array of 2 numbers, got " + shown(*value_));
    const auto parts = elements();
    return {parts[0].number(), parts[1].number()};
}

Vec3 JsonView::vec3() const {
    if (!value_->is_array() || value_->size() != 3)
        fail("must be an array of 3 numbers, got " + shown(*value_));
    const auto parts = elements();
    return {parts[0].number(), parts[1].number(), parts[2].number()};
}

Vec3 JsonView::color(const NumberRange& range) const {
    if (value_->is_number()) return Vec3(number(range));
    if (!value_->is_array() || value_->size() != 3)
        fail("must be a number or an array of 3 numbers, got " + shown(*value_));
    const auto parts = elements();
    return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

Vec3 JsonView::radiance() const {
    const Vec3 value = color();
    if (std::max({value.x, value.y, value.z}) > WEDGE_LARGEST_RADIANCE)
        fail(fmt::format("is more than a film can sum, {:g}", WEDGE_LARGEST_RADIANCE));
    return value;
}

JsonDocument::~JsonDocument() = default;
JsonView JsonDocument::root() const {
    return JsonView(*value_, "", file_);
}

}  // namespace wedge::scene
