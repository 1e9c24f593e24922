/* Axis-aligned filtering, between the sampling passes (path.cl) and the image:
     filter_surfaces   where each surface of a pixel was met
     filter_distances  probe samples' distances to the slopes or depths that decide frequencies
     filter_bandwidth  widths of filters and numbers of samples
     filter_means      sums over samples to what is filtered
     filter_x, filter_y   a Gaussian along rows, then along columns
     filter_combine    filtered signals times what was not filtered, texture and unshadowed light
   What is done with the result: guard.cl.
   Arrays: include/wedge/shared/filter.h. A mean holds both halves: two times rgb (of a light: irradiance with and
   without shadow) and w, the share of the pixel. */
#include "lib/signals.clh"
#include "wedge/shared/frame.h"

#define WEDGE_COS_SAME_SURFACE 0.98480775f /* 10 degrees */

__kernel void filter_surfaces(__global const FrameParams* restrict params,
                              __constant FilterSettings* settings,
                              __global const SurfaceSum* restrict sums,
                              __global FilterSurface* restrict surfaces, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    FilterSurface s;
    s.position = s.normal = (float4)(0.0f);
    const float samples = sums[id].position.w;
    if (samples > 0.0f) {
        const float3 p = sums[id].position.xyz / samples;
        const float3 to_eye = params->camera.position.xyz - p;
        const float distance = length(to_eye), normal_length = length(sums[id].normal.xyz);
        if (normal_length > 0.0f && distance > 0.0f) {
            const float3 n = sums[id].normal.xyz / normal_length;
            /* A surface seen edge-on is as long as its pixel is deep; a hundredth is enough. */
            const float cos_view = fmax(fabs(dot(n, to_eye)) / distance, 0.01f);
            const float face_on = distance * settings->pixel_angle;
            s.position = (float4)(p, face_on);
            s.normal = (float4)(n, face_on * rsqrt(cos_view));
        }
    }
    surfaces[id] = s;
}

/* found: x and y, of a light: least and largest slope; of the hemisphere: 1 / z_min and z_max. x < 0: nothing was
   found. */
__kernel void filter_distances(__global const DistanceRange* restrict distances,
                               __global float2* restrict found, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const DistanceRange d = distances[id];
    float2 result = (float2)(-1.0f, 0.0f);
    if (d.farthest > 0.0f) {
        if (id % WEDGE_SIGNALS < WEDGE_SHADOW_LIGHTS) {
            const float d1 = d.receiver / d.samples;
            result.x = fmax(d1 / d.farthest - 1.0f, 0.0f);
            result.y = fmax(d1 / fmax(d.nearest, 1e-6f * d1) - 1.0f, result.x);
        } else {
            result = (float2)(1.0f / fmax(d.nearest, 1e-6f * d.farthest), d.farthest);
        }
    }
    found[id] = result;
}

/* The surface of pixel q that is like surface p; -1: none. */
inline int same_surface(__global const FilterSurface* surfaces, FilterSurface p, int q) {
    for (int k = 0; k < WEDGE_SURFACES; ++k) {
        const FilterSurface s = surfaces[q * WEDGE_SURFACES + k];
        if (s.position.w > 0.0f && dot(p.normal.xyz, s.normal.xyz) >= WEDGE_COS_SAME_SURFACE)
            return q * WEDGE_SURFACES + k;
    }
    return -1;
}

/* Mean of what the neighbours within `radius` found; x < 0: none did. */
inline float2 mean_around(__global const FilterSurface* surfaces, __global const float2* found,
                          FilterSurface p, int x, int y, int width, int height, int signal,
                          int radius) {
    float2 sum = (float2)(0.0f);
    float count = 0.0f;
    for (int j = max(y - radius, 0); j <= min(y + radius, height - 1); ++j)
        for (int i = max(x - radius, 0); i <= min(x + radius, width - 1); ++i) {
            const int q = same_surface(surfaces, p, j * width + i);
            if (q < 0) continue;
            const float2 f = found[q * WEDGE_SIGNALS + signal];
            if (f.x < 0.0f) continue;
            sum += f;
            count += 1.0f;
        }
    return count > 0.0f ? sum / count : (float2)(-1.0f, 0.0f);
}

/* Probe samples that find no occluder say little about penumbrae near by: the pixel takes the mean of
   those of its neighbours that found one, as in the thesis, section 3.6. Nearest reflectors are a matter of luck
   with few samples: means over a few pixels vary less. */
#define NEIGHBOURHOOD_PX 5
#define SMOOTHING_PX 2

