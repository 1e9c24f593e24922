/* Path tracing: the plain Monte Carlo estimate of the light that reaches every pixel, unbiased for
   paths of up to `bounces` indirect bounces. One work-item owns one pixel and sums its samples in
   order.

   At each vertex one light is sampled (next-event estimation); where the path goes on anyway, light
   that the ray happens to meet counts too, both weighted by the balance heuristic (Veach 1997,
   eq. 9.8).

   WEDGE_SPECULAR, WEDGE_TEXTURES: compiled in only where the scene has them.
   WEDGE_LIGHT_RAYS: where paths end at the first hit, how often each looks at the lights.
   WEDGE_SHADOW_LIGHTS, WEDGE_FILTER_OTHER_LIGHTS, WEDGE_FILTER_HEMISPHERE: signals that are kept for
   filtering (lib/signals.clh, filter.cl), beside the plain estimate. WEDGE_POINT_LIGHTS_ALONE: these
   are all the lights that are not filtered one by one.

   WEDGE_REPLAY: each vertex is written down, for looking at a single pixel. */
#include "lib/film.clh"
#include "lib/path.clh"
#include "wedge/shared/frame.h"

inline Ray camera_ray(const CameraRays* camera, float2 film_px) {
    Ray ray;
    ray.origin = camera->position.xyz;
    ray.direction = normalize(camera->corner.xyz + camera->step_x.xyz * film_px.x +
                              camera->step_y.xyz * film_px.y);
    ray.t_max = INFINITY;
    ray.source = WEDGE_NO_PRIMITIVE;
    return ray;
}

WEDGE_ALWAYS_INLINE PathResult trace_path(const Scene* scene, __global const FrameParams* params, Ray ray,
                             float3 view_axis,
                             const Sampler* sampler WEDGE_SIGNAL_PARAMS WEDGE_REPLAY_PARAMS) {
    Path p;
    begin_path(&p, ray WEDGE_SIGNAL_ARG WEDGE_REPLAY_ARG);
    const float3 background = params->background.xyz;
    const int bounces = params->bounces;
    for (int depth = 0; depth <= bounces + 1; ++depth) {
        p.result.rays += 1;
        const Hit hit = trace_closest(scene->tree, p.ray);
        if (hit.primitive == WEDGE_NO_PRIMITIVE) {
            meet_background(&p, depth, background);
            WEDGE_IF_REPLAY(record_miss(p.result.record + depth, p.ray.direction, share_so_far(&p, depth),
                                        background);)
            break;
        }
        const float3 wo = -p.ray.direction;
        const Surface s = surface_at(scene, hit, wo);
        const float3 emitted = meet_emission(scene, &p, &s, depth);
        const Bsdf f = bsdf_at(scene, &s);
        if (depth == 0) {
            meet_first_hit(&p, &s, &f, hit.t * dot(p.ray.direction, view_axis));
            if (!keep_first_hit(scene, &p, &s, &f, sampler, hit.t)) break;
        } else if (depth == 1) {
            note_reflector(&p, hit.t);
        }
        WEDGE_IF_REPLAY(const float3 so_far = share_so_far(&p, depth);)
        if (depth > bounces) {
            WEDGE_IF_REPLAY(record_hit(p.result.record + depth, hit.t, s.position, s.normal, so_far,
                                       emitted, (float3)(0.0f), s.primitive, s.material);)
            break;
        }

        /* The last vertex goes on only to look for light that sampling finds badly or never. */
        const bool goes_on =
            depth < bounces || f.specular_chance > 0.0f || params->search_lights != 0;
        const float2 choice =
            goes_on || (WEDGE_LIGHT_RAYS == 1 && scene->light_count > 1)
                ? draw_2d(sampler, vertex_dimension(depth, WEDGE_VERTEX_CHOICE))
                : (float2)(0.0f);
        const float3 direct = look_for_light(scene, &p, &s, &f, wo, sampler, depth, choice.x, goes_on);
        if (depth == 0)
            p.result.direct += direct;
        else
            p.arriving += p.throughput * direct;
        WEDGE_IF_REPLAY(record_hit(p.result.record + depth, hit.t, s.position, s.normal, so_far,
                                   emitted, direct, s.primitive, s.material);)
        if (!goes_on || !scatter(&p, &s, &f, wo, sampler, depth, choice.y)) break;
    }
    end_path(&p);
    return p.result;
}

#if WEDGE_SIGNALS > 0
inline bool is_power_of_two(uint x) {
    return (x & (x - 1u)) == 0u;
}

inline void add_unfiltered(const PixelSignals* signals, const PathResult* r) {
    /* In this order it is 0, and not a rounding error, where all light is filtered. */
    const float3 rest = (r->direct - r->filtered_direct) + (r->indirect - r->filtered_indirect);
    if (!fits_film(r->filtered_direct + r->filtered_indirect + rest)) return;
    /* Of the remainder another estimate is taken, too, if only with filtered light. */
    const bool direct_remains = r->remains && WEDGE_DIRECT_SIGNALS > 0;
    const bool indirect_remains = r->remains && WEDGE_SIGNALS > WEDGE_DIRECT_SIGNALS;
    __global SampledLight* sums = signals->unfiltered;
    sums->direct[signals->half_index] += (float4)(direct_remains ? r->direct : r->filtered_direct, 1.0f);
    sums->indirect[signals->half_index] +=
        (float4)(indirect_remains ? r->indirect : r->filtered_indirect, 0.0f);
    if (is_power_of_two(signals->sample)) sums->rest.yz = sums->rest.xy;
    sums->rest.x += luminance(rest);
    if (signals->half_index == 1) sums->rest.w += luminance(rest);
}

