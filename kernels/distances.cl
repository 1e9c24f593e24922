/* What the probe (path.cl) met, made ready for frequency analysis (bandwidth.cl):
     filter_thin_things what it may have missed
     filter_surfaces    where each surface of a pixel was met
     filter_distances   probe samples' distances to the slopes or depths that decide frequencies
     filter_neighbours  the same, of pixels that found nothing or little from those around them
   Arrays: include/wedge/shared/filter.h; places and found in planes. */
#include "lib/filter_weight.clh"
#include "lib/probe_planes.clh"
#include "lib/signals.clh"
#include "lib/thin_things.clh"
#include "wedge/shared/frame.h"

/* Work-items: entries of a list of triangles, from `first` on. nearness: by pixel of the crop, one over
   the depth of the nearest thin thing, as bits of a float; 0 before. The camera does not move: this is
   needed once. */
__kernel void filter_thin_things(__global const FrameParams* restrict params,
                                 __global const ShadingVertex* restrict vertices,
                                 __global const ShadingTriangle* restrict triangles,
                                 __global const uint* restrict list,
                                 volatile __global uint* restrict nearness, uint first, uint end) {
    const uint id = first + get_global_id(0);
    if (id >= end) return;
    const ShadingTriangle t = triangles[list[id]];
    const float3 corners[3] = {vertex_position(vertices + t.v0), vertex_position(vertices + t.v1),
                               vertex_position(vertices + t.v2)};
    const View view = view_of(params);
    mark_if_thin(&view, nearness, corners);
}

inline void set_place(const Planes* planes, __global float* places, int surface, ulong at,
                      float3 position, float3 normal, float size, float slanted_size) {
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_X, at) = position.x;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_Y, at) = position.y;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_Z, at) = position.z;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_SIZE, at) = size;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_NX, at) = normal.x;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_NY, at) = normal.y;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_NZ, at) = normal.z;
    WEDGE_PLACE(planes, places, surface, WEDGE_PLACE_SLANTED_SIZE, at) = slanted_size;
}

__kernel void filter_surfaces(__global const FrameParams* restrict params,
                              __constant FilterSettings* settings,
                              __global const SurfaceSum* restrict sums,
                              __global const uint* restrict more, __global float* restrict places,
                              int width, int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const ulong at = pixel_at(&planes, pixel % width, pixel / width);
    for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
        const int entry = surface_entry(more, width * height, pixel, surface);
        if (entry < 0) break;
        __global const SurfaceSum* sum = sums + entry;
        if (!(sum->position.w > 0.0f)) break;
        const float3 p = sum->position.xyz / sum->position.w;
        const float3 to_eye = params->camera.position.xyz - p;
        const float distance = length(to_eye), normal_length = length(sum->normal.xyz);
        if (!(normal_length > 0.0f && distance > 0.0f)) break;
        const float3 n = sum->normal.xyz / normal_length;
        /* A surface seen edge-on is as long as its pixel is deep; a hundredth is enough. */
        const float cos_view = fmax(fabs(dot(n, to_eye)) / distance, 0.01f);
        const float face_on = distance * settings->pixel_angle;
        set_place(&planes, places, surface, at, p, n, face_on, face_on * rsqrt(cos_view));
    }
}

/* Variance from one sample to the next, unbiased, of whether a light is seen: at most 1/4. Below 0:
   too few samples, or all of them black. */
inline float visibility_variance(float4 sums) {
    const float n = sums.w, seen = sums.x / sums.y;
    if (!(n > 1.0f && sums.y > 0.0f)) return -1.0f;
    return seen * (1.0f - seen) * n / (n - 1.0f);
}

/* The same of light from the hemisphere, told by the difference of two halves. */
inline float hemisphere_variance(float4 first, float4 second) {
    if (!(first.w > 0.0f && second.w > 0.0f)) return -1.0f;
    const float d = luminance(first.xyz) / first.w - luminance(second.xyz) / second.w;
    return d * d / (1.0f / first.w + 1.0f / second.w);
}

/* WEDGE_FOUND_*. */
inline float3 find(const DistanceRange d, float4 first, float4 second, int signal) {
    float3 found = (float3)(-1.0f, 0.0f, -1.0f);
    found.z = is_light(signal) ? visibility_variance(first + second) : hemisphere_variance(first, second);
    if (!(d.farthest > 0.0f)) return found;
    if (is_light(signal)) {
        const float d1 = d.receiver / d.samples;
        found.x = fmax(d1 / d.farthest - 1.0f, 0.0f);
        found.y = fmax(d1 / fmax(d.nearest, 1e-6f * d1) - 1.0f, found.x);
    } else {
        found.x = 1.0f / fmax(d.nearest, 1e-6f * d.farthest);
        found.y = d.farthest;
    }
    return found;
}
__kernel void filter_distances(__global const DistanceRange* restrict distances,
                               __global const float4* restrict sums,
                               __global const uint* restrict more, __global float* restrict found,
                               int width, int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const ulong at = pixel_at(&planes, pixel % width, pixel / width);
    for (int entry = 0; entry < WEDGE_SURFACES * WEDGE_SIGNALS; ++entry) {
        const int signal = entry % WEDGE_SIGNALS;
        const int surface = surface_entry(more, width * height, pixel, entry / WEDGE_SIGNALS);
        float3 f = (float3)(-1.0f, 0.0f, -1.0f);
        if (surface >= 0) {
            const uint id = (uint)surface * WEDGE_SIGNALS + (uint)signal;
            f = find(distances[id], sums[2u * id], sums[2u * id + 1u], signal);
        }
        WEDGE_FOUND(&planes, found, entry, WEDGE_FOUND_LEAST, at) = f.x;
        WEDGE_FOUND(&planes, found, entry, WEDGE_FOUND_MOST, at) = f.y;
        WEDGE_FOUND(&planes, found, entry, WEDGE_FOUND_VARIANCE, at) = f.z;
    }
}