/* Standard deviation taken for a light's profile; a uniform one is as wide as its half side. */
inline float light_sigma(__global const Light* light) {
    const float u = length(light->edge_u.xyz), v = length(light->edge_v.xyz);
    if (light->edge_u.w > 0.0f) return light->edge_u.w * u;
    return 0.5f * sqrt(u * v);
}

/* x: width of the filter in world units, 0: not filtered; y: samples needed, +inf: as many as are allowed. */
inline float2 light_bandwidth(__constant FilterSettings* settings, __global const Light* light,
                              float2 slopes, float pixel) {
    if (slopes.x < 0.0f) return (float2)(0.0f);
    const float sigma = light_sigma(light);
    const float k = light->edge_u.w > 0.0f ? settings->k_gaussian : settings->k_uniform;
    const float width = shadow_filter_sigma(slopes.x, sigma, pixel, settings->mu,
                                            settings->alpha_direct, k);
    if (!(slopes.x > 0.0f)) return (float2)(width, INFINITY); /* an occluder that touches */
    return (float2)(width, shadow_sample_count(slopes.x, slopes.y, sigma, pixel, settings->mu,
                                               settings->alpha_direct));
}

/* The thesis keeps z_min from being less than a share of the scene. Here it is kept from being less than where the
   filter is as narrow as pixels let it be: nearer reflectors do not add frequencies. */
inline float2 hemisphere_bandwidth(__constant FilterSettings* settings, float2 found, float band,
                                   float share, float pixel) {
    const float mu = settings->mu, alpha = settings->alpha_indirect;
    const float far_away = 1e6f * pixel;
    const float z_min = fmax(found.x > 0.0f ? 1.0f / found.x : far_away, band * pixel / alpha);
    const float z_max = fmax(found.y, z_min);
    return (float2)(indirect_filter_sigma(z_min, band, pixel, mu, alpha),
                    indirect_sample_count(z_min, z_max, band, share, pixel, mu, alpha));
}

inline float2 signal_bandwidth(__constant FilterSettings* settings, __global const Light* lights,
                               __global const SurfaceSum* sum, int signal, float2 found,
                               float pixel) {
    if (signal < WEDGE_SHADOW_LIGHTS)
        return light_bandwidth(settings, lights + signal, found, pixel);
    if (signal == WEDGE_SIGNAL_DIFFUSE)
        return max_component(sum->diffuse.xyz) > 0.0f
                   ? hemisphere_bandwidth(settings, found, WEDGE_BAND_DIFFUSE, WEDGE_SHARE_DIFFUSE,
                                          pixel)
                   : (float2)(0.0f);
    const float samples = sum->position.w;
    return max_component(sum->specular.xyz) > 0.0f
               ? hemisphere_bandwidth(settings, found, sum->diffuse.w / samples,
                                      lobe_share(sum->normal.w / samples), pixel)
               : (float2)(0.0f);
}

/* Once it is known that a pixel goes on, all it has so far is its first half. */
inline void merge_halves(__global float4* sums, __global HalfLight* unfiltered) {
    for (int i = 0; i < WEDGE_SURFACES * WEDGE_SIGNALS; ++i) {
        sums[2 * i] += sums[2 * i + 1];
        sums[2 * i + 1] = (float4)(0.0f);
    }
    unfiltered->direct[0] += unfiltered->direct[1];
    unfiltered->indirect[0] += unfiltered->indirect[1];
    unfiltered->direct[1] = unfiltered->indirect[1] = (float4)(0.0f);
}

inline float mean_emission(__global const FilmPixel* p) {
    return luminance(p->emission.xyz) / fmax(p->position.w, 1.0f);
}

inline float mean_reflectance(__global const FilmPixel* p) {
    return luminance(p->albedo.xyz) / fmax(p->normal.w, 1.0f);
}

/* True if a pixel shows an edge: more than one surface, or a colour that is not its neighbours'. */
#define WEDGE_SAME_COLOUR 0.1f

inline bool shows_edge(__global const FilmPixel* film, __global const SurfaceSum* surfaces, int x,
                       int y, int width, int height) {
    const int id = y * width + x;
    if (surfaces[id * WEDGE_SURFACES].position.w != film[id].normal.w)
        return film[id].emission.w > 0.0f;
    const float e = mean_emission(film + id), r = mean_reflectance(film + id);
    for (int k = 0; k < 4; ++k) {
        const int i = x + (k == 0) - (k == 1), j = y + (k == 2) - (k == 3);
        if (i < 0 || i >= width || j < 0 || j >= height) continue;
        const float other_e = mean_emission(film + j * width + i), other_r = mean_reflectance(film + j * width + i);
        if (fabs(e - other_e) > WEDGE_SAME_COLOUR * fmax(e, other_e)) return true;
        if (fabs(r - other_r) > WEDGE_SAME_COLOUR * fmax(r, other_r)) return true;
    }
    return false;
}

