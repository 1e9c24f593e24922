/* The sampling routines of kernels/lib, laid open for the tests in tests/render. */
#include "lib/bandwidth.clh"
#include "lib/coverage.clh"
#include "lib/filter_weight.clh"
#include "lib/light.clh"
#include "lib/random.clh"
#include "lib/shadow_hue.clh"
#include "lib/thin_things.clh"

__kernel void draw_points(int kind, uint seed, int sequences, uint strata, uint pixel, uint first_sample,
                          uint dimension, uint count, __global float2* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const uint sample = first_sample + id;
    const Sampler s = make_sampler(kind, seed, sequences, strata, pixel, sample);
    out[id] = dimension == WEDGE_DIMENSION_FILM ? draw_film(&s, seed, sequences, pixel, sample)
                                                : draw_2d(&s, dimension);
}

/* `parts` in the place of each sample. */
__kernel void draw_parts(int kind, uint seed, int sequences, uint strata, uint pixel, uint parts,
                         uint dimension, uint count, __global float2* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const Sampler s = make_sampler(kind, seed, sequences, strata, pixel, id / parts);
    const SampleParts p = sample_parts(&s, parts, dimension);
    out[id] = draw_part(&p, id % parts);
}

/* parameters: diffuse (grey), specular (grey), exponent, model; normal is +z. */
inline Bsdf test_bsdf(float4 parameters) {
    Bsdf f;
    f.diffuse = (float3)(parameters.x);
    f.specular = (float3)(parameters.y);
    f.exponent = parameters.z;
    f.model = (int)parameters.w;
    set_specular_chance(&f);
    return f;
}

__kernel void sample_bsdf_directions(float4 parameters, float4 wo, uint seed, uint count,
                                     __global float4* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const Bsdf f = test_bsdf(parameters);
    const Sampler s = make_sampler(WEDGE_SAMPLER_HASH, seed, 1, 1u, 0u, id);
    const float3 n = (float3)(0.0f, 0.0f, 1.0f);
    const float3 wi = sample_bsdf(&f, n, wo.xyz, draw_2d(&s, 0).x, draw_2d(&s, 1));
    float pdf;
    const float3 value = eval_bsdf(&f, n, wo.xyz, wi, &pdf);
    out[id] = (float4)(wi, pdf > 0.0f ? value.x * wi.z / pdf : 0.0f);
}

/* out: value, pdf */
__kernel void eval_bsdf_directions(float4 parameters, float4 wo, __global const float4* wi,
                                   uint count, __global float2* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const Bsdf f = test_bsdf(parameters);
    float pdf;
    const float3 value = eval_bsdf(&f, (float3)(0.0f, 0.0f, 1.0f), wo.xyz, wi[id].xyz, &pdf);
    out[id] = (float2)(value.x, pdf);
}

/* out: position, pdf */
__kernel void sample_light_points(__global const Light* lights, uint light_count, float4 from, uint seed, uint count,
                                  __global float4* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    Scene scene; /* sampling a light reads nothing but the lights */
    scene.lights = lights;
    scene.light_count = light_count;
    const Sampler s = make_sampler(WEDGE_SAMPLER_HASH, seed, 1, 1u, 0u, id);
    const LightSample light = sample_light(&scene, 0, from.xyz, draw_2d(&s, 0).x, draw_2d(&s, 1));
    out[id] = (float4)(light.position, light.pdf);
}

/* in: z_min, z_max, band, pixel; settings: mu, alpha, share. out: filter sigma, samples */
__kernel void eval_indirect_bandwidth(__global const float4* in, float4 settings, uint count,
                                      __global float2* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const float4 p = in[id];
    out[id] = (float2)(indirect_filter_sigma(p.x, p.z, p.w, settings.x, settings.y),
                       indirect_sample_count(p.x, p.y, p.z, settings.z, p.w, settings.x, settings.y));
}

/* out: Omega_h and share of the hemisphere of lobes with exponents `in`, for WEDGE_MODEL_* `model` */
__kernel void eval_lobe_band(__global const float4* in, int model, uint count,
                             __global float2* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    out[id] = (float2)(lobe_band(model, in[id].x), lobe_share(in[id].x));
}