/* What a group's pixels and those around them found. */
typedef struct {
    __global const float *places, *found;
    Planes planes;
    Group group;
} Neighbours;

/* Probe samples that find no occluder say little about penumbrae near by: the pixel takes the mean
   of those of its neighbours that found one, as in the thesis, section 3.6. Nearest reflectors are
   a matter of luck with few samples: means over a few pixels vary less. */
#define WEDGE_NEIGHBOURHOOD_PX 5
#define WEDGE_SMOOTHING_PX 2
#define WEDGE_VARIANCE_PX 1

/* Sums over pixels that show a surface, of those numbers that are known. */
typedef struct {
    float8 least, most, found, variance, varied;
} FoundSums;

inline void add_variance(FoundSums* sums, float8 variance, int8 is_same) {
    const int8 is_known = is_same & (variance >= 0.0f);
    sums->variance += keep_lanes(variance, is_known);
    sums->varied += keep_lanes((float8)(1.0f), is_known);
}

inline void add_found(FoundSums* sums, float8 least, float8 most, int8 is_same) {
    const int8 is_known = is_same & (least >= 0.0f);
    sums->least += keep_lanes(least, is_known);
    sums->most += keep_lanes(most, is_known);
    sums->found += keep_lanes((float8)(1.0f), is_known);
}

inline float8 load_found(const Neighbours* n, int surface, int signal, int what, ulong at) {
    return load8(&n->planes, n->found,
                 (surface * WEDGE_SIGNALS + signal) * WEDGE_FOUND_PLANES + what, at);
}

/* What pixels a step of (i, j) away found, as far as they show surface p. */
inline void add_step(const Neighbours* n, const Places8* p, int i, int j,
                     FoundSums sums[WEDGE_SIGNALS]) {
    const ulong at = n->group.at + (ulong)((long)j * n->planes.pitch + i);
    const int8 on_film = is_on_row(&n->planes, &n->group, i);
    for (int other = 0; other < WEDGE_SURFACES; ++other) {
        const Places8 q = load_places8(&n->planes, n->places, other, at);
        const int8 is_there = on_film & (q.size > 0.0f);
        if (!lane_bits8(is_there)) return;
        const int8 is_same = is_there & is_same_surface8(p, &q);
        for (int s = 0; s < WEDGE_SIGNALS; ++s) {
            if (max(abs(i), abs(j)) <= WEDGE_VARIANCE_PX)
                add_variance(sums + s, load_found(n, other, s, WEDGE_FOUND_VARIANCE, at), is_same);
            if (!is_light(s))
                add_found(sums + s, load_found(n, other, s, WEDGE_FOUND_LEAST, at),
                          load_found(n, other, s, WEDGE_FOUND_MOST, at), is_same);
        }
    }
}

/* True if a row of the neighbourhood, `at` in its middle, found anything on such surfaces. Three times
   eight pixels are all of it. */
inline bool is_any_found(const Neighbours* n, int surface, int signal, ulong at) {
    const float8 left = load_found(n, surface, signal, WEDGE_FOUND_LEAST, at - WEDGE_NEIGHBOURHOOD_PX);
    const float8 right = load_found(n, surface, signal, WEDGE_FOUND_LEAST, at + WEDGE_NEIGHBOURHOOD_PX);
    const float8 middle = load_found(n, surface, signal, WEDGE_FOUND_LEAST, at);
    return lane_bits8((left >= 0.0f) | (middle >= 0.0f) | (right >= 0.0f));
}

inline void add_row(const Neighbours* n, const Places8* p, int signal, int other, ulong row,
                    FoundSums* sums) {
    for (int i = -WEDGE_NEIGHBOURHOOD_PX; i <= WEDGE_NEIGHBOURHOOD_PX; ++i) {
        const ulong at = row + (ulong)(long)i;
        const float8 least = load_found(n, other, signal, WEDGE_FOUND_LEAST, at);
        const int8 is_known = is_on_row(&n->planes, &n->group, i) & (least >= 0.0f);
        if (!lane_bits8(is_known)) continue;
        const Places8 q = load_places8(&n->planes, n->places, other, at);
        const int8 is_same = is_known & (q.size > 0.0f) & is_same_surface8(p, &q);
        add_found(sums, least, load_found(n, other, signal, WEDGE_FOUND_MOST, at), is_same);
    }
}

