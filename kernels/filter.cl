/* Axis-aligned filtering, between the sampling passes (path.cl) and the image:
     filter_flat       unshadowed light of flat pixels, free of noise, and hues of shadows
     filter_means      sums over samples to what is filtered
     filter_x, filter_y   lines fitted along rows, then along columns, by Gaussian weights; after the latter, filtered
                       signals times what was not filtered, texture and unshadowed light
     filter_none       the same without a filter
   Widths are those of bandwidth.cl. What is done with the result: guard.cl.
   Arrays: include/wedge/shared/filter.h; places, sigmas and means in planes. Filters work on eight pixels side by side
   (lib/planes.clh). */
#include "lib/filter_weight.clh"
#include "lib/flat_light.clh"
#include "lib/line_fit.clh"
#include "lib/part_light.clh"
#include "wedge/shared/frame.h"

__kernel void filter_flat(__global const FrameParams* restrict params, __global const Light* restrict lights,
                          __global const FilmPixel* restrict film, __global const SurfaceSum* restrict surface_sums,
                          __global const float4* restrict reflected, __global float* restrict corrections, int width,
                          int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const CameraRays camera = params->camera;
    const float2 corner_px = (float2)(params->crop_x + pixel % width, params->crop_y + pixel / width);
    for (int i = 0; i < WEDGE_SHADOW_LIGHTS; ++i) {
        __global const float4* sums = reflected + reflected_at((uint)pixel, (uint)i);
        const float correction =
            flat_correction(lights + i, &camera, corner_px, film + pixel, surface_sums + pixel, sums[0]);
        __global float* to = corrections + correction_at((uint)pixel, (uint)i);
        *to = correction;
        keep_hues(to, sums);
    }
}

__kernel void filter_means(__global const SampledLight* restrict unfiltered,
                           __global const float* restrict places, __global const float4* restrict sums,
                           __global const uint* restrict more, __global float* restrict means, int width,
                           int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const ulong at = pixel_at(&planes, pixel % width, pixel / width);
    const float first = unfiltered[pixel].direct[0].w, second = unfiltered[pixel].direct[1].w;
    for (int entry = 0; entry < WEDGE_SURFACES * WEDGE_SIGNALS; ++entry) {
        const int surface = entry / WEDGE_SIGNALS, signal = entry % WEDGE_SIGNALS;
        const int id = surface_entry(more, width * height, pixel, surface);
        if (id < 0 || !has_surface(&planes, places, surface, at)) break;
        __global const float4* s = sums + 2u * ((uint)id * WEDGE_SIGNALS + (uint)signal);
        const float4 a = first > 0.0f ? s[0] / first : (float4)(0.0f);
        const float4 b = second > 0.0f ? s[1] / second : (float4)(0.0f);
        const float8 values = is_light(signal) ? (float8)(a.xy, b.xy, 0.0f, 0.0f, 0.0f, 0.0f) : (float8)(a, b);
        set_means(&planes, means, surface, signal, at, values);
    }
}

/* What a filter reads. `signals`: means, or what filter_x has made of them. `scale`: of widths. */
typedef struct {
    __constant FilterSettings* settings;
    __global const Light* lights;
    __global const float *places, *sigmas, *signals;
    Planes planes;
    float scale;
} Filter;

inline Cast8 filter_cast(const Filter* filter, const Places8* p, int signal) {
    if (!is_light(signal)) return no_cast8();
    __global const Light* light = filter->lights + signal;
    const float3 middle = light->origin.xyz + 0.5f * (light->edge_u.xyz + light->edge_v.xyz);
    return cast8(p, light->normal.xyz, middle);
}

/* The pixels of a row or a column that filters for a group may reach: `before` to the one side, `after` to the other.
   From one to the next it is `stride` floats and `columns` to the right. */
typedef struct {
    int before, after, columns;
    long stride;
} Line;

inline float8 filter_sigma8(const Filter* filter, int entry, ulong at) {
    return load8(&filter->planes, filter->sigmas, entry, at) * filter->scale;
}

/* Pixels to each side that have a weight; 0 where nothing is to be filtered. */
inline float8 filter_reach8(const Filter* filter, const Places8* p, float8 sigma) {
    const float8 reach = ceil(3.0f * sigma / p->size);
    const int8 filters = (sigma > 0.0f) & (p->size > 0.0f);
    return keep_lanes(lesser8(reach, (float8)((float)filter->settings->max_radius_px)), filters);
}

