#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "host/device/binary_cache.hpp"
#include "host/device/program.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;
namespace fs = std::filesystem;

namespace {

/// A cache folder and a kernel of one's own; the cache is on even on PoCL.
struct CachedKernel {
    TemporaryFolder folder, tree;
    ScopedVariable directory{"WEDGE_CACHE_DIR", (folder.path() / "cache").string()};
    ScopedVariable force{"WEDGE_CACHE", "force"};
    Device device;

    CachedKernel() { write_source(11); }

    void write_source(int value) {
        write_text(tree.path() / "kernels/test.cl",
                   "kernel void test(global int* o) { *o = " + std::to_string(value) + "; }\n");
    }

    struct Outcome {
        int value;
        bool from_cache;
    };

    Outcome build_and_run(std::vector<std::string> defines = {}) {
        const ProgramRequest request{"kernels/test.cl", std::move(defines)};
        const std::vector<Program> programs =
            build_programs(device, {&request, 1}, tree.path().string());
        cl::Kernel kernel = programs[0].kernel("test");
        const cl::Buffer out = device.allocate(4, "out");
        kernel.setArg(0, out);
        device.launch(kernel, 1);
        int value = 0;
        device.download(out, &value, 4);
        return {value, programs[0].from_cache};
    }

    std::vector<fs::path> entries() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder.path() / "cache")) {
            found.push_back(entry.path());
        }
        return found;
    }
};

}  // namespace

TEST_CASE("second_build_comes_from_the_cache_and_computes_the_same") {
    CachedKernel kernel;
    const auto first = kernel.build_and_run(), second = kernel.build_and_run();
    CHECK_FALSE(first.from_cache);
    CHECK(second.from_cache);
    CHECK(first.value == 11);
    CHECK(second.value == 11);
    CHECK(kernel.entries().size() == 1);
}

TEST_CASE("other_source_or_options_miss_the_cache") {
    CachedKernel kernel;
    kernel.build_and_run();
    CHECK_FALSE(kernel.build_and_run({"A=1"}).from_cache);
    kernel.write_source(12);
    const auto changed = kernel.build_and_run();
    CHECK_FALSE(changed.from_cache);
    CHECK(changed.value == 12);
    CHECK(kernel.entries().size() == 3);
}

TEST_CASE("damaged_entry_is_not_used_and_is_replaced") {
    CachedKernel kernel;
    kernel.build_and_run();
    const fs::path entry = kernel.entries().at(0);
    const std::string whole = read_text(entry);
    std::string flipped = whole;
    flipped[flipped.size() / 2] ^= 1;
    const std::string damages[] = {flipped,
                                   whole.substr(0, whole.size() / 2),
                                   whole.substr(0, whole.size() - 1),
                                   whole + "x",
                                   "",
                                   "junk\n",
                                   whole.substr(0, 20)};
    for (const std::string& damage : damages) {
        write_text(entry, damage);
        const auto outcome = kernel.build_and_run();
        CHECK_FALSE(outcome.from_cache);
        CHECK(outcome.value == 11);
        CHECK(kernel.build_and_run().from_cache);
    }
}

TEST_CASE("entry_under_another_name_is_not_taken") {
    CachedKernel kernel;
    kernel.build_and_run();
    const fs::path first = kernel.entries().at(0);
    kernel.write_source(12);
    kernel.build_and_run();
    for (const fs::path& entry : kernel.entries()) {
        if (entry != first) fs::copy_file(first, entry, fs::copy_options::overwrite_existing);
    }
    const auto outcome = kernel.build_and_run();
    CHECK_FALSE(outcome.from_cache);
    CHECK(outcome.value == 12);
}

TEST_CASE("whole_entry_that_the_driver_refuses_falls_back_to_the_source") {
    CachedKernel kernel;
    kernel.build_and_run();
    const std::string name = kernel.entries().at(0).filename().string();
    store_cached(name, "not a program of any driver");
    REQUIRE(load_cached(name) == "not a program of any driver");
    const auto outcome = kernel.build_and_run();
    CHECK_FALSE(outcome.from_cache);
    CHECK(outcome.value == 11);
    CHECK(kernel.build_and_run().from_cache);
}

TEST_CASE("cache_folder_that_cannot_be_written_costs_only_time") {
    CachedKernel kernel;
    // A file where the folder should be: unlike permissions, this stops root too.
    write_text(kernel.folder.path() / "file", "x");
    for (const char* place : {"file", "file/cache"}) {
        const ScopedVariable directory("WEDGE_CACHE_DIR", (kernel.folder.path() / place).string());
        for (int attempt = 0; attempt < 2; ++attempt) {
            const auto outcome = kernel.build_and_run();
            CHECK_FALSE(outcome.from_cache);
            CHECK(outcome.value == 11);
        }
    }
    CHECK(read_text(kernel.folder.path() / "file") == "x");
}

TEST_CASE("cache_is_off_when_told_so_and_on_pocl") {
    CachedKernel kernel;
    {
        const ScopedVariable off("WEDGE_CACHE", "0");
        CHECK_FALSE(caches_programs(kernel.device));
        CHECK(cache_folder() == "");
        kernel.build_and_run();
    }
    CHECK_FALSE(fs::exists(kernel.folder.path() / "cache"));
    CHECK(caches_programs(kernel.device));
    const ScopedVariable standard("WEDGE_CACHE", "");
    CHECK(caches_programs(kernel.device) == !kernel.device.is_pocl());
}

TEST_CASE("cache_folder_follows_the_environment") {
    const ScopedVariable on("WEDGE_CACHE", "");
    const ScopedVariable home("HOME", "/h"), xdg("XDG_CACHE_HOME", "/x"),
        own("WEDGE_CACHE_DIR", "/w");
    CHECK(cache_folder() == "/w");
    const ScopedVariable no_own("WEDGE_CACHE_DIR", "");
    CHECK(cache_folder() == "/x/wedge");
    const ScopedVariable no_xdg("XDG_CACHE_HOME", "");
    CHECK(cache_folder() == "/h/.cache/wedge");
    const ScopedVariable no_home("HOME", "");
    CHECK(cache_folder() == "");
}

TEST_CASE("child_builds_into_the_cache" * doctest::skip()) {
    Device device;
    const std::string tree = std::getenv("WEDGE_TEST_TREE");
    for (int round = 0; round < 20; ++round) {
        std::vector<ProgramRequest> requests;
        for (int i = 0; i < 3; ++i)
            requests.push_back({"kernels/test.cl", {"N=" + std::to_string(i)}});
        for (const Program& program : build_programs(device, requests, tree)) {
            cl::Kernel kernel = program.kernel("test");
            const cl::Buffer out = device.allocate(4, "out");
            kernel.setArg(0, out);
            device.launch(kernel, 1);
            int value = 0;
            device.download(out, &value, 4);
            CHECK(value == 11);
        }
    }
}

TEST_CASE("processes_at_once_share_the_cache") {
    CachedKernel kernel;
    const Environment environment = {{"WEDGE_TEST_TREE", kernel.tree.path().string()}};
    std::list<Child> children;
    for (int i = 0; i < 3; ++i) children.emplace_back("child_builds_into_the_cache", environment);
    for (Child& child : children) {
        const ChildResult result = child.wait();
        CHECK_MESSAGE(result.exit_code == 0, result.output);
        CHECK(contains(result.output, "1 passed"));
    }
    CHECK(kernel.entries().size() == 3);  // and no temporary file beside them
    CHECK(kernel.build_and_run({"N=0"}).from_cache);
}
