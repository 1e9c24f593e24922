/* Axis-aligned filtering, between the sampling passes (path.cl) and the image:
     filter_means      sums over samples to what is filtered
     filter_x, filter_y   a Gaussian along rows, then along columns; after the latter, filtered signals times what was not
                       filtered, texture and unshadowed light
     filter_none       the same without a filter
   Widths are those of bandwidth.cl. What is done with the result: guard.cl.
   Arrays: include/wedge/shared/filter.h; places, sigmas and means in planes. Filters work on eight pixels side by side
   (lib/planes.clh). */
#include "lib/filter_weight.clh"
#include "lib/signals.clh"
#include "wedge/shared/frame.h"

inline bool has_surface(const Planes* planes, __global const float* places, int surface, ulong at) {
    return places[(surface * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE) * planes->size + at] > 0.0f;
}

/* Planes of means (wedge/shared/filter.h). */
#define WEDGE_SURFACE_PLANES \
    (WEDGE_LIGHT_PLANES * WEDGE_SHADOW_LIGHTS + WEDGE_HEMISPHERE_PLANES * (WEDGE_SIGNALS - WEDGE_SHADOW_LIGHTS))

inline bool is_light(int signal) { return signal < WEDGE_SHADOW_LIGHTS; }

inline int first_plane(int surface, int signal) {
    const int lights = min(signal, WEDGE_SHADOW_LIGHTS);
    return surface * WEDGE_SURFACE_PLANES + WEDGE_LIGHT_PLANES * lights + WEDGE_HEMISPHERE_PLANES * (signal - lights);
}

inline void set_means(const Planes* planes, __global float* means, int surface, int signal, ulong at, float8 values) {
    float list[8];
    vstore8(values, 0, list);
    const int count = is_light(signal) ? WEDGE_LIGHT_PLANES : WEDGE_HEMISPHERE_PLANES;
    for (int c = 0; c < count; ++c)
        means[(first_plane(surface, signal) + c) * planes->size + at] = list[c];
}

inline float8 get_means(const Planes* planes, __global const float* means, int surface, int signal, ulong at) {
    float list[8] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const int count = is_light(signal) ? WEDGE_LIGHT_PLANES : WEDGE_HEMISPHERE_PLANES;
    for (int c = 0; c < count; ++c)
        list[c] = means[(first_plane(surface, signal) + c) * planes->size + at];
    return vload8(0, list);
}