/* sigmas: world units, 0 where nothing is to be filtered. sample_ends: x, samples each pixel is brought to, powers
   of two, which the sampler likes best; y: camera rays. */
__kernel void filter_bandwidth(__constant FilterSettings* settings,
                               __global const Light* restrict lights,
                               __global const FilmPixel* restrict film,
                               __global const SurfaceSum* restrict surface_sums,
                               __global const FilterSurface* restrict surfaces,
                               __global const float2* restrict found, __global float* restrict sigmas,
                               __global uint2* restrict sample_ends, __global float4* restrict sums,
                               __global HalfLight* restrict unfiltered, int width,
                               int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const int x = pixel % width, y = pixel / width;
    const float seen = fmax(film[pixel].normal.w, 1.0f);
    float samples = 0.0f;
    for (int k = 0; k < WEDGE_SURFACES; ++k) {
        const int id = pixel * WEDGE_SURFACES + k;
        const FilterSurface p = surfaces[id];
        float most = 0.0f;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            float2 bandwidth = (float2)(0.0f);
            if (p.position.w > 0.0f) {
                float2 f = found[id * WEDGE_SIGNALS + signal];
                if (signal < WEDGE_SHADOW_LIGHTS && f.x < 0.0f)
                    f = mean_around(surfaces, found, p, x, y, width, height, signal,
                                    NEIGHBOURHOOD_PX);
                else if (signal >= WEDGE_SHADOW_LIGHTS)
                    f = mean_around(surfaces, found, p, x, y, width, height, signal, SMOOTHING_PX);
                bandwidth = signal_bandwidth(settings, lights, surface_sums + id, signal, f, p.normal.w);
            }
            sigmas[id * WEDGE_SIGNALS + signal] = bandwidth.x;
            most = fmax(most, bandwidth.y);
        }
        if (most > 0.0f) samples += most * surface_sums[id].position.w / seen;
    }
    const float probes = (float)settings->probe_samples, cap = (float)settings->max_samples;
    const float least = (float)settings->least_samples;
    const float power = exp2(round(log2(clamp(samples, probes, cap))));
    const uint end = (uint)clamp(power, least, cap);
    const bool edge = shows_edge(film, surface_sums, x, y, width, height);
    sample_ends[pixel] = (uint2)(end, edge ? end * (uint)settings->camera_rays_at_edges : end);
    if (second_half(end, (uint)probes) >= (uint)probes)
        merge_halves(sums + pixel * WEDGE_SURFACES * WEDGE_SIGNALS * 2, unfiltered + pixel);
}

__kernel void filter_means(__global const HalfLight* restrict unfiltered,
                           __global const float4* restrict sums, __global float8* restrict means,
                           uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    __global const HalfLight* pixel = unfiltered + id / (WEDGE_SURFACES * WEDGE_SIGNALS);
    const float first = pixel->direct[0].w, second = pixel->direct[1].w;
    const float4 a = first > 0.0f ? sums[2 * id] / first : (float4)(0.0f);
    const float4 b = second > 0.0f ? sums[2 * id + 1] / second : a;
    means[id] = (float8)(a, b);
}

/* Weight of surface q for surface p: a Gaussian of their distance, for a light of that parallel to it, eq. 3.11,
   if they face the same way. The narrower of the two widths counts, so that sharp shadows do not leak. */
inline float filter_weight(FilterSurface p, __global const FilterSurface* q, float3 along,
                           float sigma) {
    if (dot(p.normal.xyz, q->normal.xyz) < WEDGE_COS_SAME_SURFACE) return 0.0f;
    const float3 d = q->position.xyz - p.position.xyz;
    const float off = dot(d, along);
    const float r2 = dot(d, d) - off * off, reach2 = 9.0f * sigma * sigma;
    return r2 < reach2 ? exp(-0.5f * r2 / (sigma * sigma)) : 0.0f;
}

