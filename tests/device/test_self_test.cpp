#include <doctest/doctest.h>

#include <cstring>
#include <regex>
#include <set>
#include <string>

#include "host/device/embedded_sources.hpp"
#include "host/device/self_test.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;

namespace {

/// All embedded sources as a tree on disk, with `from` replaced by `to` everywhere.
void write_source_tree(const std::filesystem::path& root, const std::string& from,
                       const std::string& to) {
    bool replaced = false;
    for (std::size_t i = 0; i < kEmbeddedSourceCount; ++i) {
        std::string text(kEmbeddedSources[i].text, kEmbeddedSources[i].size);
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
            text.replace(at, from.size(), to);
            replaced = true;
        }
        write_text(root / kEmbeddedSources[i].path, text);
    }
    REQUIRE(replaced);
}

}  // namespace

TEST_CASE("self_test_passes_and_its_success_is_remembered") {
    const TemporaryFolder cache;
    const ScopedVariable folder("WEDGE_CACHE_DIR", cache.path().string());
    const ScopedVariable on("WEDGE_CACHE", "1");
    Device device;
    CHECK(self_test(device, "") == true);
    CHECK(self_test(device, "") == false);
    const ScopedVariable off("WEDGE_CACHE", "0");
    CHECK(self_test(device, "") == true);
}

TEST_CASE("self_test_notices_wrong_arithmetic_comparison_index_and_layout") {
    struct Fault {
        const char *from, *to, *named;
    };
    const Fault faults[] = {
        {"277803737u", "277803739u", "integer arithmetic"},
        {"floor(x)", "ceil(x)", "float arithmetic"},
        {"entry <= exit", "entry < exit", "float8 comparison"},
        {"+ get_local_id(0)", "- get_local_id(0)", "work-item indices"},
        {"float bounds[6][8];", "float bounds[6][8]; float stray;", "layout of BvhNode"},
    };
    const TemporaryFolder cache;
    const ScopedVariable folder("WEDGE_CACHE_DIR", cache.path().string());
    Device device;
    for (const Fault& fault : faults) {
        if (std::strstr(fault.named, "indices") && device.is_pocl())
            continue;  // groups of one item
        const TemporaryFolder tree;
        write_source_tree(tree.path(), fault.from, fault.to);
        for (int attempt = 0; attempt < 2; ++attempt) {  // a failure is not remembered as success
            const std::string message = error_of([&] { self_test(device, tree.path().string()); });
            CHECK_MESSAGE(contains(message, fault.named), message);
            CHECK(contains(message, device.info().name));
        }
    }
}

TEST_CASE("every_shared_structure_is_in_the_layout_test") {
    std::set<std::string> declared, listed;
    const auto collect = [](const EmbeddedSource& source, const char* pattern,
                            std::set<std::string>& to) {
        const std::string text(source.text, source.size);
        const std::regex regex(pattern);
        for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
            to.insert((*it)[1]);
        }
    };
    for (std::size_t i = 0; i < kEmbeddedSourceCount; ++i) {
        const std::string path = kEmbeddedSources[i].path;
        if (path.starts_with("include/wedge/shared/")) {
            collect(kEmbeddedSources[i], "typedef struct (\\w+)", declared);
        } else if (path == "kernels/self_test_layout.clh") {
            collect(kEmbeddedSources[i], "WEDGE_LAYOUT\\((\\w+), \\w+\\)\n", listed);
        }
    }
    CHECK(declared.size() >= 10);
    for (const std::string& name : declared) CHECK_MESSAGE(listed.contains(name), name);
    for (const std::string& name : listed) CHECK_MESSAGE(declared.contains(name), name);
}