__kernel void filter_means(__global const SampledLight* restrict unfiltered,
                           __global const float* restrict places, __global const float4* restrict sums,
                           __global float* restrict means, int width, int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const ulong at = pixel_at(&planes, pixel % width, pixel / width);
    const float first = unfiltered[pixel].direct[0].w, second = unfiltered[pixel].direct[1].w;
    __global const float4* s = sums + pixel * WEDGE_SURFACES * WEDGE_SIGNALS * 2;
    for (int entry = 0; entry < WEDGE_SURFACES * WEDGE_SIGNALS; ++entry) {
        const int surface = entry / WEDGE_SIGNALS, signal = entry % WEDGE_SIGNALS;
        if (!has_surface(&planes, places, surface, at)) break;
        const float4 a = first > 0.0f ? s[2 * entry] / first : (float4)(0.0f);
        const float4 b = second > 0.0f ? s[2 * entry + 1] / second : a;
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

inline float3 filter_axis(const Filter* filter, int signal) {
    return signal < WEDGE_SHADOW_LIGHTS ? filter->lights[signal].normal.xyz : (float3)(0.0f);
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

/* The means of a signal in eight pixels. Lights have the first WEDGE_LIGHT_PLANES only. */
typedef struct {
    float8 v0, v1, v2, v3, v4, v5, v6, v7;
} Means8;

inline float8 add_lanes(float8 sums, float8 weights, int8 counts, __global const float* values) {
    return select(sums, sums + weights * vload8(0, values), counts);
}

/* Where nothing counts there may be anything. */
inline void add_means8(Means8* sums, float8 weights, int8 counts, const Filter* filter, int surface, int signal,
                       ulong at) {
    const ulong size = filter->planes.size;
    __global const float* v = filter->signals + first_plane(surface, signal) * size + at;
    sums->v0 = add_lanes(sums->v0, weights, counts, v);
    sums->v1 = add_lanes(sums->v1, weights, counts, v + size);
    sums->v2 = add_lanes(sums->v2, weights, counts, v + 2 * size);
    sums->v3 = add_lanes(sums->v3, weights, counts, v + 3 * size);
    if (is_light(signal)) return;
    sums->v4 = add_lanes(sums->v4, weights, counts, v + 4 * size);
    sums->v5 = add_lanes(sums->v5, weights, counts, v + 5 * size);
    sums->v6 = add_lanes(sums->v6, weights, counts, v + 6 * size);
    sums->v7 = add_lanes(sums->v7, weights, counts, v + 7 * size);
}

/* Means over a line, by weight, of one signal of one surface of a group's pixels, plane by plane. */
inline void filter_line(const Filter* filter, const Group* group, Line line, int surface, int signal,
                        float filtered[WEDGE_HEMISPHERE_PLANES][WEDGE_LANES]) {
    const Planes* planes = &filter->planes;
    const Places8 p = load_places8(planes, filter->places, surface, group->at);
    const float8 sigma = filter_sigma8(filter, surface * WEDGE_SIGNALS + signal, group->at);
    const float8 reach = filter_reach8(filter, &p, sigma);
    const float3 along = filter_axis(filter, signal);
    float8 weights = 1.0f;
    Means8 sums = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    add_means8(&sums, weights, p.size > 0.0f, filter, surface, signal, group->at);

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
            const float8 w = keep_lanes(filter_weight8(&p, sigma, &q, sigma_q, along), is_there);
            const int8 counts = w > 0.0f;
            if (!lane_bits8(counts)) continue;
            add_means8(&sums, w, counts, filter, other, signal, at);
            weights += w;
        }
    }
    const float8 share = 1.0f / weights;
    vstore8(sums.v0 * share, 0, filtered[0]);
    vstore8(sums.v1 * share, 0, filtered[1]);
    vstore8(sums.v2 * share, 0, filtered[2]);
    vstore8(sums.v3 * share, 0, filtered[3]);
    vstore8(sums.v4 * share, 0, filtered[4]);
    vstore8(sums.v5 * share, 0, filtered[5]);
    vstore8(sums.v6 * share, 0, filtered[6]);
    vstore8(sums.v7 * share, 0, filtered[7]);
}

/* Adds what a surface makes of a signal's means to the pixel's parts. Where none of a half's samples met the surface,
   the other half stands in. `samples`: of the whole pixel. */
inline void add_light(HalfLight* light, __global const SurfaceSum* sum, __global const float4* reflected,
                      int signal, float8 means, float samples) {
    const float share = 1.0f / samples;
    float4* halves = light[is_light(signal) ? WEDGE_PART_DIRECT : WEDGE_PART_INDIRECT].halves;
    if (is_light(signal)) {
        const float2 seen0 = means.y > 0.0f ? means.s01 : means.s23;
        const float2 seen1 = means.w > 0.0f ? means.s23 : means.s01;
        const float3 whole = reflected[signal].xyz * share;
        halves[0].xyz += whole * (seen0.y > 0.0f ? seen0.x / seen0.y : 0.0f);
        halves[1].xyz += whole * (seen1.y > 0.0f ? seen1.x / seen1.y : 0.0f);
    } else {
        const float4 half0 = means.s3 > 0.0f ? means.lo : means.hi;
        const float4 half1 = means.s7 > 0.0f ? means.hi : means.lo;
        const float3 colour = share * (signal == WEDGE_SIGNAL_DIFFUSE ? sum->diffuse.xyz : sum->specular.xyz);
        halves[0].xyz += colour * half0.xyz * (half0.w > 0.0f ? 1.0f / half0.w : 0.0f);
        halves[1].xyz += colour * half1.xyz * (half1.w > 0.0f ? 1.0f / half1.w : 0.0f);
    }
}

inline HalfLight no_light(void) {
    const HalfLight light = {{(float4)(0.0f), (float4)(0.0f)}};
    return light;
}

/* Adds a light's part of HalfLight's w. The ratio to unshadowed light that filters go by has less noise than light as
   it was sampled, of which this is the mean over samples that met the surface, as its mean colour reflects it. `sums`:
   of the signal, by halves. */
inline void add_sampled_light(HalfLight* light, __global const float4* sums, __global const SurfaceSum* surface,
                              float samples) {
    const float4 half0 = sums[0].w > 0.0f ? sums[0] : sums[1], half1 = sums[1].w > 0.0f ? sums[1] : sums[0];
    if (!(half0.w > 0.0f)) return;
    const float scale = luminance(surface->diffuse.xyz) * WEDGE_INV_PI / samples;
    light->halves[0].w += scale * half0.z / half0.w;
    light->halves[1].w += scale * half1.z / half1.w;
}

__kernel void filter_none(__global const float* restrict places, __global const FilmPixel* restrict film,
                          __global const SurfaceSum* restrict sums,
                          __global const float4* restrict reflected,
                          __global const float4* restrict signal_sums,
                          __global const float* restrict means, __global HalfLight* restrict light,
                          int width, int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const ulong at = pixel_at(&planes, pixel % width, pixel / width);
    HalfLight result[WEDGE_PARTS];
    for (int part = 0; part < WEDGE_PARTS; ++part) result[part] = no_light();
    for (int entry = 0; entry < WEDGE_SURFACES * WEDGE_SIGNALS; ++entry) {
        const int surface = entry / WEDGE_SIGNALS, id = pixel * WEDGE_SURFACES + surface;
        if (!has_surface(&planes, places, surface, at)) break;
        const int signal = entry % WEDGE_SIGNALS;
        const float samples = fmax(film[pixel].normal.w, 1.0f);
        add_light(result, sums + id, reflected + id * WEDGE_SHADOW_LIGHTS, signal,
                  get_means(&planes, means, surface, signal, at), samples);
        if (is_light(signal))
            add_sampled_light(result + WEDGE_PART_DIRECT, signal_sums + 2 * (id * WEDGE_SIGNALS + signal), sums + id,
                              samples);
    }
    if (WEDGE_SIGNALS > WEDGE_SHADOW_LIGHTS)
        for (int h = 0; h < 2; ++h) {
            float4* half_light = result[WEDGE_PART_INDIRECT].halves + h;
            half_light->w = luminance(half_light->xyz);
        }
    for (int part = 0; part < WEDGE_PARTS; ++part) light[pixel * WEDGE_PARTS + part] = result[part];
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
    for (int entry = 0; entry < WEDGE_SURFACES * WEDGE_SIGNALS; ++entry) {
        const int surface = entry / WEDGE_SIGNALS;
        const float8 size = load8(&filter.planes, places,
                                  surface * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE, group.at);
        if (!lane_bits8(size > 0.0f)) break;
        const int signal = entry % WEDGE_SIGNALS;
        float row[WEDGE_HEMISPHERE_PLANES][WEDGE_LANES];
        filter_line(&filter, &group, line, surface, signal, row);
        for (int c = 0; c < (is_light(signal) ? WEDGE_LIGHT_PLANES : WEDGE_HEMISPHERE_PLANES); ++c)
            store8(vload8(0, row[c]), &filter.planes, filtered, first_plane(surface, signal) + c, group.at);
    }
}

/* Of all signals of one surface, to the group's pixels. */
inline void filter_surface(const Filter* filter, const Group* group, Line line, int surface,
                           __global const FilmPixel* film, __global const SurfaceSum* sums,
                           __global const float4* reflected, HalfLight* light) {
    const int first = group->y * filter->planes.width + group->x;
    const int lanes = min(WEDGE_LANES, filter->planes.width - group->x);
    for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
        float column[WEDGE_HEMISPHERE_PLANES][WEDGE_LANES];
        filter_line(filter, group, line, surface, signal, column);
        for (int lane = 0; lane < lanes; ++lane) {
            if (!has_surface(&filter->planes, filter->places, surface, group->at + lane)) continue;
            const float8 means = (float8)(column[0][lane], column[1][lane], column[2][lane], column[3][lane],
                                          column[4][lane], column[5][lane], column[6][lane], column[7][lane]);
            const int pixel = first + lane, id = pixel * WEDGE_SURFACES + surface;
            add_light(light + lane * WEDGE_PARTS, sums + id, reflected + id * WEDGE_SHADOW_LIGHTS, signal, means,
                      fmax(film[pixel].normal.w, 1.0f));
        }
    }
}

