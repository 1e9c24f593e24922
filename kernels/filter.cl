/* Axis-aligned filtering, between the sampling passes (path.cl) and the image:
     filter_flat       unshadowed light of flat pixels, free of noise, and hues of shadows
     filter_means      sums over samples to what is filtered
     filter_x, filter_y   lines fitted along rows, then along columns, by Gaussian weights; after the latter, filtered
                       signals times what was not filtered, texture and unshadowed light
     filter_none       the same without a filter
   Widths are those of bandwidth.cl. What is done with the result: guard.cl.
   Arrays: include/wedge/shared/filter.h; places, sigmas and means in planes. Filters work on eight pixels side by side
   (lib/planes.clh). */
#include "lib/coverage.clh"
#include "lib/filter_weight.clh"
#include "lib/flat_light.clh"
#include "lib/line_fit.clh"
#include "lib/remainder.clh"
#include "lib/signals.clh"
#include "wedge/shared/frame.h"

inline bool has_surface(const Planes* planes, __global const float* places, int surface, ulong at) {
    return places[(surface * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE) * planes->size + at] > 0.0f;
}

/* Of a group's pixels. */
inline bool any_surface(const Planes* planes, __global const float* places, int surface, ulong at) {
    const float8 size = load8(planes, places, surface * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE, at);
    return lane_bits8(size > 0.0f);
}

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

inline float8 over_or_none(float8 above, float8 below) {
    return keep_lanes(above / below, below > 0.0f);
}

/* What a group's colours are multiplied by to be light: rgb of the first half of samples, then of the second. Where none
   of a half's samples met the surface, the other half stands in. */
inline void shares_of_light(const Means8* m, float shares[6][WEDGE_LANES]) {
    const int8 first = m->v1 > 0.0f, second = m->v3 > 0.0f;
    const float8 half0 = over_or_none(first ? m->v0 : m->v2, first ? m->v1 : m->v3);
    const float8 half1 = over_or_none(second ? m->v2 : m->v0, second ? m->v3 : m->v1);
    for (int c = 0; c < 3; ++c) {
        vstore8(half0, 0, shares[c]);
        vstore8(half1, 0, shares[3 + c]);
    }
}

inline void shares_of_hemisphere(const Means8* m, float shares[6][WEDGE_LANES]) {
    const int8 first = m->v3 > 0.0f, second = m->v7 > 0.0f;
    const float8 all0 = first ? m->v3 : m->v7, all1 = second ? m->v7 : m->v3;
    vstore8(over_or_none(first ? m->v0 : m->v4, all0), 0, shares[0]);
    vstore8(over_or_none(first ? m->v1 : m->v5, all0), 0, shares[1]);
    vstore8(over_or_none(first ? m->v2 : m->v6, all0), 0, shares[2]);
    vstore8(over_or_none(second ? m->v4 : m->v0, all1), 0, shares[3]);
    vstore8(over_or_none(second ? m->v5 : m->v1, all1), 0, shares[4]);
    vstore8(over_or_none(second ? m->v6 : m->v2, all1), 0, shares[5]);
}

/* Sums over the samples of pixels, by entries of surfaces where not by pixels. */
typedef struct {
    __global const FilmPixel* film;
    __global const SurfaceSum* surfaces;
    __global const uint* more;
    __global const float4* reflected;
    __global const float* corrections; /* of `reflected` of first surfaces */
    __global const Remainder* remainders;
} PixelSums;

inline float3 colour_of(const PixelSums* sums, int pixel, int entry, int signal) {
    if (is_light(signal)) {
        const float3 light = sums->reflected[reflected_at((uint)entry, (uint)signal)].xyz;
        return entry == pixel ? light * sums->corrections[correction_at((uint)pixel, (uint)signal)] : light;
    }
    return is_lobe(signal) ? sums->surfaces[entry].specular.xyz : sums->surfaces[entry].diffuse.xyz;
}

