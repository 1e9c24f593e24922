// The spatial part of SVGF: Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering", High
// Performance Graphics, section 4.4. Variance comes from the samples of the pixel, not from frames
// before. Five levels.
#include "baselines/layers.clh"

#define SIGMA_DEPTH 1.0f
#define LOG2_SIGMA_NORMAL 7  // of 128
#define SIGMA_LUMINANCE 4.0f

/// cosine^128 by squaring: pow is the larger part of the time on CPUs.
inline float normal_weight(float cosine) {
    float w = cosine;
    for (int i = 0; i < LOG2_SIGMA_NORMAL; ++i) w *= w;
    return w;
}

/// Variance after a 3 x 3 Gaussian (eq. 5): that of a pixel with few samples is unstable itself.
inline float smooth_variance(__global const float4* light, int x, int y, int width, int height) {
    float sum = 0, weights = 0;
    for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) {
            if (!is_inside(x + u, y + v, width, height)) continue;
            const float w = (u ? 0.25f : 0.5f) * (v ? 0.25f : 0.5f);
            sum += w * light[(y + v) * width + x + u].w;
            weights += w;
        }
    return sum / weights;
}

/// Change of depth per pixel across and down, from the nearer neighbour on each side.
inline float2 depth_gradient(__global const float4* surface, int x, int y, int width, int height) {
    const float z = surface[y * width + x].w;
    float2 gradient = (float2)(INFINITY);
    for (int s = -1; s <= 1; s += 2) {
        if (is_inside(x + s, y, width, height) && is_hit(surface[y * width + x + s]))
            gradient.x = fmin(gradient.x, fabs(surface[y * width + x + s].w - z));
        if (is_inside(x, y + s, width, height) && is_hit(surface[(y + s) * width + x]))
            gradient.y = fmin(gradient.y, fabs(surface[(y + s) * width + x].w - z));
    }
    return (float2)(gradient.x < INFINITY ? gradient.x : 0, gradient.y < INFINITY ? gradient.y : 0);
}

__kernel void svgf(const int width, const int height, __global const float4* light,
                   __global const float4* surface, __global const float4* place,
                   const int pass_number, __global float4* out) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    if (!is_hit(surface[i])) {
        out[i] = light[i];
        return;
    }
    const float spline[3] = {3.0f / 8, 1.0f / 4, 1.0f / 16};
    const int step = 1 << pass_number;
    const int x = i % width, y = i / width;
    const float4 n = surface[i];
    const float l = luminance_of(light[i]);
    const float deviation = sqrt(fmax(smooth_variance(light, x, y, width, height), 0.0f));
    const float2 gradient = depth_gradient(surface, x, y, width, height);
    // Relative to what is measured: no unit, no exposure.
    const float least_depth = 1e-4f * n.w, least_light = 1e-4f * fabs(l) + FLT_MIN;
    float4 sum = 0;
    float weights = 0, variance = 0;
    for (int v = -2; v <= 2; ++v)
        for (int u = -2; u <= 2; ++u) {
            if (!is_inside(x + u * step, y + v * step, width, height)) continue;
            const int j = i + v * step * width + u * step;
            const float4 m = surface[j];
            if (!is_hit(m)) continue;
            const float cosine = fmax(0.0f, n.x * m.x + n.y * m.y + n.z * m.z);
            const float expected = gradient.x * abs(u * step) + gradient.y * abs(v * step);
            const float depth = fabs(m.w - n.w) / (SIGMA_DEPTH * expected + least_depth);
            const float brightness =
                fabs(luminance_of(light[j]) - l) / (SIGMA_LUMINANCE * deviation + least_light);
            const float w = spline[abs(u)] * spline[abs(v)] * normal_weight(cosine) *
                            exp(-fmin(depth + brightness, 80.0f));
            sum += w * light[j];
            weights += w;
            variance += w * w * light[j].w;
        }
    if (weights <= 0) {
        out[i] = light[i];
        return;
    }
    float4 result = sum / weights;
    result.w = variance / square(weights);
    out[i] = result;
}
