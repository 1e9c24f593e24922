/* Axis-aligned filtering of soft shadows, between the sampling passes (path.cl) and the image:
     shadow_geometry   where each pixel's samples met the scene
     shadow_bandwidth  filter widths and sample counts from the probe samples' distances
     shadow_filter_x, shadow_filter_y   visibility as a ratio of filtered irradiances, times what was not
                       filtered: texture and unshadowed irradiance
   Buffers with an entry for each light hold pixel * lights + light. */
#include "lib/bandwidth.clh"
#include "lib/geometry.clh"
#include "wedge/shared/frame.h"
#include "wedge/shared/scene.h"
#include "wedge/shared/shadow.h"

#define LIGHTS WEDGE_SHADOW_LIGHTS
#define WEDGE_COS_SAME_SURFACE 0.98480775f /* 10 degrees */

__kernel void shadow_geometry(__global const FrameParams* restrict params,
                              __constant ShadowSettings* settings,
                              __global const FilmPixel* restrict film,
                              __global GeometryPixel* restrict geometry, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    GeometryPixel g;
    g.position = g.normal = (float4)(0.0f);
    const float hits = film[id].emission.w;
    if (hits > 0.0f) {
        const float3 p = film[id].position.xyz / hits;
        const float3 to_eye = params->camera.position.xyz - p;
        const float distance = length(to_eye);
        const float3 sum = film[id].normal.xyz;
        const float sum_length = length(sum);
        if (sum_length > 0.0f && distance > 0.0f) {
            const float3 n = sum / sum_length;
            /* A surface seen edge-on is as long as its pixel is deep; a hundredth is enough. */
            const float cos_view = fmax(fabs(dot(n, to_eye)) / distance, 0.01f);
            const float face_on = distance * settings->pixel_angle;
            g.position = (float4)(p, face_on);
            g.normal = (float4)(n, face_on * rsqrt(cos_view));
        }
    }
    geometry[id] = g;
}

/* Standard deviation taken for a light's profile; a uniform one is as wide as its half side. */
inline float light_sigma(__global const Light* light) {
    const float u = length(light->edge_u.xyz), v = length(light->edge_v.xyz);
    if (light->edge_u.w > 0.0f) return light->edge_u.w * u;
    return 0.5f * sqrt(u * v);
}

/* Slopes of the occluders that a pixel's probe samples found; false: none. */
inline bool occluder_slopes(__global const ShadowPixel* s, float probes, float* s_min, float* s_max) {
    if (!(s->farthest > 0.0f)) return false;
    const float d1 = s->distance / probes;
    *s_min = fmax(d1 / s->farthest - 1.0f, 0.0f);
    *s_max = fmax(d1 / fmax(s->nearest, 1e-6f * d1) - 1.0f, *s_min);
    return true;
}

/* Probe samples that find no occluder say little about penumbrae near by: the pixel takes the mean of
   those of its neighbours that found one, as in the thesis, section 3.6. */
#define NEIGHBOURHOOD_PX 5
#define NEIGHBOUR_STEP_PX 1

inline bool neighbour_slopes(__global const ShadowPixel* shadows,
                             __global const GeometryPixel* geometry, int x, int y, int width,
                             int height, int light, float probes, float* s_min, float* s_max) {
    const float3 n = geometry[y * width + x].normal.xyz;
    float found = 0.0f, sum_min = 0.0f, largest = 0.0f;
    for (int j = max(y - NEIGHBOURHOOD_PX, 0); j <= min(y + NEIGHBOURHOOD_PX, height - 1);
         j += NEIGHBOUR_STEP_PX)
        for (int i = max(x - NEIGHBOURHOOD_PX, 0); i <= min(x + NEIGHBOURHOOD_PX, width - 1);
             i += NEIGHBOUR_STEP_PX) {
            const int q = j * width + i;
            float a, b;
            if (dot(n, geometry[q].normal.xyz) < WEDGE_COS_SAME_SURFACE) continue;
            if (!occluder_slopes(shadows + q * LIGHTS + light, probes, &a, &b)) continue;
            found += 1.0f;
            sum_min += a;
            largest = fmax(largest, b);
        }
    if (found == 0.0f) return false;
    *s_min = sum_min / found;
    *s_max = largest;
    return true;
}

