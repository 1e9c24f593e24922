// The one name that the program looks up in this module.
#include "host/codec/codec_functions.hpp"

extern "C" __attribute__((visibility("default"))) const wedge::image::Codec* wedge_codec() {
    using namespace wedge;
    static const image::Codec codec{image::kCodecInterface, codec::decode, codec::encode_exr,
                                    codec::encode_png};
    return &codec;
}
