/* Frequency analysis, between the probe and the adaptive samples (path.cl):
     filter_surfaces    where each surface of a pixel was met
     filter_distances   probe samples' distances to the slopes or depths that decide frequencies
     filter_brightness  sums over rows of the image so far
     filter_bandwidth   widths of filters and numbers of samples
     filter_merge_halves   the probe becomes a part of the first half, where more samples follow
   Arrays: include/wedge/shared/filter.h. */
#include "lib/filter_weight.clh"
#include "lib/signals.clh"
#include "wedge/shared/frame.h"

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

/* Variance from one sample to the next, unbiased, of whether a light is seen: at most 1/4. < 0: too few samples. */
inline float visibility_variance(float4 sums) {
    const float n = sums.w, seen = sums.x / sums.y;
    if (!(n > 1.0f)) return -1.0f;
    return sums.y > 0.0f ? seen * (1.0f - seen) * n / (n - 1.0f) : 0.0f;
}

/* The same of light from the hemisphere, told by the difference of two halves. */
inline float hemisphere_variance(float4 first, float4 second) {
    if (!(first.w > 0.0f && second.w > 0.0f)) return -1.0f;
    const float d = luminance(first.xyz) / first.w - luminance(second.xyz) / second.w;
    return d * d / (1.0f / first.w + 1.0f / second.w);
}

/* found: x and y, of a light: least and largest slope; of the hemisphere: 1 / z_min and z_max. x < 0: nothing was
   found. z: variance from one sample to the next, < 0: not known. */
__kernel void filter_distances(__global const DistanceRange* restrict distances,
                               __global const float4* restrict sums,
                               __global float4* restrict found, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const DistanceRange d = distances[id];
    float4 result = (float4)(-1.0f, 0.0f, -1.0f, 0.0f);
    result.z = id % WEDGE_SIGNALS < WEDGE_SHADOW_LIGHTS
                   ? visibility_variance(sums[2 * id] + sums[2 * id + 1])
                   : hemisphere_variance(sums[2 * id], sums[2 * id + 1]);
    if (d.farthest > 0.0f) {
        if (id % WEDGE_SIGNALS < WEDGE_SHADOW_LIGHTS) {
            const float d1 = d.receiver / d.samples;
            result.x = fmax(d1 / d.farthest - 1.0f, 0.0f);
            result.y = fmax(d1 / fmax(d.nearest, 1e-6f * d1) - 1.0f, result.x);
        } else {
            result.x = 1.0f / fmax(d.nearest, 1e-6f * d.farthest);
            result.y = d.farthest;
        }
    }
    found[id] = result;
}

/* The surface of pixel q that is like surface p; -1: none. */
inline int same_surface(__global const FilterSurface* surfaces, FilterSurface p, int q) {
    for (int k = 0; k < WEDGE_SURFACES; ++k) {
        const FilterSurface s = surfaces[q * WEDGE_SURFACES + k];
        if (s.position.w > 0.0f && is_same_surface(p, s))
            return q * WEDGE_SURFACES + k;
    }
    return -1;
}

/* What the pixels of a neighbourhood found, as far as they show surface p. */
typedef struct {
    __global const FilterSurface* surfaces;
    __global const float4* found;
    int x, y, width, height;
} Neighbours;

/* Mean over those within `radius` that found anything; x < 0: none did. */
inline float2 mean_found(const Neighbours* n, FilterSurface p, int signal, int radius) {
    float2 sum = (float2)(0.0f);
    float count = 0.0f;
    for (int j = max(n->y - radius, 0); j <= min(n->y + radius, n->height - 1); ++j) {
        const int row = j * n->width * WEDGE_SURFACES;
        const int first = row + max(n->x - radius, 0) * WEDGE_SURFACES;
        const int end = row + (min(n->x + radius, n->width - 1) + 1) * WEDGE_SURFACES;
        for (int q = first; q < end; ++q) {
            const float2 f = n->found[q * WEDGE_SIGNALS + signal].xy;
            if (f.x < 0.0f || !is_same_surface(p, n->surfaces[q])) continue;
            sum += f;
            count += 1.0f;
        }
    }
    return count > 0.0f ? sum / count : (float2)(-1.0f, 0.0f);
}