/* True if a pixel or its border to a neighbour shows more than one smooth surface: there it is the edge,
   not the shadow, that asks for samples. */
inline bool shows_edge(__global const FilmPixel* film, __global const GeometryPixel* geometry, int x,
                       int y, int width, int height) {
    const int id = y * width + x;
    const float samples = film[id].direct.w + film[id].square.w, hits = film[id].emission.w;
    if (hits < samples && hits > 0.0f) return true;
    if (hits == 0.0f) return false;
    if (length(film[id].normal.xyz) < WEDGE_COS_SAME_SURFACE * hits) return true;
    const GeometryPixel p = geometry[id];
    for (int k = 0; k < 4; ++k) {
        const int i = x + (k == 0) - (k == 1), j = y + (k == 2) - (k == 3);
        if (i < 0 || i >= width || j < 0 || j >= height) continue;
        const GeometryPixel q = geometry[j * width + i];
        if (!(q.normal.w > 0.0f)) return true;
        if (dot(p.normal.xyz, q.normal.xyz) < WEDGE_COS_SAME_SURFACE) return true;
        /* out of the plane of this one by more than a pixel is wide */
        if (fabs(dot(q.position.xyz - p.position.xyz, p.normal.xyz)) > p.position.w) return true;
    }
    return false;
}

/* sigmas: world units, 0 where nothing is to be filtered. sample_ends: samples each pixel is brought to. */
__kernel void shadow_bandwidth(__constant ShadowSettings* settings,
                               __global const Light* restrict lights,
                               __global const FilmPixel* restrict film,
                               __global const ShadowPixel* restrict shadows,
                               __global const GeometryPixel* restrict geometry,
                               __global float* restrict sigmas, __global uint* restrict sample_ends,
                               int width, int height) {
    const int id = (int)get_global_id(0);
    if (id >= width * height) return;
    const float pixel = geometry[id].normal.w, probes = (float)settings->probe_samples;
    float samples = probes;
    if (shows_edge(film, geometry, id % width, id / width, width, height))
        samples = fmax(samples, settings->mu * settings->edge_samples);
    for (int l = 0; l < LIGHTS; ++l) {
        float s_min, s_max, sigma = 0.0f;
        const bool occluded =
            pixel > 0.0f &&
            (occluder_slopes(shadows + id * LIGHTS + l, probes, &s_min, &s_max) ||
             neighbour_slopes(shadows, geometry, id % width, id / width, width, height, l, probes,
                              &s_min, &s_max));
        if (occluded) {
            const float width_of_light = light_sigma(lights + l);
            const float k =
                lights[l].edge_u.w > 0.0f ? settings->k_gaussian : settings->k_uniform;
            sigma = shadow_filter_sigma(s_min, width_of_light, pixel, settings->mu, settings->alpha, k);
            /* s_min = 0, an occluder that touches: as many samples as are allowed. */
            const float n = s_min > 0.0f ? shadow_sample_count(s_min, s_max, width_of_light, pixel,
                                                               settings->mu, settings->alpha)
                                         : INFINITY;
            samples = fmax(samples, n);
        }
        sigmas[id * LIGHTS + l] = sigma;
    }
    sample_ends[id] = (uint)ceil(fmin(samples, (float)settings->max_samples));
}

/* Weight of pixel q for pixel p: a Gaussian of the distance parallel to the light's plane, eq. 3.11, if both
   see the same surface. The narrower of the two widths counts, so that sharp shadows do not leak. */
