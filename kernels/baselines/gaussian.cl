// A Gaussian of fixed width: what any filter must be better than.
#include "baselines/layers.clh"

#define SIGMA_PX 2.0f
#define RADIUS_PX 6

__kernel void gaussian(const int width, const int height, __global const float4* light,
                       __global const float4* surface, __global const float4* place,
                       const int pass_number, __global float4* out) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    const int x = i % width, y = i / width;
    const int dx = pass_number == 0, dy = 1 - dx;  // rows, then columns
    float4 sum = 0;
    float weights = 0;
    for (int k = -RADIUS_PX; k <= RADIUS_PX; ++k) {
        if (!is_inside(x + k * dx, y + k * dy, width, height)) continue;
        const float w = exp(-0.5f * k * k / (SIGMA_PX * SIGMA_PX));
        sum += w * light[i + k * dx + k * dy * width];
        weights += w;
    }
    out[i] = sum / weights;
}
