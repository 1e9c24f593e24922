#include "host/scene/asset_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "wedge/error.hpp"

namespace fs = std::filesystem;

namespace wedge::scene {
namespace {

bool equal_ignoring_case(const std::string& a, const std::string& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
        return std::tolower(x) == std::tolower(y);
    });
}

/// `folder / part` with the case that is on disk, or nothing.
std::optional<fs::path> step(const fs::path& folder, const fs::path& part) {
    std::error_code error;
    if (fs::exists(folder / part, error)) return folder / part;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (equal_ignoring_case(it->path().filename().string(), part.string())) return it->path();
    return std::nullopt;
}

std::optional<fs::path> find_in(const fs::path& folder, const fs::path& name) {
    std::error_code error;
    fs::path here = name.is_absolute() ? name.root_path() : folder.empty() ? fs::path(".") : folder;
    if (fs::is_regular_file(here / name, error)) return folder.empty() ? name : folder / name;
    for (const fs::path& part : name.relative_path()) {
        const auto next = step(here, part);
        if (!next) return std::nullopt;
        here = *next;
    }
    if (!fs::is_regular_file(here, error)) return std::nullopt;
    return here;
}

/// With forward slashes and without a drive letter.
fs::path portable(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const bool drive =
        name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0]));
    return fs::path(drive ? name.substr(2) : name);
}

}  // namespace

std::optional<fs::path> find_file(const std::string& name, const std::vector<fs::path>& folders) {
    if (name.empty() || name.find('\0') != std::string::npos) return std::nullopt;
    const fs::path wanted = portable(name);
    for (const fs::path& folder : folders)
        if (const auto found = find_in(folder, wanted)) return found;

    // Exporters write the folders of the machine they ran on.
    if (wanted.has_parent_path())
        for (const fs::path& folder : folders)
            if (const auto found = find_in(folder, wanted.filename())) return found;
    return std::nullopt;
}

std::vector<fs::path> search_order(const fs::path& file, const std::vector<fs::path>& others) {
    std::vector<fs::path> result{file.parent_path()};
    result.insert(result.end(), others.begin(), others.end());
    return result;
}

std::string read_text(const fs::path& file, std::uintmax_t largest_bytes) {
    const auto fail = [&](const std::string& what) {
        throw Error(ErrorKind::bad_input, file.string() + ": " + what);
    };
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) fail("no such file");
    if (fs::is_directory(status)) fail("is a folder, not a file");
    if (!fs::is_regular_file(status)) fail("is not a regular file");
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) fail("cannot be read: " + error.message());
    if (size > largest_bytes)
        fail(fmt::format("is too large: {} bytes, the limit is {}", size, largest_bytes));

    std::string text(size, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail("cannot be opened; check its permissions");
    stream.read(text.data(), std::streamsize(size));
    if (std::uintmax_t(stream.gcount()) != size) fail("could not be read to its end");
    // Editors on Windows mark UTF-8 by these; to a parser they would be part of the first word.
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    return text;
}

}  // namespace wedge::scene
