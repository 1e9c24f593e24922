// A module for image files as another version of the program would bring it.
#include "host/image/codec.hpp"

extern "C" const wedge::image::Codec* wedge_codec() {
    static const wedge::image::Codec codec{wedge::image::kCodecInterface + 1, nullptr, nullptr,
                                           nullptr};
    return &codec;
}
