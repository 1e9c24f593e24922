// What is set for PoCL, in processes with another environment.
#include <doctest/doctest.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

#include <cstdlib>
#include <string>

#include "host/device/device.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;

TEST_CASE("child_prints_what_is_set_for_pocl" * doctest::skip()) {
    list_devices();
    const char* affinity = std::getenv("POCL_AFFINITY");
    MESSAGE("method=" << std::string(std::getenv("POCL_WORK_GROUP_METHOD")));
    MESSAGE("affinity=" << std::string(affinity ? affinity : "none"));
}

TEST_CASE("child_computes_on_one_processor" * doctest::skip()) {
#ifdef __linux__
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(::sched_getcpu(), &one);
    REQUIRE(::sched_setaffinity(0, sizeof(one), &one) == 0);
    Device device;
    if (::sysconf(_SC_NPROCESSORS_CONF) > 1) CHECK(std::getenv("POCL_AFFINITY") == nullptr);
#endif
}

TEST_CASE("work_group_method_is_set_unless_the_user_did") {
    const char* const name = "POCL_WORK_GROUP_METHOD";
    const ChildResult ours = run_child("child_prints_what_is_set_for_pocl", {{name, std::nullopt}});
    CHECK_MESSAGE(contains(ours.output, "method=loops"), ours.output);
    const ChildResult users = run_child("child_prints_what_is_set_for_pocl", {{name, "auto"}});
    CHECK_MESSAGE(contains(users.output, "method=auto"), users.output);
}

TEST_CASE("threads_are_tied_to_processors_unless_the_user_says_how_many_or_where") {
    const char *const name = "POCL_AFFINITY", *const threads = "POCL_MAX_PTHREAD_COUNT";
    const ChildResult users = run_child("child_prints_what_is_set_for_pocl", {{name, "0"}});
    CHECK_MESSAGE(contains(users.output, "affinity=0"), users.output);
    const ChildResult few =
        run_child("child_prints_what_is_set_for_pocl", {{name, std::nullopt}, {threads, "1"}});
    CHECK_MESSAGE(contains(few.output, "affinity=none"), few.output);
#ifdef __linux__
    const ChildResult one = run_child("child_computes_on_one_processor",
                                      {{name, std::nullopt}, {threads, std::nullopt}});
    CHECK_MESSAGE(one.exit_code == 0, one.output);
    CHECK(contains(one.output, "1 passed"));
    cpu_set_t allowed;
    REQUIRE(::sched_getaffinity(0, sizeof(allowed), &allowed) == 0);
    if (CPU_COUNT(&allowed) < ::sysconf(_SC_NPROCESSORS_CONF)) return;
    const ChildResult ours = run_child("child_prints_what_is_set_for_pocl",
                                       {{name, std::nullopt}, {threads, std::nullopt}});
    CHECK_MESSAGE(contains(ours.output, "affinity=1"), ours.output);
#endif
}
