/* The guard: how much to filter is decided pixel by pixel, by estimated error.

   The two halves of a pixel's samples are independent. What one half was filtered to, compared with what the other
   half of the pixel's own samples makes of the same surfaces, tells the square of bias and noise of the filtered half, plus the noise of the other, which
   the difference of the two unfiltered halves tells (the dual buffers of Rousselle, Knaus, Zwicker 2012). Such
   estimates are as noisy as what they are made from; their means over neighbouring pixels decide. A rare bright
   sample in one half cancels: with both filtered halves alike, the estimate is (f - u0) (f - u1). What no filter can change, coverage of pixels by surfaces, is alike in all and
   does not count.

     guard_errors      estimates for each pixel
     guard_smooth_x, guard_smooth_y   their means over neighbours
     guard_choose      the mixture of the least error */
#include "lib/geometry.clh"
#include "wedge/shared/filter.h"

inline float square(float4 v) { return dot(v.xyz, v.xyz) * (1.0f / 3.0f); }

/* Mean square error of f, the mean of two halves; u: the pixel's own halves, `noise`: mean square of their difference. */
inline float filtered_error(__global const float4* f, __global const float4* u, float noise) {
    return 0.5f * (square(f[0] - u[1]) + square(f[1] - u[0])) - 0.5f * noise - 0.25f * square(f[0] - f[1]);
}

/* By scale. The pixel's own samples have no bias. */
inline float4 errors_of(__global const float4* none, __global const float4* narrow,
                        __global const float4* full) {
    const float noise = square(none[0] - none[1]);
    return (float4)(0.25f * noise, filtered_error(narrow, none, noise),
                    filtered_error(full, none, noise), 0.0f);
}

/* A render that was stopped early has pixels without a second half. They know nothing: what their neighbours know
   decides, and if none knows anything, the filter is trusted. */
__kernel void guard_errors(__global const HalfLight* restrict unfiltered,
                           __global const HalfLight* restrict light,
                           __global FilterErrors* restrict errors, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    __global const HalfLight *none = light + id, *narrow = none + count, *full = narrow + count;
    FilterErrors e;
    e.direct = e.indirect = (float4)(0.0f);
    if (unfiltered[id].direct[1].w > 0.0f) {
        e.direct = errors_of(none->direct, narrow->direct, full->direct);
        e.indirect = errors_of(none->indirect, narrow->indirect, full->indirect);
    }
    e.direct_squared = e.direct * e.direct;
    e.indirect_squared = e.indirect * e.indirect;
    errors[id] = e;
}

/* Mean of `errors` over a stretch of 2 WEDGE_GUARD_RADIUS + 1 pixels, as far as they are on the film. */
#define WEDGE_GUARD_RADIUS 5
#define WEDGE_GUARD_SIDE (2.0f * WEDGE_GUARD_RADIUS + 1.0f)

inline FilterErrors mean_errors(__global const FilterErrors* errors, int first, int stride,
                                int before, int after) {
    FilterErrors sum;
    sum.direct = sum.direct_squared = sum.indirect = sum.indirect_squared = (float4)(0.0f);
    const int begin = -min(before, WEDGE_GUARD_RADIUS), end = min(after, WEDGE_GUARD_RADIUS);
    for (int i = begin; i <= end; ++i) {
        __global const FilterErrors* e = errors + first + i * stride;
        sum.direct += e->direct;
        sum.direct_squared += e->direct_squared;
        sum.indirect += e->indirect;
        sum.indirect_squared += e->indirect_squared;
    }
    const float share = 1.0f / (float)(end - begin + 1);
    sum.direct *= share;
    sum.direct_squared *= share;
    sum.indirect *= share;
    sum.indirect_squared *= share;
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

/* Standard error of the estimate `error`, whose mean square is known. */
inline float standard_error(float error, float mean_square) {
    const float variance = fmax(mean_square - error * error, 0.0f);
    return sqrt(variance * (1.0f / (WEDGE_GUARD_SIDE * WEDGE_GUARD_SIDE - 1.0f)));
}

inline float4 mean_of_halves(__global const float4* light) { return 0.5f * (light[0] + light[1]); }

/* Of the filter's error this many standard errors of its estimate are taken off: where it is a matter of luck
   which seems better, the filter is the better guess. */
#define WEDGE_BENEFIT_OF_DOUBT 1.0f

/* rgb, and the width that was taken, as a share of the full one. Bias and noise are independent, so the mean of a
   filter and none weighted by the errors is better than both. */
inline float4 choose(float4 errors, float4 squares, float4 none, float4 narrow, float4 full,
                     float* error) {
    const bool is_narrow = errors.y < errors.z;
    const float filter_error = fmin(errors.y, errors.z), noise = errors.x;
    const float doubt =
        WEDGE_BENEFIT_OF_DOUBT * standard_error(filter_error, is_narrow ? squares.y : squares.z);
    const float certain = fmax(filter_error - doubt, 0.0f);
    const float share = certain > 0.0f ? noise / (noise + certain) : 1.0f;
    *error = share * share * fmax(filter_error, 0.0f) + (1.0f - share) * (1.0f - share) * noise;
    const float4 filtered = is_narrow ? narrow : full;
    return (float4)(mix(none.xyz, filtered.xyz, share), is_narrow ? 0.5f * share : share);
}

/* As `choose`, but with the filter everywhere or nowhere. `light`: of a pixel by scale, `stride` apart. */
inline float4 choose_by_mode(int mode, float4 errors, float4 squares, __global const float4* light,
                             uint stride, float4 unfiltered, float* error) {
    const float4 full = mean_of_halves(light + 2 * stride);
    if (mode == WEDGE_FILTER_MODE_GUARDED)
        return choose(errors, squares, mean_of_halves(light), mean_of_halves(light + stride), full,
                      error);
    const bool plain = mode == WEDGE_FILTER_MODE_PLAIN;
    *error = plain ? fmax(errors.z, 0.0f) : errors.x;
    return plain ? (float4)(full.xyz, 1.0f) : (float4)(unfiltered.xyz, 0.0f);
}

/* float4 from one pixel's HalfLight to the same of the next scale. */
#define WEDGE_STRIDE(count) ((count) * (uint)(sizeof(HalfLight) / sizeof(float4)))

__kernel void guard_choose(__constant FilterSettings* settings,
                           __global const HalfLight* restrict unfiltered,
                           __global const HalfLight* restrict light,
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
    g.direct = choose_by_mode(mode, errors[id].direct, errors[id].direct_squared, light[id].direct, WEDGE_STRIDE(count),
                              (u->direct[0] + u->direct[1]) / n, &error);
    g.error.x = error;
    g.indirect = choose_by_mode(mode, errors[id].indirect, errors[id].indirect_squared, light[id].indirect, WEDGE_STRIDE(count),
                                (u->indirect[0] + u->indirect[1]) / n, &error);
    g.error.y = error;
    guarded[id] = g;
}