/* Of a light, over the whole neighbourhood. Most of it mostly found nothing. */
inline void add_neighbourhood(const Neighbours* n, const Places8* p, int signal, FoundSums* sums) {
    const int above = min(n->group.y, WEDGE_NEIGHBOURHOOD_PX);
    const int below = min(n->planes.height - 1 - n->group.y, WEDGE_NEIGHBOURHOOD_PX);
    for (int j = -above; j <= below; ++j) {
        const ulong row = n->group.at + (ulong)((long)j * n->planes.pitch);
        for (int other = 0; other < WEDGE_SURFACES; ++other)
            if (is_any_found(n, other, signal, row)) add_row(n, p, signal, other, row, sums);
    }
}

/* Lights keep what the pixel itself found. */
inline void store_near_by(const Neighbours* n, const Places8* p, int surface, int signal,
                          FoundSums* sums, __global float* near_by) {
    const Planes* planes = &n->planes;
    const ulong at = n->group.at;
    const float8 own = load_found(n, surface, signal, WEDGE_FOUND_LEAST, at);
    const int8 keeps = is_light(signal) ? own >= 0.0f : (int8)(0);
    if (is_light(signal) && lane_bits8(~keeps & (p->size > 0.0f)))
        add_neighbourhood(n, p, signal, sums);
    const int8 is_found = sums->found > 0.0f;
    const float8 least = is_found ? sums->least / sums->found : (float8)(-1.0f);
    const float8 most = is_found ? sums->most / sums->found : (float8)(0.0f);
    const int first = (surface * WEDGE_SIGNALS + signal) * WEDGE_FOUND_PLANES;
    store8(keeps ? own : least, planes, near_by, first + WEDGE_FOUND_LEAST, at);
    store8(keeps ? load_found(n, surface, signal, WEDGE_FOUND_MOST, at) : most, planes, near_by,
           first + WEDGE_FOUND_MOST, at);
    store8(sums->varied > 0.0f ? sums->variance / sums->varied : (float8)(-1.0f), planes, near_by,
           first + WEDGE_FOUND_VARIANCE, at);
}

/* True in lanes where a pixel beside the group's, on the film, does not show surface p. */
inline int8 ends_here(const Neighbours* n, const Places8* p) {
    int8 ends = 0;
    for (int k = 0; k < 4; ++k) {
        const int i = (k == 0) - (k == 1), j = (k == 2) - (k == 3);
        if (n->group.y + j < 0 || n->group.y + j >= n->planes.height) continue;
        const ulong at = n->group.at + (ulong)((long)j * n->planes.pitch + i);
        int8 goes_on = 0;
        for (int other = 0; other < WEDGE_SURFACES; ++other) {
            const Places8 q = load_places8(&n->planes, n->places, other, at);
            if (!lane_bits8(q.size > 0.0f)) break;
            goes_on |= (q.size > 0.0f) & is_same_surface8(p, &q);
        }
        ends |= is_on_row(&n->planes, &n->group, i) & ~goes_on;
    }
    return ends & (p->size > 0.0f);
}

/* near_by: as `found`, of the pixel or its neighbourhood. ends: 1 where a pixel's first surface
   does not go on. */
__kernel void filter_neighbours(__global const float* restrict places,
                                __global const float* restrict found,
                                __global float* restrict near_by, __global float* restrict ends,
                                int width, int height) {
    Neighbours n = {places, found, make_planes(width, height)};
    n.group = group_in_rows(&n.planes, (int)get_global_id(0));
    if (!is_on_film(&n.planes, &n.group)) return;
    const int radius = WEDGE_SIGNALS > WEDGE_SHADOW_LIGHTS ? WEDGE_SMOOTHING_PX : WEDGE_VARIANCE_PX;
    const int above = min(n.group.y, radius), below = min(height - 1 - n.group.y, radius);
    for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
        const Places8 p = load_places8(&n.planes, places, surface, n.group.at);
        if (surface == 0)
            store8(ends_here(&n, &p) ? (float8)(1.0f) : (float8)(0.0f), &n.planes, ends, 0,
                   n.group.at);
        if (!lane_bits8(p.size > 0.0f)) break;
        FoundSums sums[WEDGE_SIGNALS];
        for (int s = 0; s < WEDGE_SIGNALS; ++s)
            sums[s].least = sums[s].most = sums[s].found = sums[s].variance = sums[s].varied = 0.0f;
        for (int j = -above; j <= below; ++j)
            for (int i = -radius; i <= radius; ++i) add_step(&n, &p, i, j, sums);
        for (int s = 0; s < WEDGE_SIGNALS; ++s)
            store_near_by(&n, &p, surface, s, sums + s, near_by);
    }
}
