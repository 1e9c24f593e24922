// A libFuzzer binary; WEDGE_FUZZ_TARGET is one of the functions of targets.hpp.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "tests/fuzz/targets.hpp"

namespace {

constexpr double kHang_s = 10;  // of processor time, which other programs do not lengthen

double processor_s() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const double start = processor_s();
    wedge::fuzz::WEDGE_FUZZ_TARGET(data, size);
    const double used = processor_s() - start;
    if (used > kHang_s) {
        std::fprintf(stderr, "the input took %.1f s of processor time\n", used);
        std::abort();
    }
    return 0;
}
