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
#include "lib/direct_light.clh"
#include "lib/film.clh"
#include "lib/light.clh"
#include "lib/random.clh"
#include "lib/remainder.clh"
#include "lib/replay.clh"
#include "lib/shadow_light.clh"
#include "wedge/shared/frame.h"

typedef struct {
    float3 emission, direct, indirect;
    float3 albedo, normal, position;
    float depth;
    float hit; /* 1 if the camera ray met anything */
    uint rays;
#if WEDGE_SIGNALS > 0
    float3 filtered_direct, filtered_indirect; /* what filters take the place of */
    bool remains; /* it met the pixel's remainder */
#endif
    WEDGE_REPLAY_FIELD
} PathResult;

inline Ray camera_ray(const CameraRays* camera, float2 film_px) {
    Ray ray;
    ray.origin = camera->position.xyz;
    ray.direction = normalize(camera->corner.xyz + camera->step_x.xyz * film_px.x +
                              camera->step_y.xyz * film_px.y);
    ray.t_max = INFINITY;
    ray.source = WEDGE_NO_PRIMITIVE;
    return ray;
}

/* What becomes of light that reaches the first hit along the scattered ray. */
typedef struct {
    float3 reflected; /* share that goes on to the camera, over the ray's density */
#if WEDGE_SIGNALS > 0
    float3 lobe_share;   /* of `reflected`: by the lobe */
    float diffuse, lobe; /* the same for kd = 1 and for ks = 1 alone */
#endif
} FirstBounce;

inline FirstBounce first_bounce(const Bsdf* f, const Surface* s, float3 wo, float3 wi, float3 value,
                                float pdf) {
    FirstBounce b;
    const float cos_over_pdf = dot(s->normal, wi) / pdf;
    b.reflected = value * cos_over_pdf;
#if WEDGE_SIGNALS > 0
    const float3 diffuse = f->diffuse * WEDGE_INV_PI;
    b.lobe_share = 1.0f - diffuse / fmax(value, 1e-30f);
    b.diffuse = WEDGE_INV_PI * cos_over_pdf;
    b.lobe = lobe_value(f, s->normal, wo, wi) * cos_over_pdf;
#endif
    return b;
}

#if WEDGE_SIGNALS > 0
/* Probe samples note how far away what they see from the first hit is. */
inline void note_reflector(const PixelSignals* signals, int surface, float distance, bool by_lobe) {
#ifdef WEDGE_FILTER_HEMISPHERE
    if (!signals->probing) return;
    add_distance(signals, surface, WEDGE_SIGNAL_DIFFUSE, distance);
#ifdef WEDGE_SPECULAR
    if (by_lobe) add_distance(signals, surface, WEDGE_SIGNAL_LOBE, distance);
#endif
#endif
}
#endif

#ifdef WEDGE_FILTER_HEMISPHERE
#define WEDGE_DEPTH_OF_DIRECT_SKY (-1) /* filtered with the rest of the hemisphere */

inline void add_hemisphere(const PixelSignals* signals, int surface, const FirstBounce* first,
                           float3 arriving) {
    const bool any = max_component(arriving) > 0.0f;
    const float3 none = (float3)(0.0f);
    add_signal(signals, surface, WEDGE_SIGNAL_DIFFUSE, any ? first->diffuse * arriving : none);
#ifdef WEDGE_SPECULAR
    add_signal(signals, surface, WEDGE_SIGNAL_LOBE, any ? first->lobe * arriving : none);
#endif
}
#else
#define WEDGE_DEPTH_OF_DIRECT_SKY 1
#endif

/* Russian roulette (Arvo, Kirk 1990): a ray costs as much where little is left to be carried on. Up to
   this loss since the first hit all paths go on, or smooth light would get the noise of the decision. */
#define WEDGE_LEAST_THROUGHPUT 0.5f

