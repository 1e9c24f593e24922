#include "host/base/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "wedge/error.hpp"

namespace wedge {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* attempt, int error) {
    throw Error(ErrorKind::output,
                fmt::format("{}: cannot {}: {}", path.string(), attempt, std::strerror(error)));
}

/// Owns a file descriptor for the length of a block.
struct Descriptor {
    int fd;
    explicit Descriptor(int opened) : fd(opened) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

fs::path follow_links(const fs::path& target) {
    std::error_code ignored;
    if (!fs::is_symlink(target, ignored)) return target;
    const fs::path followed = fs::weakly_canonical(target, ignored);
    return ignored ? target : followed;
}

/// Unique among processes and within this one.
fs::path temporary_beside(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    return target.parent_path() / fmt::format(".{}.{}-{}{}", target.stem().string(), ::getpid(),
                                              counter++, target.extension().string());
}

void write_all(const fs::path& path, const fs::path& named, int flags, std::string_view bytes) {
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666));
    if (file.fd < 0) fail(named, "write", errno);
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(named, "write", errno);
        bytes.remove_prefix(std::size_t(written));
    }
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(follow_links(target)) {
    temporary_ = temporary_beside(target_);
    std::error_code ignored;
    if (fs::is_directory(target_, ignored)) fail(target_, "write", EISDIR);
    // Creating it now finds an unwritable folder before anybody renders for an hour.
    const Descriptor probe(
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (probe.fd < 0) fail(target_, "write", errno);
}

AtomicFile::~AtomicFile() {
    if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    {
        // Without this, a crash soon after the rename can leave an empty file under the final name.
        const Descriptor file(::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC));
        if (file.fd < 0) fail(target_, "write", errno);
        if (::fsync(file.fd) != 0 && errno != EINVAL) fail(target_, "write", errno);
    }
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, "write", errno);
    committed_ = true;
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed)
        throw Error(ErrorKind::output,
                    fmt::format("{}: cannot be created: {}", folder.string(), failed.message()));
}

void write_file_atomically(const fs::path& target, std::string_view bytes) {
    std::error_code ignored;
    if (fs::exists(target, ignored) && fs::is_other(target, ignored)) {
        write_all(target, target, 0, bytes);
        return;
    }
    AtomicFile file(target);
    write_all(file.temporary_path(), target, O_TRUNC, bytes);
    file.commit();
}

}  // namespace wedge
