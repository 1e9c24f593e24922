#include "host/device/binary_cache.hpp"

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "host/base/atomic_file.hpp"
#include "host/base/sha256.hpp"

namespace wedge::device {
namespace {

namespace fs = std::filesystem;

/// The first line of every entry. Change the number when what an entry holds changes.
constexpr std::string_view kMagic = "wedge cache entry 1\n";

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

fs::path entry_path(const std::string& name) {
    const std::string folder = cache_folder();
    return folder.empty() ? fs::path() : fs::path(folder) / name;
}

/// An entry is: magic, hexadecimal SHA-256 of the rest, newline, name, newline, payload. With the
/// name inside, an entry that was copied to another name is not taken for what it is not.
std::string checked_part(const std::string& name, std::string_view payload) {
    return name + "\n" + std::string(payload);
}

}  // namespace

std::string cache_folder() {
    if (variable("WEDGE_CACHE") == "0") return "";
    if (const std::string own = variable("WEDGE_CACHE_DIR"); !own.empty()) return own;
    if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) return xdg + "/wedge";
    if (const std::string home = variable("HOME"); !home.empty()) return home + "/.cache/wedge";
    return "";
}

bool caches_programs(const Device& device) {
    if (cache_folder().empty()) return false;
    return !device.is_pocl() || variable("WEDGE_CACHE") == "force";
}

std::string cache_key(const Device& device, std::string_view source, std::string_view options) {
    const DeviceInfo& info = device.info();
    Sha256 hash;
    for (const std::string_view field :
         {kMagic, std::string_view(info.name), std::string_view(info.version),
          std::string_view(info.driver), std::string_view(info.platform),
          std::string_view(info.platform_version), options, source}) {
        // With its length before it, no field can pass for a part of its neighbour.
        hash.update(std::to_string(field.size()) + ":");
        hash.update(field);
    }
    return to_hex(hash.digest());
}

std::optional<std::string> load_cached(const std::string& name) {
    const fs::path path = entry_path(name);
    if (path.empty()) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    std::ostringstream text;
    text << file.rdbuf();
    const std::string entry = std::move(text).str();

    std::string_view rest = entry;
    if (!rest.starts_with(kMagic)) return std::nullopt;
    rest.remove_prefix(kMagic.size());
    const std::size_t checksum_end = rest.find('\n');
    if (checksum_end == std::string_view::npos) return std::nullopt;
    const std::string_view checksum = rest.substr(0, checksum_end);
    rest.remove_prefix(checksum_end + 1);
    if (to_hex(sha256(rest)) != checksum) return std::nullopt;
    if (!rest.starts_with(name + "\n")) return std::nullopt;
    return std::string(rest.substr(name.size() + 1));
}

void store_cached(const std::string& name, std::string_view payload) {
    try {
        const fs::path path = entry_path(name);
        if (path.empty()) return;
        fs::create_directories(path.parent_path());
        const std::string checked = checked_part(name, payload);
        write_file_atomically(path, std::string(kMagic) + to_hex(sha256(checked)) + "\n" + checked);
    } catch (const std::exception&) {
        // A read-only or full home costs the next run a compilation, and this run nothing.
    }
}

}  // namespace wedge::device