/* What a line of pixels makes of one signal of one surface of a group's pixels. */
inline Means8 filter_line(const Filter* filter, const Group* group, Line line, int surface, int signal) {
    const Planes* planes = &filter->planes;
    const Places8 p = load_places8(planes, filter->places, surface, group->at);
    const float8 sigma = filter_sigma8(filter, surface * WEDGE_SIGNALS + signal, group->at);
    const float8 reach = filter_reach8(filter, &p, sigma);
    const Cast8 cast = filter_cast(filter, &p, signal);
    const Means8 own = load_means8(planes, filter->signals, surface, signal, group->at);
    LineSums8 sums = no_line8();
    add_to_line8(&sums, 0.0f, (float8)(1.0f), p.size > 0.0f, &own, signal);

    const int radius = (int)largest_lane(reach);
    for (int i = -min(radius, line.before); i <= min(radius, line.after); ++i) {
        if (i == 0) continue;
        const ulong at = group->at + (ulong)(i * line.stride);
        const int8 reached = (reach >= fabs((float)i)) & is_on_row(planes, group, i * line.columns);
        for (int other = 0; other < WEDGE_SURFACES; ++other) {
            const Places8 q = load_places8(planes, filter->places, other, at);
            const int8 is_there = reached & (q.size > 0.0f);
            if (!lane_bits8(is_there)) break;
            const float8 sigma_q = filter_sigma8(filter, other * WEDGE_SIGNALS + signal, at);
            const float8 w = keep_lanes(filter_weight8(&p, sigma, &q, sigma_q, &cast), is_there);
            const int8 counts = w > 0.0f;
            if (!lane_bits8(counts)) continue;
            const Means8 theirs = load_means8(planes, filter->signals, other, signal, at);
            add_to_line8(&sums, (float)i, w, counts, &theirs, signal);
        }
    }
    return fit_line8(&sums, signal);
}

/* `coverage`: of parts of pixels, noise that radiance as sampled has and their own samples have not
   (lib/coverage.clh). */
__kernel void filter_none(__global const float* restrict places, __global const FilmPixel* restrict film,
                          __global const SurfaceSum* restrict surface_sums, __global const uint* restrict more,
                          __global const float4* restrict reflected,
                          __global const float* restrict corrections,
                          __global const Remainder* restrict remainders,
                          __global const float4* restrict signal_sums,
                          __global const float* restrict means, __global HalfLight* restrict light,
                          __global float* restrict coverage, int width, int height) {
    const Planes planes = make_planes(width, height);
    const Group group = group_in_rows(&planes, (int)get_global_id(0));
    if (!is_on_film(&planes, &group)) return;
    const PixelSums sums = {film, surface_sums, more, reflected, corrections, remainders};
    HalfLight result[WEDGE_LANES * WEDGE_PARTS];
    PlaceSums noted[WEDGE_LANES * WEDGE_PARTS];
    begin_light(&planes, &group, &sums, result);
    begin_places(&planes, &group, &sums, result, noted);
    for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
        if (!any_surface(&planes, places, surface, group.at)) break;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            const Means8 own = load_means8(&planes, means, surface, signal, group.at);
            add_light(&planes, places, &group, surface, signal, &own, &sums, result);
        }
        note_places(&planes, &group, &sums, surface, result, noted);
    }
    store_coverage(&planes, &group, &sums, noted, coverage);
    add_sampled(&planes, &group, &sums, signal_sums, result);
    store_light(&planes, &group, result, light, 0);
}

#define WEDGE_FILTER_PARAMS                                                                        \
    __constant FilterSettings *settings, __global const Light *restrict lights,                    \
        __global const float *restrict places, __global const float *restrict sigmas,              \
        __global const float *restrict signals, int width, int height, float scale
#define WEDGE_FILTER_ARGS \
    { settings, lights, places, sigmas, signals, make_planes(width, height), scale }

__kernel void filter_x(WEDGE_FILTER_PARAMS, __global float* restrict filtered) {
    const Filter filter = WEDGE_FILTER_ARGS;
    const Group group = group_in_rows(&filter.planes, (int)get_global_id(0));
    if (!is_on_film(&filter.planes, &group)) return;
    const Line line = {group.x + WEDGE_LANES - 1, width - 1 - group.x, 1, 1};
    for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
        if (!any_surface(&filter.planes, places, surface, group.at)) break;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            const Means8 row = filter_line(&filter, &group, line, surface, signal);
            store_means8(row, &filter.planes, filtered, surface, signal, group.at);
        }
    }
}

/* `signals`: what filter_x has made. `index`: place of `scale` in WEDGE_SCALE_WIDTHS. */
__kernel void filter_y(WEDGE_FILTER_PARAMS, __global const FilmPixel* restrict film,
                       __global const SurfaceSum* restrict surface_sums, __global const uint* restrict more,
                       __global const float4* restrict reflected, __global const float* restrict corrections,
                       __global const Remainder* restrict remainders, __global HalfLight* restrict light, int index) {
    const Filter filter = WEDGE_FILTER_ARGS;
    const Group group = group_in_columns(&filter.planes, (int)get_global_id(0));
    if (!is_on_film(&filter.planes, &group)) return;
    const Line line = {group.y, height - 1 - group.y, 0, filter.planes.pitch};
    const PixelSums sums = {film, surface_sums, more, reflected, corrections, remainders};
    HalfLight result[WEDGE_LANES * WEDGE_PARTS];
    begin_light(&filter.planes, &group, &sums, result);
    for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
        if (!any_surface(&filter.planes, places, surface, group.at)) break;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            const Means8 column = filter_line(&filter, &group, line, surface, signal);
            add_light(&filter.planes, places, &group, surface, signal, &column, &sums, result);
        }
    }
    store_light(&filter.planes, &group, result, light, index);
}
