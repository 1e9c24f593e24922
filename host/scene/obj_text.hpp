// What is learnt from the text of an OBJ file itself, because the parser does not tell.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wedge::scene {

/// A coordinate that is written as no number (nan, inf, a word), which the parser reads as 0.
struct BadCoordinate {
    std::size_t vertex;  ///< 0-based
    int axis;            ///< 0 to 2
};

/// Lines whose numbers are none.
struct BadLines {
    std::size_t count = 0, first_line = 0;  ///< lines from 1
};

struct ObjFacts {
    std::vector<std::string> mtllib_lines;  ///< what follows `mtllib`, trimmed
    std::vector<BadCoordinate> bad_coordinates;
    BadLines bad_normals, bad_uvs;  ///< vn and vt; read as 0
    bool may_overflow = false;  ///< an index has so many digits that the parser may wrap it around
};

/// One pass over the lines. Lines continued with a backslash are joined in place, line ends
/// unified, and what is not rendered but could harm (tags `t`, skin weights `vw`) made comments.
ObjFacts scan_obj(std::string& text);

/// Line, from 1, of a vertex, from 0; 0 if there is no such vertex.
std::size_t line_of_vertex(std::string_view text, std::size_t vertex);

/// `:line: face 12: vertex index 9 is out of range, …`: the first face that has an index which
/// names nothing, or more corners than the parser can count. Faces are counted from 1. Empty if all
/// are sound.
std::string describe_bad_face(std::string_view text);

inline constexpr std::size_t kMostCorners = 255;

}  // namespace wedge::scene
