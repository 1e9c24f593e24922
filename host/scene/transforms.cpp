#include "host/scene/transforms.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace wedge::scene {
namespace {

/// Below this fraction of the box its columns could span, a transform is flat as far as single
/// precision can tell.
constexpr double kFlat = 1e-6;

bool is_matrix(const JsonView& view) {
    if (!view.is_array()) return false;
    const auto parts = view.elements();
    const bool numbers = !parts.empty() && parts[0].is_number();
    const bool rows = parts.size() == 4 && parts[0].is_array() && parts[0].elements().size() == 4 &&
                      parts[0].elements()[0].is_number();
    return numbers || rows;
}

Mat4 read_matrix(const JsonView& view) {
    std::vector<JsonView> numbers = view.elements();
    if (numbers.size() == 4) {
        numbers.clear();
        for (const JsonView& row : view.elements())
            for (const JsonView& number : row.elements()) numbers.push_back(number);
    }
    if (numbers.size() != 16) view.fail("must be a matrix: 16 numbers or 4 rows of 4");
    Mat4 result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            result[column][row] = numbers[std::size_t(4 * row + column)].number();
    const bool affine =
        result[0][3] == 0 && result[1][3] == 0 && result[2][3] == 0 && result[3][3] == 1;
    if (!affine) view.fail("the last row must be 0 0 0 1");
    return result;
}

Mat4 read_parts(const JsonView& view) {
    view.allow_only({"translate", "rotate_deg", "axis", "scale"});
    Mat4 result(1);
    if (const auto translate = view.find("translate"))
        result = glm::translate(result, translate->vec3());
    const auto angle = view.find("rotate_deg");
    const auto axis = view.find("axis");
    if (axis && !angle) axis->fail("has no meaning without \"rotate_deg\"");
    if (angle) {
        Vec3 direction(0, 1, 0);
        if (axis) direction = axis->vec3();
        const double length = glm::length(glm::dvec3(direction));
        if (!(length > 0)) axis->fail("must not be zero");
        result = glm::rotate(result, glm::radians(angle->number()),
                             Vec3(glm::dvec3(direction) / length));
    }
    if (const auto scale = view.find("scale")) {
        const Vec3 factors = scale->is_number() ? Vec3(scale->number()) : scale->vec3();
        result = glm::scale(result, factors);
    }
    return result;
}

Mat4 read_steps(const JsonView& view) {
    if (is_matrix(view)) return read_matrix(view);
    if (view.is_array()) {
        Mat4 result(1);
        for (const JsonView& step : view.elements()) result = read_steps(step) * result;
        return result;
    }
    if (const auto matrix = view.find("matrix")) {
        view.allow_only({"matrix"});
        return read_matrix(*matrix);
    }
    return read_parts(view);
}

}  // namespace

Mat4 read_transform(const JsonView& view) {
    const Mat4 result = read_steps(view);
    const glm::dmat3 linear{glm::mat3(result)};
    const double volume = std::abs(glm::determinant(linear));
    const double box = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(result[column][row])) view.fail("overflows single precision");
    if (!(volume > kFlat * box))
        view.fail("cannot be inverted: it flattens the mesh (is a scale factor 0?)");
    return result;
}

}  // namespace wedge::scene