inline float chance_to_go_on(const Bsdf* f, float3 throughput) {
    return fmin(max_component(throughput * (f->diffuse + f->specular)) / WEDGE_LEAST_THROUGHPUT, 1.0f);
}

/* What chooses among the lights that are not filtered one by one. Of light straight from points halves
   need not be independent, and one sequence is better than two. */
#if WEDGE_SIGNALS > 0 && defined(WEDGE_POINT_LIGHTS_ALONE)
#define WEDGE_LIGHT_SAMPLER (depth == 0 ? signals->whole : sampler)
#else
#define WEDGE_LIGHT_SAMPLER sampler
#endif

inline PathResult trace_path(const Scene* scene, __global const FrameParams* params, Ray ray,
                             float3 view_axis,
                             const Sampler* sampler WEDGE_SIGNAL_PARAMS WEDGE_REPLAY_PARAMS) {
    PathResult result;
    WEDGE_IF_REPLAY(result.record = record;)
    result.emission = result.direct = result.indirect = (float3)(0.0f);
    result.albedo = result.normal = result.position = (float3)(0.0f);
    result.depth = result.hit = 0.0f;
    result.rays = 0;
#if WEDGE_SIGNALS > 0
    result.filtered_direct = result.filtered_indirect = (float3)(0.0f);
    result.remains = false;
    int surface = 0;
    bool by_lobe = false, lit = false;
#endif
#ifdef WEDGE_FILTER_OTHER_LIGHTS
    OtherLights other_lights = {signals, -1, (float3)(0.0f)};
    float3 diffuse = (float3)(0.0f); /* of the first hit */
#endif
    const float3 background = params->background.xyz;
    const int bounces = params->bounces;

    FirstBounce first;
    float3 arriving = (float3)(0.0f);   /* at the first hit, along the scattered ray */
    float3 throughput = (float3)(1.0f); /* since the first hit */
    /* The surface point itself: light was sampled as seen from there. */
    float3 ray_start = ray.origin;
    /* Of the ray, over solid angle; 0: only this ray could find the light. */
    float pdf_direction = 0.0f;
    for (int depth = 0; depth <= bounces + 1; ++depth) {
        result.rays += 1;
        const Hit hit = trace_closest(scene->tree, ray);
        if (hit.primitive == WEDGE_NO_PRIMITIVE) {
            if (depth == 0)
                result.emission = background;
            else if (depth == WEDGE_DEPTH_OF_DIRECT_SKY)
                result.direct += first.reflected * background;
            else
                arriving += throughput * background;
            WEDGE_IF_REPLAY(record_miss(result.record + depth, ray.direction,
                                        depth > 0 ? first.reflected * throughput : throughput,
                                        background);)
            break;
        }
        const float3 wo = -ray.direction;
        const Surface s = surface_at(scene, hit, wo);

        float pdf_light;
        const float3 emitted = emitted_radiance(scene, &s, ray_start, &pdf_light);
        if (max_component(emitted) > 0.0f) {
            float3 share = (float3)(1.0f);
#if WEDGE_SHADOW_LIGHTS > 0
            if (depth == 1)
                share = share_at_first_hit(scene, s.light, first.lobe_share, &pdf_light);
#endif
            const float weight =
                pdf_direction > 0.0f ? pdf_direction / (pdf_direction + pdf_light) : 1.0f;
            if (depth == 0)
                result.emission = emitted;
            else if (depth == 1)
                result.direct += first.reflected * share * emitted * weight;
            else
                arriving += throughput * emitted * weight;
#ifdef WEDGE_FILTER_OTHER_LIGHTS
            if (depth == 1 && !is_light(s.light))
                other_lights.arriving += first.diffuse * emitted * weight;
#endif
        }
        const Bsdf f = bsdf_at(scene, &s);
        if (depth == 0) {
            result.hit = 1.0f;
            result.albedo = f.diffuse + f.specular;
            result.normal = s.normal;
            result.position = s.position;
            result.depth = hit.t * dot(ray.direction, view_axis);
#if WEDGE_SIGNALS > 0
            surface = add_to_surface(signals, &s, &f, hit.t * signals->pixel_angle);
            lit = !signals->camera_only ||
                  ((surface < 0 || max_component(result.albedo) > 0.0f) && lacks_light(signals, surface));
#ifdef WEDGE_FILTER_OTHER_LIGHTS
            other_lights.surface = surface;
            diffuse = f.diffuse;
#endif
            if (!lit) {
#if WEDGE_SHADOW_LIGHTS > 0
                reflect_shadow_lights(scene, &s, &f, sampler, surface, signals);
#endif
                break;
            }
        } else if (depth == 1) {
            note_reflector(signals, surface, hit.t, by_lobe);
#endif
        }
        const float3 so_far = depth > 0 ? first.reflected * throughput : throughput;
        if (depth > bounces) {
            WEDGE_IF_REPLAY(record_hit(result.record + depth, hit.t, s.position, s.normal, so_far,
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
        float3 direct = (float3)(0.0f);
        uint first_light = 0;
#if WEDGE_SHADOW_LIGHTS > 0
        if (depth == 0) {
            first_light = WEDGE_SHADOW_LIGHTS;
            direct = sample_shadow_lights(scene, &s, &f, wo, sampler, surface, signals,
                                          &result.filtered_direct);
            result.rays += WEDGE_SHADOW_LIGHTS * WEDGE_LIGHT_RAYS;
        }
#endif
        if (scene->light_count > first_light) {
            const Sampler* light_sampler = WEDGE_LIGHT_SAMPLER;
#ifdef WEDGE_FILTER_OTHER_LIGHTS
            OtherLights* others = depth == 0 ? &other_lights : 0;
#endif
#if WEDGE_LIGHT_RAYS > 1
            direct += sample_direct_often(scene, &s, &f, wo, first_light, light_sampler, goes_on,
                                          &result.rays WEDGE_OTHERS_ARG);
#else
            const float2 u = draw_2d(light_sampler, vertex_dimension(depth, WEDGE_VERTEX_LIGHT));
            const float which =
                light_sampler == sampler
                    ? choice.x
                    : draw_2d(light_sampler, vertex_dimension(depth, WEDGE_VERTEX_CHOICE)).x;
            direct += sample_direct(scene, &s, &f, wo, first_light, which, u, goes_on,
                                    &result.rays WEDGE_OTHERS_ARG);
#endif
        }
        if (depth == 0)
            result.direct += direct;
        else
            arriving += throughput * direct;
        WEDGE_IF_REPLAY(record_hit(result.record + depth, hit.t, s.position, s.normal, so_far,
                                   emitted, direct, s.primitive, s.material);)
        if (!goes_on) break;
        const float chance = depth > 0 ? chance_to_go_on(&f, throughput) : 1.0f;
        if (!(choice.y < chance)) break;
        throughput /= chance;

        const float2 u = draw_2d(sampler, vertex_dimension(depth, WEDGE_VERTEX_DIRECTION));
        const float3 wi = sample_bsdf(&f, s.normal, wo, choice.y / chance, u);
        if (!is_above(&s, wi)) break;
        const float3 value = eval_bsdf(&f, s.normal, wo, wi, &pdf_direction);
        if (!(pdf_direction > 0.0f)) break;
        if (depth == 0) {
            first = first_bounce(&f, &s, wo, wi, value, pdf_direction);
#if WEDGE_SIGNALS > 0
            by_lobe = choice.y < f.specular_chance;
#endif
            if (!(max_component(first.reflected) > 0.0f)) break;
        } else {
            throughput *= value * (dot(s.normal, wi) / pdf_direction);
            if (!(max_component(throughput) > 0.0f)) break;
        }

        ray_start = s.position;
        ray.origin = offset_origin(s.position, s.position_error, s.face_normal, wi);
        ray.direction = wi;
        ray.t_max = INFINITY;
        ray.source = s.primitive;
    }
    if (max_component(arriving) > 0.0f) result.indirect = first.reflected * arriving;
#if WEDGE_SIGNALS > 0
    result.remains = surface < 0;
    if (surface < 0 && lit) add_to_remainder(signals, result.direct, result.indirect);
#endif
#if WEDGE_SIGNALS > WEDGE_SHADOW_LIGHTS
    /* What is black ends paths: it does not tell how bright its surroundings are. */
    if (surface >= 0 && lit && max_component(result.albedo) > 0.0f) {
#ifdef WEDGE_FILTER_OTHER_LIGHTS
        add_signal(signals, surface, WEDGE_SIGNAL_OTHERS, other_lights.arriving);
        result.filtered_direct += diffuse * other_lights.arriving;
#endif
#ifdef WEDGE_FILTER_HEMISPHERE
        add_hemisphere(signals, surface, &first, arriving);
        result.filtered_indirect = result.indirect;
#endif
    }
#endif
    return result;
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

#define WEDGE_IS_WHOLE_PATH (!signals.camera_only)
#define WEDGE_IS_NEW_RAY (!signals.known)
#else
#define WEDGE_IS_WHOLE_PATH true
#define WEDGE_IS_NEW_RAY true
#endif

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
    PixelSignals signals = {all_surfaces,
                            more_surfaces,
                            params->crop_width * params->crop_height,
                            (int)pixel,
                            all_sums,
                            all_distances,
                            all_reflected,
                            all_unfiltered + pixel,
                            all_remainders + pixel,
                            filter_settings->pixel_angle,
                            0,
                            0,
                            probing,
                            0,
                            0,
                            0,
                            0};
#endif
    for (uint batch = 0; batch < sample_count; batch += WEDGE_SAMPLE_BATCH) {
        FilmPixel sum = empty_film_pixel();
        for (uint i = 0; i < WEDGE_SAMPLE_BATCH && batch + i < sample_count; ++i) {
            const uint sample = first_sample + batch + i;
#if WEDGE_SIGNALS > 0
            signals.camera_only = sample >= ends.paths;
            signals.known = sample < ends.camera_rays_before;
            if (signals.camera_only ? signals.known : sample < ends.paths_before) continue;
#endif
            const Sampler sampler =
                make_sampler(params->sampler, params->seed, params->sequences,
                             (uint)params->strata, code, sample);
#if WEDGE_SIGNALS > 0
            const Sampler whole = make_sampler(params->sampler, params->seed, 1,
                                               (uint)params->strata, code, sample);
            signals.whole = &whole;
            signals.sample = sample;
            signals.half_index = sample & 1u;
            signals.probing_lights = probing && sample < WEDGE_LIGHT_PROBES;
#endif
            const float2 jitter =
                draw_film(&sampler, params->seed, params->sequences, code, sample);
            const Ray ray = camera_ray(&camera, (float2)((float)x + jitter.x, (float)y + jitter.y));
            const PathResult r =
                trace_path(&scene, params, ray, view_axis,
                           &sampler WEDGE_SIGNAL_ARGS WEDGE_IF_REPLAY(
                               , record + (batch + i) * (uint)(params->bounces + 2)));
            if (WEDGE_IS_WHOLE_PATH)
                add_sample(&sum, r.emission, r.direct, r.indirect, r.rays,
                           WEDGE_IS_NEW_RAY ? 1.0f : 0.0f);
#if WEDGE_SIGNALS > 0
            if (signals.camera_only)
                add_camera_sample(&sum, r.emission, r.rays);
            else
                add_unfiltered(&signals, &r);
#endif
            if (WEDGE_IS_NEW_RAY)
                add_first_hit(&sum, r.hit, r.albedo, r.depth, r.normal, r.position);
        }
        film[pixel] = sum_film_pixels(film[pixel], sum);
    }
}
