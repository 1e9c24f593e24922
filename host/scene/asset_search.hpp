// Where files named inside scenes, OBJ and MTL files are found.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace wedge::scene {

/// Looks for `name` in each of `folders`, in order: as written, then ignoring case; and, where
/// `name` has folders of its own that lead nowhere, for its last part alone. Backslashes separate
/// too, and a drive letter is ignored. Only regular files are found.
std::optional<std::filesystem::path> find_file(const std::string& name,
                                               const std::vector<std::filesystem::path>& folders);

/// The folder of `file`, then `others`: the order in which everything is searched.
std::vector<std::filesystem::path> search_order(const std::filesystem::path& file,
                                                const std::vector<std::filesystem::path>& others);

/// The whole file. Throws Error(bad_input) where it is missing, no regular file, unreadable, or
/// larger than `largest_bytes`.
std::string read_text(const std::filesystem::path& file, std::uintmax_t largest_bytes);

}  // namespace wedge::scene
