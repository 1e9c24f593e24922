/* The guard: how much to filter is decided pixel by pixel, by estimated error.

   The two halves of a pixel's samples are independent. What one half was filtered to, compared with what the other
   is without a filter, tells the square of bias and noise of the filtered half, plus the noise of the other, which
   the difference of the two unfiltered halves tells (the dual buffers of Rousselle, Knaus, Zwicker 2012). Such
   estimates are as noisy as what they are made from; their means over neighbouring pixels decide. A rare bright
   sample in one half cancels: with both filtered halves alike, the estimate is (f - u0) (f - u1).

     guard_errors      estimates for each pixel
     guard_smooth_x, guard_smooth_y   their means over neighbours
     guard_choose      the mixture of the least error */
#include "lib/geometry.clh"
#include "wedge/shared/filter.h"

inline float square(float4 v) { return dot(v.xyz, v.xyz) * (1.0f / 3.0f); }

/* Mean square error of (f0 + f1) / 2; `noise`: mean square of u0 - u1. */
inline float filtered_error(float4 f0, float4 f1, float4 u0, float4 u1, float noise) {
    return 0.5f * (square(f0 - u1) + square(f1 - u0)) - 0.5f * noise - 0.25f * square(f0 - f1);
}

inline float4 errors_of(__global const float4* full, __global const float4* half_width, float4 u0,
                        float4 u1) {
    const float noise = square(u0 - u1);
    const float e = filtered_error(full[0], full[1], u0, u1, noise);
    return (float4)(e, filtered_error(half_width[0], half_width[1], u0, u1, noise), 0.25f * noise,
                    e * e);
}

__kernel void guard_errors(__global const HalfLight* restrict unfiltered,
                           __global const HalfLight* restrict full,
                           __global const HalfLight* restrict half_width,
                           __global FilterErrors* restrict errors, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    __global const HalfLight* u = unfiltered + id;
    FilterErrors e;
    e.direct = e.indirect = (float4)(0.0f);
    const float n0 = u->direct[0].w, n1 = u->direct[1].w;
    if (n0 > 0.0f && n1 > 0.0f) {
        e.direct = errors_of(full[id].direct, half_width[id].direct, u->direct[0] / n0,
                             u->direct[1] / n1);
        e.indirect = errors_of(full[id].indirect, half_width[id].indirect, u->indirect[0] / n0,
                               u->indirect[1] / n1);
    }
    errors[id] = e;
}

/* Mean of `errors` over a stretch of 2 WEDGE_GUARD_RADIUS + 1 pixels, as far as they are on the film. */
#define WEDGE_GUARD_RADIUS 5
#define WEDGE_GUARD_SIDE (2.0f * WEDGE_GUARD_RADIUS + 1.0f)

inline FilterErrors mean_errors(__global const FilterErrors* errors, int first, int stride,
                                int before, int after) {
    FilterErrors sum;
    sum.direct = sum.indirect = (float4)(0.0f);
    const int begin = -min(before, WEDGE_GUARD_RADIUS), end = min(after, WEDGE_GUARD_RADIUS);
    for (int i = begin; i <= end; ++i) {
        sum.direct += errors[first + i * stride].direct;
        sum.indirect += errors[first + i * stride].indirect;
    }
    const float share = 1.0f / (float)(end - begin + 1);
    sum.direct *= share;
    sum.indirect *= share;
    return sum;
}

__kernel void guard_smooth_x(__global const FilterErrors* restrict errors,
                             __global FilterErrors* restrict smoothed, int width, int height) {
    const int id = (int)get_global_id(0), x = id % max(width, 1);
    if (id < width * height) smoothed[id] = mean_errors(errors, id, 1, x, width - 1 - x);
}

__kernel void guard_smooth_y(__global const FilterErrors* restrict errors,
                             __global FilterErrors* restrict smoothed, int width, int height) {
    const int id = (int)get_global_id(0), y = id / max(width, 1);
    if (id < width * height) smoothed[id] = mean_errors(errors, id, width, y, height - 1 - y);
}

/* rgb, and the filter's share of it, halved where the narrower filter was taken. Bias and noise are independent, so
   the mean weighted by the errors is better than both. Of the filter's error the standard error of its estimate is
   taken off: where it is a matter of luck which seems better, the filter is the better guess. */
inline float4 choose(float4 errors, __global const float4* full, __global const float4* half_width,
                     float4 unfiltered, float* error) {
    const bool narrow = errors.y < errors.x;
    const float filter_error = fmin(errors.x, errors.y), noise = errors.z;
    const float variance = fmax(errors.w - errors.x * errors.x, 0.0f);
    const float spread = sqrt(variance * (1.0f / (WEDGE_GUARD_SIDE * WEDGE_GUARD_SIDE - 1.0f)));
    const float certain = fmax(filter_error - spread, 0.0f);
    const float share = certain > 0.0f ? noise / (noise + certain) : 1.0f;
    const float4 filtered = narrow ? 0.5f * (half_width[0] + half_width[1]) : 0.5f * (full[0] + full[1]);
    *error = share * share * fmax(filter_error, 0.0f) + (1.0f - share) * (1.0f - share) * noise;
    return (float4)(mix(unfiltered.xyz, filtered.xyz, share), narrow ? 0.5f * share : share);
}

/* As `choose`, but with the filter everywhere or nowhere. */
inline float4 choose_by_mode(int mode, float4 errors, __global const float4* full,
                             __global const float4* half_width, float4 unfiltered, float* error) {
    if (mode == WEDGE_FILTER_MODE_GUARDED)
        return choose(errors, full, half_width, unfiltered, error);
    const bool plain = mode == WEDGE_FILTER_MODE_PLAIN;
    *error = plain ? fmax(errors.x, 0.0f) : errors.z;
    return plain ? (float4)(0.5f * (full[0].xyz + full[1].xyz), 1.0f)
                 : (float4)(unfiltered.xyz, 0.0f);
}

__kernel void guard_choose(__constant FilterSettings* settings,
                           __global const HalfLight* restrict unfiltered,
                           __global const HalfLight* restrict full,
                           __global const HalfLight* restrict half_width,
                           __global const FilterErrors* restrict errors,
                           __global GuardedPixel* restrict guarded, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    __global const HalfLight* u = unfiltered + id;
    const float n = fmax(u->direct[0].w + u->direct[1].w, 1.0f);
    GuardedPixel g;
    g.error = (float4)(0.0f);
    float error;
    const int mode = settings->mode;
    g.direct = choose_by_mode(mode, errors[id].direct, full[id].direct, half_width[id].direct,
                      (u->direct[0] + u->direct[1]) / n, &error);
    g.error.x = error;
    g.indirect = choose_by_mode(mode, errors[id].indirect, full[id].indirect, half_width[id].indirect,
                        (u->indirect[0] + u->indirect[1]) / n, &error);
    g.error.y = error;
    guarded[id] = g;
}