/* Sum over the pixels first, first + stride, ... of one row or column, normalised. */
inline float8 filter_line(__global const FilterSurface* surfaces, __global const float* sigmas,
                          __global const float8* means, FilterSurface p, int id, int signal,
                          float3 along, float scale, int pixel, int stride, int before,
                          int after, int max_radius) {
    const float sigma = sigmas[id * WEDGE_SIGNALS + signal] * scale;
    float8 sum = means[id * WEDGE_SIGNALS + signal];
    if (!(sigma > 0.0f)) return sum;
    float weights = 1.0f;
    const int radius = min((int)ceil(3.0f * sigma / p.position.w), max_radius);
    for (int i = -min(radius, before); i <= min(radius, after); ++i) {
        if (i == 0) continue;
        const int q = (pixel + i * stride) * WEDGE_SURFACES;
        for (int k = q; k < q + WEDGE_SURFACES; ++k) {
            const float other = sigmas[k * WEDGE_SIGNALS + signal] * scale;
            if (!(other > 0.0f)) continue;
            const float w = filter_weight(p, surfaces + k, along, fmin(sigma, other));
            sum += w * means[k * WEDGE_SIGNALS + signal];
            weights += w;
        }
    }
    return sum / weights;
}

inline float3 filter_axis(__global const Light* lights, int signal) {
    return signal < WEDGE_SHADOW_LIGHTS ? lights[signal].normal.xyz : (float3)(0.0f);
}

#define FILTER_PARAMS                                                                              \
    __constant FilterSettings *settings, __global const Light *restrict lights,                    \
        __global const FilterSurface *restrict surfaces, __global const float *restrict sigmas,    \
        __global const float8 *restrict means, __global float8 *restrict filtered, int width,      \
        int height, float scale

__kernel void filter_x(FILTER_PARAMS) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const int x = pixel % width;
    for (int id = pixel * WEDGE_SURFACES; id < (pixel + 1) * WEDGE_SURFACES; ++id) {
        const FilterSurface p = surfaces[id];
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal)
            filtered[id * WEDGE_SIGNALS + signal] =
                filter_line(surfaces, sigmas, means, p, id, signal, filter_axis(lights, signal),
                            scale, pixel, 1, x, width - 1 - x, settings->max_radius_px);
    }
}

__kernel void filter_y(FILTER_PARAMS) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const int y = pixel / width;
    for (int id = pixel * WEDGE_SURFACES; id < (pixel + 1) * WEDGE_SURFACES; ++id) {
        const FilterSurface p = surfaces[id];
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal)
            filtered[id * WEDGE_SIGNALS + signal] =
                filter_line(surfaces, sigmas, means, p, id, signal, filter_axis(lights, signal),
                            scale, pixel, width, y, height - 1 - y, settings->max_radius_px);
    }
}

/* What the surfaces of a pixel make of filtered signals. */
inline HalfLight combine_surfaces(__global const SurfaceSum* sums, __global const float4* reflected,
                                  __global const float8* filtered, float samples) {
    HalfLight light;
    for (int h = 0; h < 2; ++h) light.direct[h] = light.indirect[h] = (float4)(0.0f);
    for (int k = 0; k < WEDGE_SURFACES; ++k) {
        if (!(sums[k].position.w > 0.0f)) continue;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            const float8 f = filtered[k * WEDGE_SIGNALS + signal];
            for (int h = 0; h < 2; ++h) {
                const float4 v = h == 0 ? f.s0123 : f.s4567;
                if (signal < WEDGE_SHADOW_LIGHTS) {
                    const float visibility = v.y > 0.0f ? v.x / v.y : 0.0f;
                    light.direct[h].xyz +=
                        reflected[k * WEDGE_SHADOW_LIGHTS + signal].xyz * (visibility / samples);
                } else if (v.w > 0.0f) {
                    const float3 colour = signal == WEDGE_SIGNAL_DIFFUSE ? sums[k].diffuse.xyz
                                                                         : sums[k].specular.xyz;
                    light.indirect[h].xyz += colour * v.xyz / (v.w * samples);
                }
            }
        }
    }
    return light;
}

__kernel void filter_combine(__global const FilmPixel* restrict film,
                             __global const SurfaceSum* restrict surface_sums,
                             __global const float4* restrict reflected,
                             __global const float8* restrict filtered,
                             __global HalfLight* restrict light, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const float samples = fmax(film[id].normal.w, 1.0f);
    light[id] = combine_surfaces(surface_sums + id * WEDGE_SURFACES,
                                 reflected + id * WEDGE_SURFACES * WEDGE_SHADOW_LIGHTS,
                                 filtered + id * WEDGE_SURFACES * WEDGE_SIGNALS, samples);
}
