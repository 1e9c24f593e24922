#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "host/device/program.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;

TEST_CASE("each_include_is_resolved_once_with_true_line_numbers") {
    const TemporaryFolder tree;
    write_text(tree.path() / "kernels/main.cl",
               "// one\n#include \"wedge/shared/types.h\"\n#  include \"lib/b.clh\"\nfour\n");
    write_text(tree.path() / "kernels/lib/b.clh", "#include \"kernels/lib/c.clh\"\nb two\n");
    write_text(tree.path() / "kernels/lib/c.clh", "#include \"lib/b.clh\"\nc two");
    write_text(tree.path() / "include/wedge/shared/types.h", "#include <cstdint>\r\ntypes\r\n");
    CHECK(assemble_source("kernels/main.cl", tree.path().string()) ==
          "#line 1 \"kernels/main.cl\"\n"
          "// one\n"
          "#line 1 \"include/wedge/shared/types.h\"\n"
          "#include <cstdint>\n"
          "types\n"
          "#line 3 \"kernels/main.cl\"\n"
          "#line 1 \"kernels/lib/b.clh\"\n"
          "#line 1 \"kernels/lib/c.clh\"\n"
          "#line 2 \"kernels/lib/c.clh\"\n"
          "c two\n"
          "#line 2 \"kernels/lib/b.clh\"\n"
          "b two\n"
          "#line 4 \"kernels/main.cl\"\n"
          "four\n");
}

TEST_CASE("missing_include_is_an_error_that_names_both_files_and_the_line") {
    const TemporaryFolder tree;
    write_text(tree.path() / "kernels/main.cl", "\n\n#include \"lib/gone.clh\"\n");
    const std::string message =
        error_of([&] { assemble_source("kernels/main.cl", tree.path().string()); });
    CHECK_MESSAGE(contains(message, "kernels/main.cl:3"), message);
    CHECK_MESSAGE(contains(message, "kernels/lib/gone.clh"), message);
    CHECK_MESSAGE(contains(message, tree.path().string()), message);
}

TEST_CASE("missing_kernel_is_an_error_that_names_it") {
    CHECK(contains(error_of([] { assemble_source("kernels/gone.cl"); }), "kernels/gone.cl"));
}

TEST_CASE("source_in_the_program_and_in_the_tree_are_the_same") {
    const auto root = std::filesystem::path(__FILE__).parent_path() / "../..";
    REQUIRE(std::filesystem::exists(root / "kernels"));
    for (const char* file : {"kernels/self_test.cl"}) {
        CHECK(assemble_source(file) == assemble_source(file, root.string()));
    }
}
