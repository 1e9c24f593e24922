// Known answers: what every other kernel takes for granted about a device and its compiler. All results
// are exact, so that the host can ask for equality (host/device/self_test.cpp computes the same).
#include "lib/lanes.clh"
#include "wedge/shared/bvh.h"
#include "wedge/shared/frame.h"
#include "wedge/shared/replay.h"
#include "wedge/shared/scene.h"
#include "wedge/shared/filter.h"

// PCG RXS-M-XS 32 (O'Neill 2014, section 6.3), stretched over the other integer operations in use.
static uint integer_answer(uint i) {
    const uint state = i * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    const uint pcg = (word >> 22) ^ word;
    return rotate(pcg, i & 31u) + mul_hi(pcg, i * 2654435761u) + clz(pcg >> (i & 31u));
}

// `infinities` holds +inf and -inf: from memory, so that the compiler cannot know them.
static uint float_answer(uint i, global const float* infinities) {
    const float x = (float)i * 0.125f;
    float y = fma(x, x, -x) + floor(x);
    y = max(min(y, infinities[0]), infinities[1]);
    y = (y * 0x1p-60f) * 0x1p+60f;
    const float nan = infinities[0] + infinities[1];
    const uint nan_compares = (nan <= x) | (nan >= x) | (nan == nan);
    const uint nan_bits = (as_uint(nan) & 0x7fffffffu) > 0x7f800000u;
    return as_uint(y) + (nan_compares << 30) + (nan_bits << 31);
}

// The box test of the traversal: eight intervals at a time, an empty one (+inf, -inf) among them.
static uint mask_answer(uint i, global const float* infinities) {
    float8 entry = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f) + (float)(i & 7u);
    float8 exit = (float8)(7.0f);
    entry.s3 = infinities[0];
    exit.s3 = infinities[1];
    return lane_bits8(entry <= exit);
}

// answers: four words an item (integer, float, mask, index).
kernel void self_test_answers(global uint* answers, global const float* infinities, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    answers[4 * i + 0] = integer_answer(i);
    answers[4 * i + 1] = float_answer(i, infinities);
    answers[4 * i + 2] = mask_answer(i, infinities);
    answers[4 * i + 3] = (uint)(get_group_id(0) * get_local_size(0) + get_local_id(0));
}

// layout: two words a structure (its size, the offset of one field), in bytes.
kernel void self_test_layout(global uint* layout, global const char* base) {
    if (get_global_id(0) != 0) return;
    uint k = 0;
#define WEDGE_LAYOUT(type, field)                                                            \
    layout[k++] = (uint)sizeof(type);                                                        \
    layout[k++] = (uint)((global const char*)&((global const type*)base)->field - base);
#include "self_test_layout.clh"
}
