#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "host/base/atomic_file.hpp"
#include "wedge/error.hpp"

using namespace wedge;
namespace fs = std::filesystem;

namespace {

/// A fresh folder with everything in it removed at the end.
struct Folder {
    fs::path path;
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "wedge-test-XXXXXX").string();
        path = ::mkdtemp(pattern.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    std::ptrdiff_t entries() const {
        return std::distance(fs::directory_iterator(path), fs::directory_iterator());
    }
};

std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("committed_file_has_its_bytes_and_leaves_nothing_beside_it") {
    const Folder folder;
    const fs::path target = folder.path / "image.exr";
    const std::string bytes("binary\0bytes\n", 13);
    write_file_atomically(target, "old and longer than what follows");
    write_file_atomically(target, bytes);
    CHECK(content(target) == bytes);
    CHECK(folder.entries() == 1);
}

TEST_CASE("file_not_committed_leaves_the_old_one_untouched") {
    const Folder folder;
    const fs::path target = folder.path / "image.png";
    write_file_atomically(target, "old");
    {
        AtomicFile file(target);
        CHECK(file.temporary_path().extension() == ".png");
        CHECK(file.temporary_path().parent_path() == folder.path);
        std::ofstream(file.temporary_path()) << "half";
        CHECK(content(target) == "old");
    }
    CHECK(content(target) == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("unwritable_target_is_an_output_error_that_names_it") {
    const Folder folder;
    for (const fs::path& target : {folder.path / "missing" / "a.exr", folder.path}) {
        try {
            write_file_atomically(target, "x");
            FAIL("no error for " << target.string());
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::output);
            CHECK(std::string(error.what()).find(target.string()) != std::string::npos);
        }
    }
    CHECK(folder.entries() == 0);
}

TEST_CASE("full_disk_is_an_output_error") {
    if (!fs::exists("/dev/full")) {
        MESSAGE("skipped: full_disk_is_an_output_error (no /dev/full here)");
        return;
    }
    CHECK_THROWS_AS(write_file_atomically("/dev/full", "x"), Error);
    CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("link_is_followed_not_replaced") {
    const Folder folder;
    write_file_atomically(folder.path / "real", "old");
    fs::create_symlink(folder.path / "real", folder.path / "link");
    write_file_atomically(folder.path / "link", "new");
    CHECK(fs::is_symlink(folder.path / "link"));
    CHECK(content(folder.path / "real") == "new");
}

TEST_CASE("permissions_follow_the_umask") {
    const Folder folder;
    const mode_t before = ::umask(0027);
    write_file_atomically(folder.path / "a", "x");
    ::umask(before);
    CHECK(fs::status(folder.path / "a").permissions() == fs::perms(0640));
}
