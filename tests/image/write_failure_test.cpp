// What is left on the disk when writing goes wrong: nothing, or what stood there before.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>

#include "host/base/atomic_file.hpp"
#include "tests/image/support.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using wedge::test::error_message;
using wedge::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

Image noise(int width, int height) {
    Image image{width, height, {"R", "G", "B"}, {}, {}};
    uint32_t state = 1;
    for (int i = 0; i < width * height * 3; ++i) {
        state = state * 1664525u + 1013904223u;
        image.pixels.push_back(float(state >> 8) / float(1 << 24));
    }
    return image;
}

/// For the length of a block: what any user may do, where the tests run as root, who may do
/// anything.
class AsAnyUser {
  public:
    AsAnyUser() {
        constexpr uid_t kNobody = 65534;
        if (was_ == 0) REQUIRE(::seteuid(kNobody) == 0);
    }
    ~AsAnyUser() {
        if (was_ == 0 && ::seteuid(0) != 0) std::abort();
    }

  private:
    uid_t was_ = ::geteuid();
};

/// For the length of a block: files end at `byte_count`, midway through a write, as on a full disk.
class FilesNoLargerThan {
  public:
    explicit FilesNoLargerThan(rlim_t byte_count) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &was_) == 0);
        const rlimit limit{byte_count, was_.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    }
    ~FilesNoLargerThan() {
        ::setrlimit(RLIMIT_FSIZE, &was_);
        ::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit was_{};
    void (*handler_)(int);
};

/// Every way to write, each with the name of the file it is given.
const std::function<void(const fs::path&)> kWriters[] = {
    [](const fs::path& file) { write_exr(file, noise(64, 64)); },
    [](const fs::path& file) { write_png(file, noise(64, 64)); },
};

bool says(const std::string& message, const fs::path& file, const std::string& reason) {
    return message.find(file.string()) != std::string::npos &&
           message.find(reason) != std::string::npos;
}

}  // namespace

TEST_CASE("missing_folder_is_named_before_and_at_writing") {
    const TemporaryFolder folder;
    const fs::path file = folder / "absent/image.exr";
    for (const auto& write : kWriters)
        CHECK(says(error_message(ErrorKind::output, [&] { write(file); }), file, "no folder"));
    CHECK(says(error_message(ErrorKind::output, [&] { check_writable(file); }), file, "no folder"));
    CHECK(folder.is_empty());
}

TEST_CASE("folder_of_somebody_else_is_an_output_error") {
    const TemporaryFolder folder;
    const fs::path file = folder / "image.exr";
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec |
                                       fs::perms::others_read | fs::perms::others_exec);
    const auto refused = [&](const std::function<void()>& action) {
        const AsAnyUser user;
        return says(error_message(ErrorKind::output, action), file, "Permission denied");
    };
    for (const auto& write : kWriters) CHECK(refused([&] { write(file); }));
    CHECK(refused([&] { check_writable(file); }));
    CHECK(folder.is_empty());
    fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST_CASE("target_that_is_a_folder_is_an_output_error") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "image.exr");
    for (const auto& write : kWriters)
        CHECK(error_message(ErrorKind::output, [&] { write(folder / "image.exr"); }) != "");
    CHECK(error_message(ErrorKind::output, [&] { check_writable(folder / "image.exr"); }) != "");
    CHECK(fs::is_empty(folder / "image.exr"));
}

TEST_CASE("full_disk_leaves_no_file_and_keeps_the_old_one") {
    const TemporaryFolder folder;
    const fs::path fresh = folder / "fresh.exr", old = folder / "old.exr";
    test::write_bytes(old, "what stood there before");
    for (const auto& write : kWriters)
        for (const fs::path& file : {fresh, old}) {
            std::string message;
            {
                const FilesNoLargerThan limit(4096);
                message = error_message(ErrorKind::output, [&] { write(file); });
            }
            CHECK(says(message, file, "File too large"));
        }
    CHECK_FALSE(fs::exists(fresh));
    CHECK(test::read_bytes(old) == "what stood there before");
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("full_device_says_that_no_space_is_left") {
    if (!fs::exists("/dev/full")) {
        MESSAGE("skipped full_device_says_that_no_space_is_left: there is no /dev/full");
        return;
    }
    for (const auto& write : kWriters)
        CHECK(says(error_message(ErrorKind::output, [&] { write("/dev/full"); }), "/dev/full",
                   "No space left"));
    CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("process_killed_before_the_rename_leaves_no_final_file") {
    const TemporaryFolder folder;
    const fs::path file = folder / "image.exr";
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const AtomicFile atomic(file);
        test::write_bytes(atomic.temporary_path(), "half of an image");
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    CHECK_FALSE(fs::exists(file));
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);  // the temporary one
}

TEST_CASE("checking_a_place_changes_nothing") {
    const TemporaryFolder folder;
    check_writable(folder / "image.exr");
    CHECK(folder.is_empty());
    test::write_bytes(folder / "image.exr", "old");
    check_writable(folder / "image.exr");
    CHECK(test::read_bytes(folder / "image.exr") == "old");
}

TEST_CASE("names_without_a_folder_are_written_to_the_current_one") {
    const TemporaryFolder folder;
    const fs::path was = fs::current_path();
    fs::current_path(folder.path());
    check_writable("image.png");
    write_png("image.png", noise(4, 4));
    fs::current_path(was);
    CHECK(fs::exists(folder / "image.png"));
}