inline float filter_weight(const GeometryPixel* p, __global const GeometryPixel* q, float3 light_normal,
                           float sigma_p, float sigma_q) {
    if (!(sigma_q > 0.0f) || dot(p->normal.xyz, q->normal.xyz) < WEDGE_COS_SAME_SURFACE) return 0.0f;
    const float sigma = fmin(sigma_p, sigma_q);
    const float3 d = q->position.xyz - p->position.xyz;
    const float along = dot(d, light_normal);
    const float r2 = dot(d, d) - along * along;
    const float reach = 3.0f * sigma;
    return r2 < reach * reach ? exp(-0.5f * r2 / (sigma * sigma)) : 0.0f;
}

/* Mean over a pixel's samples: shadowed and unshadowed irradiance. */
inline float2 pixel_irradiance(__global const ShadowPixel* s, float samples) {
    return samples > 0.0f ? (float2)(s->shadowed, s->reflected.w) / samples : (float2)(0.0f);
}

inline int filter_radius(const GeometryPixel* p, float sigma, __constant ShadowSettings* settings) {
    return min((int)ceil(3.0f * sigma / p->position.w), settings->max_radius_px);
}

/* Along rows. filtered: shadowed and unshadowed irradiance, not normalised, and the sum of weights. */
__kernel void shadow_filter_x(__constant ShadowSettings* settings,
                              __global const Light* restrict lights,
                              __global const FilmPixel* restrict film,
                              __global const ShadowPixel* restrict shadows,
                              __global const GeometryPixel* restrict geometry,
                              __global const float* restrict sigmas,
                              __global float2* restrict filtered, int width, int height) {
    const int id = (int)get_global_id(0);
    if (id >= width * height) return;
    const int x = id % width, row = id - x;
    const GeometryPixel p = geometry[id];
    for (int l = 0; l < LIGHTS; ++l) {
        const float sigma = sigmas[id * LIGHTS + l];
        float2 sum = pixel_irradiance(shadows + id * LIGHTS + l, film[id].direct.w);
        float weights = 1.0f;
        if (sigma > 0.0f) {
            const float3 normal = lights[l].normal.xyz;
            const int radius = filter_radius(&p, sigma, settings);
            for (int i = max(x - radius, 0); i <= min(x + radius, width - 1); ++i) {
                const int q = row + i;
                if (q == id) continue;
                const float w =
                    filter_weight(&p, geometry + q, normal, sigma, sigmas[q * LIGHTS + l]);
                sum += w * pixel_irradiance(shadows + q * LIGHTS + l, film[q].direct.w);
                weights += w;
            }
        }
        filtered[id * LIGHTS + l] = sum / weights;
    }
}

/* Along columns, and the result: rgb radiance. */
__kernel void shadow_filter_y(__constant ShadowSettings* settings,
                              __global const Light* restrict lights,
                              __global const FilmPixel* restrict film,
                              __global const ShadowPixel* restrict shadows,
                              __global const GeometryPixel* restrict geometry,
                              __global const float* restrict sigmas,
                              __global const float2* restrict filtered,
                              __global float4* restrict result, int width, int height) {
    const int id = (int)get_global_id(0);
    if (id >= width * height) return;
    const int x = id % width, y = id / width;
    const GeometryPixel p = geometry[id];
    const float samples = film[id].direct.w;
    float3 radiance = (float3)(0.0f);
    for (int l = 0; l < LIGHTS; ++l) {
        const float sigma = sigmas[id * LIGHTS + l];
        float2 sum = filtered[id * LIGHTS + l];
        if (sigma > 0.0f) {
            const float3 normal = lights[l].normal.xyz;
            const int radius = filter_radius(&p, sigma, settings);
            for (int j = max(y - radius, 0); j <= min(y + radius, height - 1); ++j) {
                const int q = j * width + x;
                if (q == id) continue;
                sum += filter_weight(&p, geometry + q, normal, sigma, sigmas[q * LIGHTS + l]) *
                       filtered[q * LIGHTS + l];
            }
        }
        const float visibility = sum.y > 0.0f ? sum.x / sum.y : 0.0f;
        if (samples > 0.0f)
            radiance += shadows[id * LIGHTS + l].reflected.xyz * (visibility / samples);
    }
    result[id] = (float4)(radiance, 0.0f);
}