/* `signals`: what filter_x has made. `index`: place of `scale` in WEDGE_SCALE_WIDTHS. */
__kernel void filter_y(WEDGE_FILTER_PARAMS, __global const FilmPixel* restrict film,
                       __global const SurfaceSum* restrict sums,
                       __global const float4* restrict reflected,
                       __global HalfLight* restrict light, int index) {
    const Filter filter = WEDGE_FILTER_ARGS;
    const Group group = group_in_columns(&filter.planes, (int)get_global_id(0));
    if (!is_on_film(&filter.planes, &group)) return;
    const Line line = {group.y, height - 1 - group.y, 0, filter.planes.pitch};
    HalfLight result[WEDGE_LANES * WEDGE_PARTS];
    for (int i = 0; i < WEDGE_LANES * WEDGE_PARTS; ++i) result[i] = no_light();
    for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
        const float8 size = load8(&filter.planes, places,
                                  surface * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE, group.at);
        if (!lane_bits8(size > 0.0f)) break;
        filter_surface(&filter, &group, line, surface, film, sums, reflected, result);
    }
    __global HalfLight* first = light + (index * width * height + group.y * width + group.x) * WEDGE_PARTS;
    const int count = min(WEDGE_LANES, width - group.x) * WEDGE_PARTS;
    for (int i = 0; i < count; ++i) first[i] = result[i];
}
