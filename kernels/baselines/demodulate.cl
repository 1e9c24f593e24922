// Before and after the filter: texture and emission taken off, and put back.
#include "baselines/layers.clh"

// Where surfaces are darker, light is radiance over this: black must not divide by zero, and what is
// put back is the same product.
#define LEAST_ALBEDO 0.01f

inline float4 divisor_of(float4 albedo) {
    return fmax(albedo, (float4)(LEAST_ALBEDO));
}

__kernel void demodulate(const int pixel_count, __global const float4* radiance,
                         __global const float4* emission, __global const float4* albedo,
                         __global const float4* variance, __global float4* light) {
    const int i = get_global_id(0);
    if (i >= pixel_count) return;
    const float4 divisor = divisor_of(albedo[i]);
    float4 c = (radiance[i] - emission[i]) / divisor;
    // Channels rise and fall together, so that their deviations add.
    c.w = square(luminance_of(sqrt(variance[i]) / divisor));
    light[i] = c;
}

__kernel void modulate(const int pixel_count, __global const float4* light,
                       __global const float4* emission, __global const float4* albedo,
                       __global float4* radiance) {
    const int i = get_global_id(0);
    if (i >= pixel_count) return;
    radiance[i] = emission[i] + light[i] * divisor_of(albedo[i]);
}