/* Mean over those within `radius` that know it; < 0: none does. */
inline float mean_variance(const Neighbours* n, FilterSurface p, int signal, int radius) {
    float sum = 0.0f, count = 0.0f;
    for (int j = max(n->y - radius, 0); j <= min(n->y + radius, n->height - 1); ++j)
        for (int i = max(n->x - radius, 0); i <= min(n->x + radius, n->width - 1); ++i) {
            const int q = same_surface(n->surfaces, p, j * n->width + i);
            if (q < 0) continue;
            const float variance = n->found[q * WEDGE_SIGNALS + signal].z;
            if (variance < 0.0f) continue;
            sum += variance;
            count += 1.0f;
        }
    return count > 0.0f ? sum / count : -1.0f;
}

/* Probe samples that find no occluder say little about penumbrae near by: the pixel takes the mean of
   those of its neighbours that found one, as in the thesis, section 3.6. Nearest reflectors are a matter of luck
   with few samples: means over a few pixels vary less. */
#define NEIGHBOURHOOD_PX 5
#define SMOOTHING_PX 2
#define VARIANCE_PX 1

inline float2 found_near(const Neighbours* n, FilterSurface p, int id, int signal) {
    if (signal >= WEDGE_SHADOW_LIGHTS) return mean_found(n, p, signal, SMOOTHING_PX);
    const float2 own = n->found[id * WEDGE_SIGNALS + signal].xy;
    return own.x < 0.0f ? mean_found(n, p, signal, NEIGHBOURHOOD_PX) : own;
}

/* Standard deviation taken for a light's profile; a uniform one is as wide as its half side. */
inline float light_sigma(__global const Light* light) {
    const float u = length(light->edge_u.xyz), v = length(light->edge_v.xyz);
    if (light->edge_u.w > 0.0f) return light->edge_u.w * u;
    return 0.5f * sqrt(u * v);
}