/* What sample `sample` of the pixel is for. False: nothing, the pixel has it or does not want it. */
WEDGE_ALWAYS_INLINE bool begin_sample(PixelSignals* signals, SampleEnds ends, uint sample) {
    signals->camera_only = sample >= ends.paths;
    signals->known = sample < ends.camera_rays_before;
    if (signals->camera_only ? signals->known : sample < ends.paths_before) return false;
    signals->sample = sample;
    signals->half_index = sample & 1u;
    signals->probing_lights = signals->probing && sample < WEDGE_LIGHT_PROBES;
    return true;
}
#endif

WEDGE_ALWAYS_INLINE void add_path(FilmPixel* sum, const PathResult* r WEDGE_SIGNAL_PARAMS) {
#if WEDGE_SIGNALS > 0
    const bool is_new_ray = !signals->known;
    if (signals->camera_only) {
        add_camera_sample(sum, r->emission, r->rays);
    } else {
        add_sample(sum, r->emission, r->direct, r->indirect, r->rays, is_new_ray ? 1.0f : 0.0f);
        add_unfiltered(signals, r);
    }
#else
    const bool is_new_ray = true;
    add_sample(sum, r->emission, r->direct, r->indirect, r->rays, 1.0f);
#endif
    if (is_new_ray) add_first_hit(sum, r->hit, r->albedo, r->depth, r->normal, r->position);
}

/* Adds samples [first_sample, first_sample + sample_count) to the pixels [first_pixel, first_pixel
   + pixel_count) of the crop, counted along its rows; with filters, to those of pixel_list, and what
   sample_ends says they lack. Both sample numbers are multiples of WEDGE_SAMPLE_BATCH: sums are
   taken batch by batch, so that any split of the samples into launches adds up alike. WEDGE_REPLAY:
   `record` takes (bounces + 2) vertices a sample, zeroed before; one pixel at a time. */
__kernel void trace_paths(__global const FrameParams* restrict params, WEDGE_SCENE_PARAMS,
                          __global FilmPixel* restrict film, uint first_pixel, uint pixel_count,
                          uint first_sample,
                          uint sample_count WEDGE_SIGNAL_KERNEL_PARAMS WEDGE_REPLAY_PARAMS) {
    const uint id = get_global_id(0);
    if (id >= pixel_count) return;
    const Scene scene = WEDGE_SCENE_ARGS;
    const CameraRays camera = params->camera;
    const float3 view_axis = normalize(cross(camera.step_x.xyz, camera.step_y.xyz));
#if WEDGE_SIGNALS > 0
    const uint pixel = pixel_list[first_pixel + id];
#else
    const uint pixel = first_pixel + id;
#endif
    const uint x = (uint)params->crop_x + pixel % (uint)params->crop_width;
    const uint y = (uint)params->crop_y + pixel / (uint)params->crop_width;
    const uint code = morton_code(x, y);

#if WEDGE_SIGNALS > 0
    const SampleEnds ends = sample_ends[pixel];
    const uint end = min(first_sample + sample_count, max(ends.paths, ends.camera_rays));
    sample_count = end > first_sample ? end - first_sample : 0u;
    PixelSignals signals = {.surfaces = all_surfaces,
                            .more = more_surfaces,
                            .pixels = params->crop_width * params->crop_height,
                            .pixel = (int)pixel,
                            .sums = all_sums,
                            .distances = all_distances,
                            .reflected = all_reflected,
                            .unfiltered = all_unfiltered + pixel,
                            .remainder = all_remainders + pixel,
                            .pixel_angle = filter_settings->pixel_angle,
                            .least_samples = least_surface_samples(filter_settings->mu, ends.paths),
                            .probing = probing};
#endif
    for (uint batch = 0; batch < sample_count; batch += WEDGE_SAMPLE_BATCH) {
        FilmPixel sum = empty_film_pixel();
        for (uint i = 0; i < WEDGE_SAMPLE_BATCH && batch + i < sample_count; ++i) {
            const uint sample = first_sample + batch + i;
#if WEDGE_SIGNALS > 0
            if (!begin_sample(&signals, ends, sample)) continue;
            const Sampler whole = make_sampler(params->sampler, params->seed, 1,
                                               (uint)params->strata, code, sample);
            signals.whole = &whole;
#endif
            const Sampler sampler =
                make_sampler(params->sampler, params->seed, params->sequences,
                             (uint)params->strata, code, sample);
            const float2 jitter =
                draw_film(&sampler, params->seed, params->sequences, code, sample);
            const Ray ray = camera_ray(&camera, (float2)((float)x + jitter.x, (float)y + jitter.y));
            const PathResult r =
                trace_path(&scene, params, ray, view_axis,
                           &sampler WEDGE_SIGNAL_ARGS WEDGE_IF_REPLAY(
                               , record + (batch + i) * (uint)(params->bounces + 2)));
            add_path(&sum, &r WEDGE_SIGNAL_ARGS);
        }
        film[pixel] = sum_film_pixels(film[pixel], sum);
    }
}
