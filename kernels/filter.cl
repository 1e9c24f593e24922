/* Axis-aligned filtering, between the sampling passes (path.cl) and the image:
     filter_means      sums over samples to what is filtered
     filter_x, filter_y   a Gaussian along rows, then along columns; after the latter, filtered signals times what was not
                       filtered, texture and unshadowed light
     filter_none       the same without a filter
   Widths are those of bandwidth.cl. What is done with the result: guard.cl.
   Arrays: include/wedge/shared/filter.h. A mean holds both halves: two times rgb (of a light: irradiance with and
   without shadow) and w, the share of the pixel. */
#include "lib/filter_weight.clh"
#include "lib/signals.clh"
#include "wedge/shared/frame.h"

/* Surfaces that are not there have no means, and nobody asks for them. */
__kernel void filter_means(__global const HalfLight* restrict unfiltered,
                           __global const FilterSurface* restrict surfaces,
                           __global const float4* restrict sums, __global float8* restrict means,
                           uint count) {
    const uint id = get_global_id(0);
    if (id >= count || !(surfaces[id / WEDGE_SIGNALS].position.w > 0.0f)) return;
    __global const HalfLight* pixel = unfiltered + id / (WEDGE_SURFACES * WEDGE_SIGNALS);
    const float first = pixel->direct[0].w, second = pixel->direct[1].w;
    const float4 a = first > 0.0f ? sums[2 * id] / first : (float4)(0.0f);
    const float4 b = second > 0.0f ? sums[2 * id + 1] / second : a;
    means[id] = (float8)(a, b);
}

inline float3 filter_axis(__global const Light* lights, int signal) {
    return signal < WEDGE_SHADOW_LIGHTS ? lights[signal].normal.xyz : (float3)(0.0f);
}

/* The pixels first, first + stride, ... of one row or column that a filter may reach from the pixel `first`. */
typedef struct {
    int pixel, stride, before, after;
} Line;

/* Sums over a line, normalised, of all signals of surface `id`: they share the geometry. */
inline void filter_line(__constant FilterSettings* settings, __global const Light* lights,
                        __global const FilterSurface* surfaces, __global const float* sigmas,
                        __global const float8* means, float8* filtered, Line line, int id, float scale) {
    const FilterSurface p = surfaces[id];
    float sigma[WEDGE_SIGNALS], weights[WEDGE_SIGNALS], widest = 0.0f;
    for (int s = 0; s < WEDGE_SIGNALS; ++s) {
        sigma[s] = sigmas[id * WEDGE_SIGNALS + s] * scale;
        filtered[s] = means[id * WEDGE_SIGNALS + s];
        weights[s] = 1.0f;
        widest = fmax(widest, sigma[s]);
    }
    const int radius = min((int)ceil(3.0f * widest / p.position.w), settings->max_radius_px);
    for (int i = -min(radius, line.before); i <= min(radius, line.after); ++i) {
        const int first = (line.pixel + i * line.stride) * WEDGE_SURFACES;
        for (int q = first; i != 0 && q < first + WEDGE_SURFACES; ++q) {
            const FilterSurface other = surfaces[q];
            if (!(other.position.w > 0.0f) || !is_same_surface(p, other)) continue;
            const float3 d = other.position.xyz - p.position.xyz;
            for (int s = 0; s < WEDGE_SIGNALS; ++s) {
                /* Not fmin, whose rules for NaN cost more. */
                const float theirs = sigmas[q * WEDGE_SIGNALS + s] * scale;
                const float narrow = sigma[s] < theirs ? sigma[s] : theirs;
                if (!(narrow > 0.0f)) continue;
                const float w = distance_weight(d, narrow, filter_axis(lights, s));
                if (!(w > 0.0f)) continue;
                filtered[s] += w * means[q * WEDGE_SIGNALS + s];
                weights[s] += w;
            }
        }
    }
    for (int s = 0; s < WEDGE_SIGNALS; ++s) filtered[s] /= weights[s];
}

/* One half of a signal. Where none of its samples met the surface, the other half stands in. */
inline float4 half_of(float8 f, int h) {
    const float4 own = h == 0 ? f.s0123 : f.s4567, other = h == 0 ? f.s4567 : f.s0123;
    return own.w > 0.0f ? own : other;
}

