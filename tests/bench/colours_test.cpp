// Methods can be told apart in charts.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "bench/converge/html.hpp"
#include "bench/converge/methods.hpp"

namespace wedge::converge {

TEST_CASE("every_method_has_a_colour_of_its_own") {
    std::set<std::string> values;
    const std::string style = kStyle;
    for (const Method& method : all_methods()) {
        const std::string name = series_class(series_of(method)).substr(1);
        const auto at = style.find("--c" + name + ": ");
        CAPTURE(method.name);
        REQUIRE(at != std::string::npos);
        values.insert(style.substr(style.find('#', at), 7));
        CHECK(style.find(".s" + name + " {") != std::string::npos);
    }
    CHECK(values.size() == all_methods().size());
}

}  // namespace wedge::converge