/* `share` of light, of one half, as it differs by hue. */
inline float3 with_hue(const PixelSums* sums, int pixel, int entry, int signal, int half_index, float3 share) {
#ifdef WEDGE_SHADOW_HUES
    if (!is_light(signal)) return share;
    const float3 hue = entry == pixel
                           ? kept_hue(sums->corrections + correction_at((uint)pixel, (uint)signal), half_index)
                           : shadow_hue(sums->reflected + reflected_at((uint)entry, (uint)signal), half_index);
    return limited_hue(share, hue);
#else
    return share;
#endif
}

/* Adds what a surface makes of its means to the parts of a group's pixels. */
inline void add_light(const Planes* planes, __global const float* places, const Group* group, int surface,
                      int signal, const Means8* means, const PixelSums* sums, HalfLight* light) {
    float shares[6][WEDGE_LANES];
    if (is_light(signal))
        shares_of_light(means, shares);
    else
        shares_of_hemisphere(means, shares);
    const int first = group->y * planes->width + group->x, lanes = min(WEDGE_LANES, planes->width - group->x);
    for (int lane = 0; lane < lanes; ++lane) {
        if (!has_surface(planes, places, surface, group->at + lane)) continue;
        const int pixel = first + lane;
        const int entry = surface_entry(sums->more, planes->width * planes->height, pixel, surface);
        if (entry < 0) continue;
        const float3 colour = colour_of(sums, pixel, entry, signal) / fmax(sums->film[pixel].normal.w, 1.0f);
        float4* halves =
            light[lane * WEDGE_PARTS + (is_direct(signal) ? WEDGE_PART_DIRECT : WEDGE_PART_INDIRECT)].halves;
        const float3 share0 = {shares[0][lane], shares[1][lane], shares[2][lane]};
        const float3 share1 = {shares[3][lane], shares[4][lane], shares[5][lane]};
        halves[0].xyz += colour * with_hue(sums, pixel, entry, signal, 0, share0);
        halves[1].xyz += colour * with_hue(sums, pixel, entry, signal, 1, share1);
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

/* The same of all other lights. */
inline void add_sampled_others(HalfLight* light, __global const float4* sums, __global const SurfaceSum* surface,
                               float samples) {
    const float4 half0 = sums[0].w > 0.0f ? sums[0] : sums[1], half1 = sums[1].w > 0.0f ? sums[1] : sums[0];
    if (!(half0.w > 0.0f)) return;
    light->halves[0].w += luminance(surface->diffuse.xyz * half0.xyz) / (half0.w * samples);
    light->halves[1].w += luminance(surface->diffuse.xyz * half1.xyz) / (half1.w * samples);
}

/* Light of a group's pixels that no filter changes; only those that show more than one surface have any. */
inline void begin_light(const Planes* planes, const Group* group, const PixelSums* sums, HalfLight* light) {
    const int first = group->y * planes->width + group->x, pixels = planes->width * planes->height;
    for (int i = 0; i < WEDGE_LANES * WEDGE_PARTS; ++i) light[i] = no_light();
    for (int lane = 0; lane < min(WEDGE_LANES, planes->width - group->x); ++lane) {
        const int pixel = first + lane;
        if (surface_entry(sums->more, pixels, pixel, 1) < 0) continue;
        __global const Remainder* remainder = sums->remainders + pixel;
        if (!(remainder->direct.w > 0.0f)) continue;
        add_remainder_light(light + lane * WEDGE_PARTS, remainder,
                            remainder_share(sums->film, sums->surfaces, sums->more, pixels, pixel));
    }
}

/* Of a group's pixels, to where scale `index` keeps them. */
inline void store_light(const Planes* planes, const Group* group, const HalfLight* result,
                        __global HalfLight* light, int index) {
    const int pixels = planes->width * planes->height, first = group->y * planes->width + group->x;
    __global HalfLight* to = light + (index * pixels + first) * WEDGE_PARTS;
    const int count = min(WEDGE_LANES, planes->width - group->x) * WEDGE_PARTS;
    for (int i = 0; i < count; ++i) to[i] = result[i];
}

/* HalfLight's w of a group's pixels; `signal_sums`: of signals, by halves. */
inline void add_sampled(const Planes* planes, const Group* group, const PixelSums* sums,
                        __global const float4* signal_sums, HalfLight* light) {
    const int first = group->y * planes->width + group->x, lanes = min(WEDGE_LANES, planes->width - group->x);
    for (int lane = 0; lane < lanes; ++lane) {
        const int pixel = first + lane;
        HalfLight* parts = light + lane * WEDGE_PARTS;
        const float samples = fmax(sums->film[pixel].normal.w, 1.0f);
        for (int surface = 0; surface < WEDGE_SURFACES; ++surface) {
            const int id = surface_entry(sums->more, planes->width * planes->height, pixel, surface);
            if (id < 0) break;
            __global const float4* of_surface = signal_sums + 2u * (uint)id * WEDGE_SIGNALS;
            __global const SurfaceSum* surface_sum = sums->surfaces + id;
            for (int signal = 0; signal < WEDGE_SHADOW_LIGHTS; ++signal)
                add_sampled_light(parts + WEDGE_PART_DIRECT, of_surface + 2 * signal, surface_sum, samples);
            if (WEDGE_DIRECT_SIGNALS > WEDGE_SHADOW_LIGHTS)
                add_sampled_others(parts + WEDGE_PART_DIRECT, of_surface + 2 * WEDGE_SIGNAL_OTHERS, surface_sum,
                                   samples);
        }
        if (WEDGE_SIGNALS > WEDGE_DIRECT_SIGNALS)
            for (int h = 0; h < 2; ++h) {
                float4* half_light = parts[WEDGE_PART_INDIRECT].halves + h;
                half_light->w = luminance(half_light->xyz);
            }
    }
}

/* By luminance, of the mean of both halves. */
inline float part_luminance(const HalfLight* light) {
    return 0.5f * luminance(light->halves[0].xyz + light->halves[1].xyz);
}

/* Notes what a surface has added to the light of a group's pixels. */
inline void note_places(const Planes* planes, const Group* group, const PixelSums* sums, int surface,
                        const HalfLight* light, PlaceSums* noted) {
    const int first = group->y * planes->width + group->x, lanes = min(WEDGE_LANES, planes->width - group->x);
    for (int lane = 0; lane < lanes; ++lane) {
        const int pixel = first + lane, pixels = planes->width * planes->height;
        const int entry = surface_entry(sums->more, pixels, pixel, surface);
        if (entry < 0) continue;
        __global const SurfaceSum* s = sums->surfaces + entry;
        const float share = s->position.w / fmax(sums->film[pixel].normal.w, 1.0f), uneven = unevenness(s);
        for (int part = lane * WEDGE_PARTS; part < (lane + 1) * WEDGE_PARTS; ++part)
            add_places(noted + part, part_luminance(light + part), share, uneven);
    }
}

/* The same of remainders, which come first. */
inline void begin_places(const Planes* planes, const Group* group, const PixelSums* sums,
                         const HalfLight* light, PlaceSums* noted) {
    const int first = group->y * planes->width + group->x, pixels = planes->width * planes->height;
    const PlaceSums none = {0.0f, 0.0f};
    for (int part = 0; part < WEDGE_LANES * WEDGE_PARTS; ++part) {
        noted[part] = none;
        const float radiance = part_luminance(light + part);
        if (!(radiance > 0.0f)) continue;
        const float share =
            remainder_share(sums->film, sums->surfaces, sums->more, pixels, first + part / WEDGE_PARTS);
        add_places(noted + part, radiance, share, 1.0f);
    }
}

inline void store_coverage(const Planes* planes, const Group* group, const PixelSums* sums,
                           const PlaceSums* noted, __global float* coverage) {
    const int first = group->y * planes->width + group->x, lanes = min(WEDGE_LANES, planes->width - group->x);
    for (int part = 0; part < lanes * WEDGE_PARTS; ++part) {
        __global const FilmPixel* film = sums->film + first + part / WEDGE_PARTS;
        coverage[first * WEDGE_PARTS + part] = coverage_noise(noted[part], film->direct.w, film->normal.w);
    }
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