/* Adds what a surface makes of its signals. `samples`: of the whole pixel. */
inline void add_surface(HalfLight* light, __global const SurfaceSum* sum,
                        __global const float4* reflected, const float8* signals, float samples) {
    for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
        for (int h = 0; h < 2; ++h) {
            const float4 v = half_of(signals[signal], h);
            if (signal < WEDGE_SHADOW_LIGHTS) {
                const float visibility = v.y > 0.0f ? v.x / v.y : 0.0f;
                light->direct[h].xyz += reflected[signal].xyz * (visibility / samples);
            } else if (v.w > 0.0f) {
                const float3 colour =
                    signal == WEDGE_SIGNAL_DIFFUSE ? sum->diffuse.xyz : sum->specular.xyz;
                light->indirect[h].xyz += colour * v.xyz / (v.w * samples);
            }
        }
    }
}

inline HalfLight no_light(void) {
    HalfLight light;
    for (int h = 0; h < 2; ++h) light.direct[h] = light.indirect[h] = (float4)(0.0f);
    return light;
}

__kernel void filter_none(__global const FilmPixel* restrict film,
                          __global const SurfaceSum* restrict sums,
                          __global const float4* restrict reflected,
                          __global const float8* restrict means, __global HalfLight* restrict light,
                          uint count) {
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;
    HalfLight result = no_light();
    for (uint id = pixel * WEDGE_SURFACES; id < (pixel + 1) * WEDGE_SURFACES; ++id) {
        if (!(sums[id].position.w > 0.0f)) continue;
        float8 own[WEDGE_SIGNALS];
        for (int s = 0; s < WEDGE_SIGNALS; ++s) own[s] = means[id * WEDGE_SIGNALS + s];
        add_surface(&result, sums + id, reflected + id * WEDGE_SHADOW_LIGHTS, own,
                    fmax(film[pixel].normal.w, 1.0f));
    }
    light[pixel] = result;
}

__kernel void filter_x(__constant FilterSettings* settings, __global const Light* restrict lights,
                       __global const FilterSurface* restrict surfaces,
                       __global const float* restrict sigmas, __global const float8* restrict means,
                       int width, int height, float scale, __global float8* restrict filtered) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const int x = pixel % width;
    const Line line = {pixel, 1, x, width - 1 - x};
    for (int id = pixel * WEDGE_SURFACES; id < (pixel + 1) * WEDGE_SURFACES; ++id) {
        if (!(surfaces[id].position.w > 0.0f)) continue;
        float8 row[WEDGE_SIGNALS];
        filter_line(settings, lights, surfaces, sigmas, means, row, line, id, scale);
        for (int s = 0; s < WEDGE_SIGNALS; ++s) filtered[id * WEDGE_SIGNALS + s] = row[s];
    }
}

/* `rows`: what filter_x has made. `index`: place of `scale` in WEDGE_SCALE_WIDTHS. */
__kernel void filter_y(__constant FilterSettings* settings, __global const Light* restrict lights,
                       __global const FilterSurface* restrict surfaces,
                       __global const float* restrict sigmas, __global const float8* restrict rows,
                       int width, int height, float scale, __global const FilmPixel* restrict film,
                       __global const SurfaceSum* restrict sums,
                       __global const float4* restrict reflected,
                       __global HalfLight* restrict light, int index) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const int y = pixel / width;
    const Line line = {pixel, width, y, height - 1 - y};
    HalfLight result = no_light();
    for (int id = pixel * WEDGE_SURFACES; id < (pixel + 1) * WEDGE_SURFACES; ++id) {
        if (!(surfaces[id].position.w > 0.0f)) continue;
        float8 filtered[WEDGE_SIGNALS];
        filter_line(settings, lights, surfaces, sigmas, rows, filtered, line, id, scale);
        add_surface(&result, sums + id, reflected + id * WEDGE_SHADOW_LIGHTS, filtered,
                    fmax(film[pixel].normal.w, 1.0f));
    }
    light[index * width * height + pixel] = result;
}
