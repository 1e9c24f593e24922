#include "host/image/codec.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include "wedge/error.hpp"

namespace wedge::image {
namespace {

namespace fs = std::filesystem;

/// Folders in which the loader would look for the program's libraries, in its order; without what
/// /etc/ld.so.cache knows.
std::vector<fs::path> search_path() {
    void* program = ::dlopen(nullptr, RTLD_LAZY);
    if (!program) return {};
    const std::unique_ptr<void, int (*)(void*)> close(program, ::dlclose);
    Dl_serinfo size{};
    if (::dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
    const auto buffer = std::make_unique<std::max_align_t[]>(
        (size.dls_size + sizeof(std::max_align_t) - 1) / sizeof(std::max_align_t));
    auto* info = reinterpret_cast<Dl_serinfo*>(buffer.get());
    info->dls_size = size.dls_size;
    info->dls_cnt = size.dls_cnt;
    if (::dlinfo(program, RTLD_DI_SERINFO, info) != 0) return {};
    std::vector<fs::path> folders;
    for (unsigned i = 0; i < info->dls_cnt; ++i)
        folders.emplace_back(info->dls_serpath[i].dls_name);
    return folders;
}

[[noreturn]] void fail(const std::string& reason) {
    throw Error(
        ErrorKind::usage,
        fmt::format("no image file can be read or written: {}; it belongs beside the program or "
                    "into ../lib/wedge: install Wedge anew, or name its folder in LD_LIBRARY_PATH",
                    reason));
}

const Codec& load() {
    // Never closed: what it brings has threads and things to do at exit.
    void* module = ::dlopen(WEDGE_CODEC_FILE, RTLD_LAZY | RTLD_LOCAL);
    if (!module) fail(::dlerror());
    const auto entry = reinterpret_cast<const Codec* (*)()>(::dlsym(module, kCodecEntry));
    if (!entry) fail(::dlerror());
    const Codec* codec = entry();
    if (codec->interface_number != kCodecInterface)
        fail(fmt::format("{} is of another version of Wedge (interface {}, not {})",
                         WEDGE_CODEC_FILE, codec->interface_number, kCodecInterface));
    return *codec;
}

}  // namespace

void require_codec() {
    std::error_code ignored;
    for (const fs::path& folder : search_path())
        if (fs::exists(folder / WEDGE_CODEC_FILE, ignored)) return;
    codec();
}

const Codec& codec() {
    static const Codec& loaded = load();
    return loaded;
}

}  // namespace wedge::image
