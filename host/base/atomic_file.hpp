// Files that are either there whole or not there: written beside their place, then renamed into it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace wedge {

/// A name beside `target`, with its extension (image writers go by it), for somebody else to write
/// to. `commit` puts the file in its place; a file that was not committed is removed.
///
///     AtomicFile file("out/image.exr");
///     write_exr(file.temporary_path(), ...);
///     file.commit();
class AtomicFile {
  public:
    /// Throws Error(output) if the folder of `target` is not there or nothing can be created in it,
    /// or if `target` is a folder. A link is followed: what it points to is replaced.
    explicit AtomicFile(std::filesystem::path target);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    const std::filesystem::path& temporary_path() const { return temporary_; }

    /// Brings the data to the disk and renames. Throws Error(output).
    void commit();

  private:
    std::filesystem::path target_, temporary_;
    bool committed_ = false;
};

/// Makes a folder and those above it, if they are not there. Throws Error(output).
void make_folder(const std::filesystem::path& folder);

/// Writes `bytes` to `target` through an AtomicFile; to devices and pipes (/dev/stdout), directly.
/// Throws Error(output) with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& target, std::string_view bytes);

}  // namespace wedge
