// Typed, checked access to a JSON document; every complaint names the file and the JSON pointer.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wedge/math.hpp"

namespace wedge::scene {

/// What a number may be. The limits belong to the range.
struct NumberRange {
    double lower = -INFINITY;
    double upper = INFINITY;
    bool open = false;  ///< the limits do not belong to it
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kPositive{0, INFINITY, true};
inline constexpr NumberRange kNotNegative{0, INFINITY};
inline constexpr NumberRange kUnit{0, 1};

/// One value inside a document, which must outlive it. Every accessor throws Error(bad_input) with
/// `file: /pointer: what`.
class JsonView {
  public:
    JsonView(const nlohmann::json& value, std::string pointer, const std::string& file)
        : value_(&value), pointer_(std::move(pointer)), file_(&file) {}

    bool is_null() const;
    bool is_object() const;
    bool is_array() const;
    bool is_number() const;
    bool is_string() const;

    /// The member `key` of an object, nothing where it is absent.
    std::optional<JsonView> find(const std::string& key) const;
    /// The member `key`, which must be there.
    JsonView require(const std::string& key) const;
    /// Members of an object, in order of their names.
    std::vector<std::pair<std::string, JsonView>> members() const;
    /// Elements of an array.
    std::vector<JsonView> elements() const;
    /// Refuses members other than these, and suggests the nearest.
    void allow_only(std::initializer_list<const char*> keys) const;

    /// Finite in single precision and inside the range.
    float number(const NumberRange& range = kAnyNumber) const;
    /// Whole, and inside the range.
    int integer(int lower, int upper) const;
    bool boolean() const;
    std::string string() const;
    /// Array of exactly two or three numbers.
    Vec2 vec2() const;
    Vec3 vec3() const;
    /// Three numbers, or one that stands for all three.
    Vec3 color(const NumberRange& range = kNotNegative) const;
    /// A colour that is no more than a film can sum.
    Vec3 radiance() const;

    /// Throws Error(bad_input) with the place of this value.
    [[noreturn]] void fail(const std::string& message) const;

    const std::string& file() const { return *file_; }
    const std::string& pointer() const { return pointer_; }

  private:
    const nlohmann::json* value_;
    std::string pointer_;
    const std::string* file_;
};

/// A parsed file. `//` and `/* */` comments are allowed; keys given twice and nesting deeper than
/// 64 are refused.
class JsonDocument {
  public:
    /// Throws Error(bad_input) with `file:line:column: what` if the text is no JSON.
    JsonDocument(const std::string& text, std::string file);
    ~JsonDocument();
    JsonDocument(JsonDocument&&) = delete;

    JsonView root() const;

  private:
    std::string file_;
    std::unique_ptr<nlohmann::json> value_;
};

}  // namespace wedge::scene
