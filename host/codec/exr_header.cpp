// The layout is that of "OpenEXR File Layout" (openexr.com): magic number, version and flags, then
// for each part attributes of name, type, size in bytes and value, ended by an empty name.
#include "host/codec/exr_header.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>

namespace wedge::codec {
namespace {

constexpr std::uint32_t kMagic = 20000630;  // 76 2f 31 01 in the file
constexpr std::uint32_t kMultiPart = 0x1000;
constexpr std::size_t kLongestName = 255;
constexpr int kMostAttributes = 65536;

/// Reads forward and never past the end.
class Reader {
  public:
    explicit Reader(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
        stream_.seekg(0, std::ios::end);
        left_ = std::uint64_t(std::max<std::streamoff>(stream_.tellg(), 0));
        stream_.seekg(0);
    }

    std::uint64_t left() const { return left_; }
    bool good() const { return good_; }

    std::uint32_t number() {
        unsigned char b[4] = {};
        take(reinterpret_cast<char*>(b), 4);
        return std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 |
               std::uint32_t(b[3]) << 24;
    }

    /// Characters up to a zero; no more than a name may have.
    std::string name() {
        std::string text;
        for (char c = 0; good_ && text.size() <= kLongestName; text += c) {
            take(&c, 1);
            if (c == 0) return text;
        }
        good_ = false;
        return text;
    }

    void skip(std::uint64_t bytes) {
        stream_.seekg(std::streamoff(bytes), std::ios::cur);
        left_ -= bytes;
    }

  private:
    void take(char* to, std::uint64_t bytes) {
        good_ = good_ && bytes <= left_ && stream_.read(to, std::streamsize(bytes));
        if (good_) left_ -= bytes;
    }

    std::ifstream stream_;
    std::uint64_t left_ = 0;
    bool good_ = true;
};

/// Bytes of values of the types whose size is fixed; the library reads that many whatever the file
/// says. Nothing for other types.
std::optional<std::uint32_t> fixed_size(const std::string& type) {
    static const std::map<std::string, std::uint32_t> kSizes{{"box2f", 16},
                                                             {"box2i", 16},
                                                             {"chromaticities", 32},
                                                             {"compression", 1},
                                                             {"deepImageState", 1},
                                                             {"double", 8},
                                                             {"envmap", 1},
                                                             {"float", 4},
                                                             {"int", 4},
                                                             {"keycode", 28},
                                                             {"lineOrder", 1},
                                                             {"m33d", 72},
                                                             {"m33f", 36},
                                                             {"m44d", 128},
                                                             {"m44f", 64},
                                                             {"rational", 8},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"v2d", 16},
                                                             {"v2f", 8},
                                                             {"v2i", 8},
                                                             {"v3d", 24},
                                                             {"v3f", 12},
                                                             {"v3i", 12}};
    const auto found = kSizes.find(type);
    if (found == kSizes.end()) return std::nullopt;
    return found->second;
}

/// Goes past the value of an attribute as the library does, which minds the size for some types
/// only. False where what it would read is not what the file says is there.
bool skip_value(Reader& reader, const std::string& type, std::uint32_t bytes) {
    const std::uint64_t before = reader.left();
    if (const auto size = fixed_size(type); size && *size != bytes) return false;
    if (type == "chlist") {
        constexpr std::uint32_t kChannel = 16;  // type, linearity, sampling
        while (!reader.name().empty() && reader.good()) {
            if (reader.left() < kChannel) return false;
            reader.skip(kChannel);
        }
        return reader.good() && before - reader.left() == bytes;
    }
    if (type == "preview") {
        const std::uint64_t width = reader.number(), height = reader.number();
        if (!reader.good() || width > bytes || height > bytes || 8 + 4 * width * height != bytes)
            return false;
        reader.skip(bytes - 8);
        return true;
    }
    reader.skip(bytes);
    return true;
}

}  // namespace

std::string flaw_of_exr_header(const std::filesystem::path& file) {
    Reader reader(file);
    if (reader.number() != kMagic || !reader.good()) return "";
    const bool multi_part = reader.number() & kMultiPart;
    bool part_is_empty = true;
    for (int attributes = 0; attributes < kMostAttributes && reader.good(); ++attributes) {
        const std::string name = reader.name();
        if (reader.good() && name.empty()) {
            // One empty name ends a part; where there may be more, an empty part ends the header.
            if (!multi_part || part_is_empty) return "";
            part_is_empty = true;
            continue;
        }
        part_is_empty = false;
        const std::string type = reader.name();
        const std::uint32_t bytes = reader.number();
        if (!reader.good()) break;
        if (bytes > reader.left()) return "its attribute \"" + name + "\" is longer than the file";
        if (!skip_value(reader, type, bytes))
            return "its attribute \"" + name + "\" has not the size of its type";
    }
    return "its header is damaged";
}

}  // namespace wedge::codec
