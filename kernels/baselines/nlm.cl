// Non-local means with two buffers: Rousselle, Knaus, Zwicker 2012, "Adaptive Rendering with Non-Local
// Means Filtering", ACM Transactions on Graphics 31(6), section 4. Weights from one half of the samples
// filter the other. One launch an offset of the window: distances, their sums along rows, then along
// columns with the weight.
#include "baselines/layers.clh"

#define K 0.45f          // how far apart two pixels may be, in deviations (section 4)
#define ALPHA 0.5f       // how much of the expected distance of equal pixels is taken off
#define PATCH_RADIUS 3

inline float channel_distance(float p, float q, float variance_p, float variance_q) {
    const float noise = ALPHA * (variance_p + fmin(variance_p, variance_q));
    return (square(p - q) - noise) / (square(K) * (variance_p + variance_q) + FLT_MIN);
}

/// Equation 6: squared distance of each pixel from that `offset` away.
__kernel void nlm_distance(const int width, const int height, const int offset_x,
                           const int offset_y, __global const float4* light,
                           __global const float4* variance, __global float* distances) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    const int x = i % width, y = i / width;
    if (!is_inside(x + offset_x, y + offset_y, width, height)) {
        distances[i] = 0;
        return;
    }
    const int j = i + offset_y * width + offset_x;
    const float4 p = light[i], q = light[j], vp = variance[i], vq = variance[j];
    distances[i] = (channel_distance(p.x, q.x, vp.x, vq.x) + channel_distance(p.y, q.y, vp.y, vq.y) +
                    channel_distance(p.z, q.z, vp.z, vq.z)) /
                   3;
}

__kernel void nlm_rows(const int width, const int height, __global const float* distances,
                       __global float* sums) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    const int x = i % width;
    float sum = 0, count = 0;
    for (int u = max(-PATCH_RADIUS, -x); u <= min(PATCH_RADIUS, width - 1 - x); ++u) {
        sum += distances[i + u];
        count += 1;
    }
    sums[i] = sum / count;
}

/// `total`: weighted sum of the other half's light; w: sum of weights.
__kernel void nlm_add(const int width, const int height, const int offset_x, const int offset_y,
                      __global const float* sums, __global const float4* other,
                      __global float4* total) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    const int x = i % width, y = i / width;
    if (!is_inside(x + offset_x, y + offset_y, width, height)) return;
    float sum = 0, count = 0;
    for (int v = max(-PATCH_RADIUS, -y); v <= min(PATCH_RADIUS, height - 1 - y); ++v) {
        sum += sums[i + v * width];
        count += 1;
    }
    const float w = exp(-clamp(sum / count, 0.0f, 80.0f));
    const float4 c = other[i + offset_y * width + offset_x];
    total[i] += (float4)(w * c.x, w * c.y, w * c.z, w);
}

/// Variance of light from that of radiance.
__kernel void nlm_prepare(const int pixel_count, __global const float4* albedo,
                          __global const float4* variance, __global float4* light_variance,
                          __global float4* total) {
    const int i = get_global_id(0);
    if (i >= pixel_count) return;
    const float4 divisor = fmax(albedo[i], (float4)(0.01f));  // as in demodulate.cl
    light_variance[i] = variance[i] / (divisor * divisor);
    total[i] = 0;
}

__kernel void nlm_finish(const int pixel_count, __global const float4* total_a,
                         __global const float4* total_b, __global float4* light) {
    const int i = get_global_id(0);
    if (i >= pixel_count) return;
    light[i] = 0.5f * (total_a[i] / total_a[i].w + total_b[i] / total_b[i].w);
}