/* in: s_min, s_max, light sigma, pixel; settings: mu, alpha, k. out: filter sigma, samples */
__kernel void eval_shadow_bandwidth(__global const float4* in, float4 settings, uint count,
                                    __global float2* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const float4 p = in[id];
    out[id] = (float2)(
        shadow_filter_sigma(p.x, p.z, p.w, settings.x, settings.y, settings.z),
        shadow_sample_count(p.x, p.y, p.z, p.w, settings.x, settings.y));
}

__kernel void eval_samples_granted(__global const float4* in, uint count, __global float* out) {
    const uint id = get_global_id(0);
    if (id < count) out[id] = samples_granted(in[id].x, in[id].y);
}

inline Places8 place8(float4 position, float4 normal, float pixel) {
    const Places8 p = {position.x, position.y, position.z, pixel, normal.x, normal.y, normal.z};
    return p;
}

/* in: position, width of the filter; normal. Weights of each for the first; `along`: normal of a light, 0: none. */
__kernel void eval_filter_weights(__global const float4* positions, __global const float4* normals,
                                  float4 along, float4 middle, float pixel, uint count, __global float4* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const Places8 p = place8(positions[0], normals[0], pixel), q = place8(positions[id], normals[id], pixel);
    const Cast8 cast = length(along.xyz) > 0.0f ? cast8(&p, along.xyz, middle.xyz) : no_cast8();
    out[id] = (float4)(filter_weight8(&p, positions[0].w, &q, positions[id].w, &cast).s5);
}

/* in: colour and irradiance, both grey, of camera rays, `each` of them on one surface after another. surfaces: all 0.
   out: noise of so many paths beyond that of the rays. */
__kernel void eval_coverage_noise(__global const float4* in, uint count, uint each, __global SurfaceSum* surfaces,
                                  uint paths, __global float* out) {
    PlaceSums sums = {0.0f, 0.0f};
    for (uint i = 0; i < count; ++i) {
        __global SurfaceSum* s = surfaces + i / each;
        s->position.w += 1.0f;
        s->diffuse.xyz += (float3)(in[i].x);
        s->specular.w += in[i].x * in[i].x;
        if ((i + 1) % each > 0 && i + 1 < count) continue;
        const float light = luminance(s->diffuse.xyz) * in[i].y / (float)count;
        add_places(&sums, sums.light + light, s->position.w / (float)count, unevenness(s));
    }
    out[0] = coverage_noise(sums, (float)paths, (float)count);
}

/* Whether places are on one surface with that at 0, whose normal is y. */
__kernel void eval_is_level(__global const float4* positions, float pixel, uint count, __global float* out) {
    const uint id = get_global_id(0);
    if (id < count) out[id] = is_level(positions[id].xyz, (float3)(0.0f, 1.0f, 0.0f), pixel) ? 1.0f : 0.0f;
}

/* in: turn; cosine; y, x. out: sine and cosine; arc_cosine4; arc_of4 */
__kernel void eval_angles(__global const float4* in, uint count, __global float4* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const float4 v = in[id];
    out[id] = (float4)(sine_cosine(v.x), arc_cosine4(v.y).x, arc_of4(v.z, v.w).x);
}

__kernel void eval_erf_and_exp(__global const float4* in, uint count, __global float2* out) {
    const uint id = get_global_id(0);
    if (id < count) out[id] = (float2)(inverse_erf(in[id].x), falling_exp(in[id].y));
}

/* rays: light that reaches a surface if nothing hides it, w: number of the half, and 2 more where it is seen. sums: 0
   before. out: by how much a share of both halves' light differs. */
__kernel void eval_shadow_hues(__global const float4* rays, uint ray_count, __global float4* sums, float share,
                               uint count, __global float4* out) {
    if (get_global_id(0) > 0) return;
    for (uint i = 0; i < ray_count; ++i) {
        const int bits = (int)rays[i].w;
        add_shadow_hue(sums, bits & 1, bits >= 2, rays[i].xyz);
    }
    for (uint half_index = 0; half_index < count; ++half_index)
        out[half_index] = (float4)(limited_hue((float3)(share), shadow_hue(sums, (int)half_index)) / share, 0.0f);
}

/* sizes: of a pixel face-on, along the surface; largest coordinate of the eye. */
__kernel void eval_is_in_front(__global const float4* things, __global const float4* places,
                               __global const float4* normals, __global const float4* sizes, uint count,
                               __global float* out) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    const float4 s = sizes[id];
    out[id] = is_in_front(things[id].xyz, places[id].xyz, normals[id].xyz, s.x, s.y, s.z) ? 1.0f : 0.0f;
}