/* x: width of the filter in world units, 0: not filtered; y: samples needed. */
inline float2 light_bandwidth(__constant FilterSettings* settings, __global const Light* light,
                              float2 slopes, float pixel) {
    if (slopes.x < 0.0f) return (float2)(0.0f);
    const float sigma = light_sigma(light);
    const float k = light->edge_u.w > 0.0f ? settings->k_gaussian : settings->k_uniform;
    const float width = shadow_filter_sigma(slopes.x, sigma, pixel, settings->mu,
                                            settings->alpha_direct, k);
    if (!(slopes.x > 0.0f)) /* an occluder that touches */
        return (float2)(width, (float)settings->max_samples);
    return (float2)(width, shadow_sample_count(slopes.x, slopes.y, sigma, pixel,
                                                          settings->mu, settings->alpha_direct));
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

inline float mean_emission(__global const FilmPixel* p) {
    return luminance(p->emission.xyz) / fmax(p->position.w, 1.0f);
}

inline float mean_reflectance(__global const FilmPixel* p) {
    return luminance(p->albedo.xyz) / fmax(p->normal.w, 1.0f);
}

/* Radiance of a pixel as sampled so far. */
inline float brightness(__global const FilmPixel* p) {
    return mean_emission(p) + luminance(p->direct.xyz + p->indirect.xyz) / fmax(p->direct.w, 1.0f);
}

__kernel void filter_brightness(__global const FilmPixel* restrict film, __global float* restrict rows,
                                int width, int height) {
    const int y = (int)get_global_id(0);
    if (y >= height) return;
    float sum = 0.0f;
    for (int x = 0; x < width; ++x) sum += brightness(film + y * width + x);
    rows[y] = sum;
}

/* True if a pixel shows an edge: more than one surface, or a colour that is not its neighbours'. */
#define WEDGE_SAME_COLOUR 0.1f

inline bool differs(float a, float b) { return fabs(a - b) > WEDGE_SAME_COLOUR * fmax(a, b); }

/* Largest difference of brightness to the next pixels, if there is an edge; else 0. */
inline float edge_contrast(__global const FilmPixel* film, __global const SurfaceSum* sums,
                           const Neighbours* n) {
    const int id = n->y * n->width + n->x;
    const FilterSurface p = n->surfaces[id * WEDGE_SURFACES];
    bool edge = sums[id * WEDGE_SURFACES].position.w != film[id].normal.w;
    const float e = mean_emission(film + id), r = mean_reflectance(film + id);
    const float b = brightness(film + id);
    float contrast = 0.0f;
    for (int k = 0; k < 4; ++k) {
        const int i = n->x + (k == 0) - (k == 1), j = n->y + (k == 2) - (k == 3);
        if (i < 0 || i >= n->width || j < 0 || j >= n->height) continue;
        __global const FilmPixel* other = film + j * n->width + i;
        edge = edge || (p.position.w > 0.0f && same_surface(n->surfaces, p, j * n->width + i) < 0);
        edge = edge || differs(e, mean_emission(other)) || differs(r, mean_reflectance(other));
        contrast = fmax(contrast, fabs(b - brightness(other)));
    }
    return edge ? contrast : 0.0f;
}

/* Camera rays of a pixel. What they are for is the noise of coverage, whose square falls with n^-1.5 under a
   low-discrepancy sequence and rises with the square of the contrast C: for a given number of rays in all, the
   sum of squares is least with n proportional to C^(2 / 2.5). The noise of what is filtered falls about with 1 / mu. */
#define WEDGE_MOST_CAMERA_RAYS 4096.0f

inline uint camera_rays(__constant FilterSettings* settings, float contrast, float mean_brightness) {
    if (!(contrast > 0.0f && mean_brightness > 0.0f)) return 0u;
    const float n = (float)settings->camera_rays_at_edges * pow(settings->mu, 4.0f / 3.0f) *
                    pow(contrast / mean_brightness, 0.8f);
    return (uint)exp2(round(log2(clamp(n, 1.0f, WEDGE_MOST_CAMERA_RAYS))));
}

/* Variance, from one sample to the next, of the radiance that a signal makes of a pixel. */
inline float radiance_variance(__global const SurfaceSum* sum, __global const float4* reflected,
                               int signal, float variance) {
    const float3 colour = signal < WEDGE_SHADOW_LIGHTS     ? reflected[signal].xyz
                          : signal == WEDGE_SIGNAL_DIFFUSE ? sum->diffuse.xyz
                                                           : sum->specular.xyz;
    const float scale = luminance(colour) / sum->position.w;
    return variance * scale * scale;
}

/* The theory's number of samples keeps light of full contrast from aliasing. It is scaled by the contrast that there
   is: four times the variance as a share of the square of what counts as bright, since a light that half of the
   samples see has a variance of a quarter. It does not know noise: where filters shrink with mu, that of few
   samples would grow, so there are as many as keep it below a share of brightness that shrinks with mu, too. */
#define WEDGE_NOISE 0.01f /* for mu = 1 */

inline float noise_samples(float mu, float relative_variance, float pixels) {
    const float noise = WEDGE_NOISE / mu;
    return relative_variance / (fmax(pixels, 1.0f) * noise * noise);
}

/* Variance, from one sample to the next, of radiance that is not filtered: mean over 3x3 pixels. */
inline float rest_variance(__global const HalfLight* unfiltered, const Neighbours* n) {
    float sum = 0.0f, count = 0.0f;
    for (int j = max(n->y - 1, 0); j <= min(n->y + 1, n->height - 1); ++j)
        for (int i = max(n->x - 1, 0); i <= min(n->x + 1, n->width - 1); ++i) {
            __global const HalfLight* u = unfiltered + j * n->width + i;
            const float n0 = u->direct[0].w, n1 = u->direct[1].w;
            if (!(n0 > 0.0f && n1 > 0.0f)) continue;
            const float d = u->indirect[0].w / n0 - u->indirect[1].w / n1;
            sum += d * d / (1.0f / n0 + 1.0f / n1);
            count += 1.0f;
        }
    return count > 0.0f ? sum / count : 0.0f;
}

/* sigmas: world units, 0 where nothing is to be filtered. sample_ends: x, samples each pixel is brought to, powers
   of two, which the sampler likes best; y: camera rays. */
__kernel void filter_bandwidth(__constant FilterSettings* settings,
                               __global const Light* restrict lights,
                               __global const FilmPixel* restrict film,
                               __global const SurfaceSum* restrict surface_sums,
                               __global const FilterSurface* restrict surfaces,
                               __global const float4* restrict found, __global const float4* restrict reflected,
                               __global float* restrict sigmas, __global uint2* restrict sample_ends,
                               __global const HalfLight* restrict unfiltered, int width, int height,
                               float mean_brightness) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const int x = pixel % width, y = pixel / width;
    const Neighbours neighbours = {surfaces, found, x, y, width, height};
    const float seen = fmax(film[pixel].normal.w, 1.0f);
    const float own = brightness(film + pixel);
    const float bright = fmax(own * own + mean_brightness * mean_brightness, 1e-30f);
    float samples = 0.0f;
    for (int k = 0; k < WEDGE_SURFACES; ++k) {
        const int id = pixel * WEDGE_SURFACES + k;
        const FilterSurface p = surfaces[id];
        float most = 0.0f;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            float2 bandwidth = (float2)(0.0f);
            if (p.position.w > 0.0f)
                bandwidth = signal_bandwidth(settings, lights, surface_sums + id, signal,
                                             found_near(&neighbours, p, id, signal), p.normal.w);
            sigmas[id * WEDGE_SIGNALS + signal] = bandwidth.x;
            if (!(bandwidth.y > 0.0f)) continue;
            const float variance = mean_variance(&neighbours, p, signal, VARIANCE_PX);
            const float relative = radiance_variance(surface_sums + id, reflected + id * WEDGE_SHADOW_LIGHTS,
                                                     signal, fmax(variance, 0.0f)) / bright;
            if (!(relative > 0.0f)) continue;
            const float pixels =
                4.0f * WEDGE_PI * bandwidth.x * bandwidth.x / (p.position.w * p.normal.w);
            most = fmax(most, fmin(4.0f * relative, 1.0f) * bandwidth.y);
            most = fmax(most, noise_samples(settings->mu, relative, pixels));
        }
        if (most > 0.0f) samples += most * surface_sums[id].position.w / seen;
    }
    samples = fmax(samples, noise_samples(settings->mu, rest_variance(unfiltered, &neighbours) / bright, 1.0f));
    const float probes = (float)settings->probe_samples, cap = (float)settings->max_samples;
    const float least = (float)settings->least_samples;
    const float power = exp2(round(log2(clamp(samples, probes, cap))));
    const uint end = (uint)clamp(power, least, cap);
    const float contrast = edge_contrast(film, surface_sums, &neighbours);
    sample_ends[pixel] = (uint2)(end, max(end, camera_rays(settings, contrast, mean_brightness)));
}

/* Once it is known that a pixel goes on, all it has so far is its first half. */
__kernel void filter_merge_halves(__constant FilterSettings* settings,
                                  __global const uint2* restrict sample_ends,
                                  __global float4* restrict sums,
                                  __global HalfLight* restrict unfiltered, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const uint probes = (uint)settings->probe_samples;
    if (second_half(sample_ends[id].x, probes) < probes) return;
    __global float4* s = sums + id * WEDGE_SURFACES * WEDGE_SIGNALS * 2;
    for (int i = 0; i < WEDGE_SURFACES * WEDGE_SIGNALS; ++i) {
        s[2 * i] += s[2 * i + 1];
        s[2 * i + 1] = (float4)(0.0f);
    }
    __global HalfLight* u = unfiltered + id;
    u->direct[0] += u->direct[1];
    u->indirect[0] += u->indirect[1];
    u->direct[1] = u->indirect[1] = (float4)(0.0f);
}
