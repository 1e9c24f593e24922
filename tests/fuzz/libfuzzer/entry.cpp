// A libFuzzer binary; WEDGE_FUZZ_TARGET is one of the functions of targets.hpp.
#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    wedge::fuzz::WEDGE_FUZZ_TARGET(data, size);
    return 0;
}
