/* Frequency analysis, between samples so far and those to come (path.cl), from what distances.cl
   has found:
     filter_brightness  sums over rows of the image so far
     filter_bandwidth   widths of filters and numbers of samples
   and, when all samples are there,
     filter_edge_noise  the error that edges inside pixels leave
   Arrays: include/wedge/shared/filter.h; places, found and sigmas in planes. */
#include "lib/contrast.clh"
#include "lib/probe_planes.clh"
#include "lib/rest_noise.clh"
#include "lib/signals.clh"
#include "lib/thin_things.clh"
#include "wedge/shared/frame.h"

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
    const float width =
        shadow_filter_sigma(slopes.x, sigma, pixel, settings->narrowing_shadows,
                            settings->alpha_direct, k);
    if (!(slopes.x > 0.0f)) /* an occluder that touches */
        return (float2)(width, (float)settings->max_samples);
    return (float2)(width, shadow_sample_count(slopes.x, slopes.y, sigma, pixel, settings->mu,
                                               settings->alpha_direct));
}

/* The thesis keeps z_min from being less than a share of the scene. Here it is kept from being less
   than where the filter is as narrow as pixels let it be: nearer ones do not add frequencies. */
inline float2 hemisphere_bandwidth(__constant FilterSettings* settings, float narrowing,
                                   float2 found, float band, float share, float pixel) {
    const float mu = settings->mu, alpha = settings->alpha_indirect;
    const float far_away = 1e6f * pixel;
    const float z_min = fmax(found.x > 0.0f ? 1.0f / found.x : far_away, band * pixel / alpha);
    const float z_max = fmax(found.y, z_min);
    return (float2)(indirect_filter_sigma(z_min, band, pixel, narrowing, alpha),
                    indirect_sample_count(z_min, z_max, band, share, pixel, mu, alpha));
}

inline float2 signal_bandwidth(__constant FilterSettings* settings, __global const Light* lights,
                               __global const SurfaceSum* sum, int signal, float2 found,
                               float pixel) {
    if (is_light(signal)) return light_bandwidth(settings, lights + signal, found, pixel);
    const bool is_diffuse = !is_lobe(signal) && !is_direct(signal);
    const float narrowing = is_diffuse ? settings->narrowing_diffuse : settings->narrowing_others;
    if (!is_lobe(signal))
        return max_component(sum->diffuse.xyz) > 0.0f
                   ? hemisphere_bandwidth(settings, narrowing, found, WEDGE_BAND_DIFFUSE,
                                          WEDGE_SHARE_DIFFUSE, pixel)
                   : (float2)(0.0f);
    const float shine = luminance(sum->specular.xyz); /* what exponents are weighted by */
    return shine > 0.0f ? hemisphere_bandwidth(settings, narrowing, found, sum->diffuse.w / shine,
                                               lobe_share(sum->normal.w / shine), pixel)
                        : (float2)(0.0f);
}

__kernel void filter_brightness(__global const FilmPixel* restrict film,
                                __global float* restrict rows, int width, int height) {
    const int y = (int)get_global_id(0);
    if (y >= height) return;
    float sum = 0.0f;
    for (int x = 0; x < width; ++x) sum += brightness(film + y * width + x);
    rows[y] = sum;
}

/* What the pixels around reflect, in the mean. One's own few samples are bright by luck here and there;
   if fewer followed where they are, the image would stay too bright. */
inline float reflected_brightness(__global const FilmPixel* film, Around a, int width) {
    float sum = 0.0f;
    for (int j = a.top; j <= a.bottom; ++j)
        for (int i = a.left; i <= a.right; ++i) {
            __global const FilmPixel* p = film + j * width + i;
            sum += brightness(p) - mean_emission(p);
        }
    return sum / (float)((a.right - a.left + 1) * (a.bottom - a.top + 1));
}

/* In the logarithm; v >= 1. The exponent of sqrt(2) v is that of v, rounded. */
inline float nearest_power_of_two(float v) {
    return as_float(as_int(1.41421356f * v) & 0x7f800000);
}

/* Camera rays of a pixel. What they are for is the noise of coverage, whose square falls with
   n^-1.5 under a low-discrepancy sequence and rises with the square of the contrast C; the square
   of the paths' noise falls with 1 / N, and N, their number, rises with mu. For a given time the sum
   of both is least where a little more time lowers them alike: C^2 n^-2.5 ~ N^-2 over the cost of a
   path, so that n goes with (mu C)^(2 / 2.5). The cost is in camera_rays_at_edges.

   Where an edge is too faint for the image to gain by that, it may still be all the error that there is
   near by. A pixel that has one gets as many camera rays as it would get paths if it needed them, and one
   beside it a few more than the probe's, which may have missed it. Textures have colours that differ
   everywhere. */
#define WEDGE_LEAST_AT_EDGES 128.0f    /* for mu = 1; where something thin is missed, too */
#define WEDGE_LEAST_AT_COLOURS 64.0f   /* for mu = 1; with its root, as the next */
#define WEDGE_LEAST_BESIDE_EDGES 16.0f
#define WEDGE_FAINTEST_EDGE FLT_MIN    /* contrast of what nobody has seen yet */
#define WEDGE_MOST_CAMERA_RAYS 4096.0f
#define WEDGE_CAMERA_RAYS_PER_PATH 40.0f /* where so many paths are allowed that these are more */

inline uint camera_rays(__constant FilterSettings* settings, float contrast,
                        float mean_brightness, float least_rays) {
    if (!(contrast > 0.0f && mean_brightness > 0.0f)) return 0u;
    const float n = (float)settings->camera_rays_at_edges *
                    power(settings->mu * contrast / mean_brightness, 0.8f);
    const float most =
        fmax(WEDGE_MOST_CAMERA_RAYS, WEDGE_CAMERA_RAYS_PER_PATH * (float)settings->max_samples);
    return (uint)nearest_power_of_two(clamp(n, fmin(least_rays, most), most));
}

inline float least_at_edges(__constant FilterSettings* settings) {
    return WEDGE_LEAST_AT_EDGES * settings->mu;
}

/* Of a pixel with these contrasts. `is_edge`: of geometry. */
inline uint camera_rays_of(__constant FilterSettings* settings, Contrast c, bool is_edge, float mean_brightness) {
    const float root = sqrt(settings->mu);
    const float least = is_edge ? least_at_edges(settings) : WEDGE_LEAST_AT_COLOURS * root;
    const uint here = camera_rays(settings, fmax(c.across, c.inside), mean_brightness, least);
    return max(here, camera_rays(settings, c.beside, mean_brightness, WEDGE_LEAST_BESIDE_EDGES * root));
}

/* Variance, from one sample to the next, of the radiance that a signal makes of a pixel. */
inline float radiance_variance(__global const SurfaceSum* sum, __global const float4* reflected,
                               int signal, float variance) {
    const float3 colour = is_light(signal)  ? reflected[reflected_at(0u, (uint)signal)].xyz
                          : is_lobe(signal) ? sum->specular.xyz
                                            : sum->diffuse.xyz;
    const float scale = luminance(colour) / sum->position.w;
    return variance * scale * scale;
}

/* The theory's number of samples keeps light of full contrast from aliasing. It is scaled by the
   contrast that there is: four times the variance as a share of the square of what counts as
   bright, since a light that half of the samples see has a variance of a quarter. It does not know
   noise: where filters shrink with mu, that of few samples would grow, so there are as many as keep
   it below a share of brightness that shrinks with mu, too. */
#define WEDGE_NOISE 0.01f /* for mu = 1 */

inline float noise_samples(float mu, float relative_variance, float pixels) {
    const float noise = WEDGE_NOISE / mu;
    return relative_variance / (fmax(pixels, 1.0f) * noise * noise);
}

/* Samples are shared by a power of what is asked for (samples_granted), so that pixels with little
   noise get more than they ask for, but far less than path tracing would give them. Filters make up
   for that. Where they reach no farther than the pixel nothing does, and faint shadows would be worse
   than without all this; so there are as many as at middling noise, up to those that bring noise to a
   quarter of what is aimed at. Over the root of the number of pixels reached: with its bias a narrow
   filter over n of them is worth about sqrt(n) times the samples. `asked`: by noise. */
#define WEDGE_LEAST_UNFILTERED 64.0f /* times mu, or its root where that is more */
#define WEDGE_LEAST_NOISE 0.25f

inline float least_samples(float mu, float asked, float pixels) {
    const float least = WEDGE_LEAST_UNFILTERED * fmax(mu, sqrt(mu)) / sqrt(fmax(pixels, 1.0f));
    return fmin(least, asked / (WEDGE_LEAST_NOISE * WEDGE_LEAST_NOISE));
}

/* Width of a signal's filter, how many samples it asks for, by theory and by noise, and how many it
   gets at least. `bright`: square of what counts as bright. */
typedef struct {
    float sigma, theory, noise, least;
} Need;

inline Need signal_need(__constant FilterSettings* settings, __global const Light* lights,
                        __global const SurfaceSum* sum, __global const float4* reflected,
                        int signal, float3 found, float slanted_size, float bright) {
    const float2 bandwidth =
        signal_bandwidth(settings, lights, sum, signal, found.xy, slanted_size);
    Need need = {bandwidth.x, 0.0f, 0.0f, 0.0f};
    const float relative = radiance_variance(sum, reflected, signal, fmax(found.z, 0.0f)) / bright;
    if (!(bandwidth.y > 0.0f && relative > 0.0f)) return need;
    const float pixels = 4.0f * WEDGE_PI * bandwidth.x * bandwidth.x / (slanted_size * slanted_size);
    /* Of a filtered light each ray is a sample. */
    const float share = is_light(signal) ? WEDGE_LIGHT_RAY_SHARE : 1.0f;
    need.theory = share * fmin(4.0f * relative, 1.0f) * bandwidth.y;
    need.noise = share * noise_samples(settings->mu, relative, pixels);
    if (is_light(signal)) need.least = least_samples(settings->mu, need.noise, pixels);
    return need;
}

/* near_by, ends, nearness: of filter_neighbours and filter_thin_things in distances.cl. sigmas: world
   units, 0 where nothing is to be filtered. sample_ends: paths a pixel is brought to are a power of
   two, which the sampler likes best; what it has already stays. */
__kernel void filter_bandwidth(
    __constant FilterSettings* settings, __global const FrameParams* restrict params,
    __global const Light* restrict lights, __global const float* restrict nearness,
    __global const FilmPixel* restrict film, __global const SurfaceSum* restrict surface_sums,
    __global const uint* restrict more, __global const float* restrict places,
    __global const float* restrict near_by,
    __global const float* restrict ends, __global const float4* restrict reflected,
    __global float* restrict sigmas, __global SampleEnds* restrict sample_ends,
    __global const SampledLight* restrict unfiltered, int width, int height, float mean_brightness) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const int x = pixel % width, y = pixel / width;
    const ulong at = pixel_at(&planes, x, y);
    const float seen = fmax(film[pixel].normal.w, 1.0f);
    const float here = reflected_brightness(film, around(x, y, width, height), width);
    const float bright = fmax(here * here + mean_brightness * mean_brightness, 1e-30f);
    const RestNoise rest = rest_noise_at(unfiltered, x, y, width, height);
    float theory = 0.0f, noise = noise_samples(settings->mu, rest.of_sample / bright, 1.0f);
    float least = (float)settings->least_samples;
    for (int k = 0; k < WEDGE_SURFACES; ++k) {
        const int id = surface_entry(more, width * height, pixel, k);
        const float size = WEDGE_PLACE(&planes, places, k, WEDGE_PLACE_SIZE, at);
        if (!(size > 0.0f && id >= 0)) break;
        const float slanted_size = WEDGE_PLACE(&planes, places, k, WEDGE_PLACE_SLANTED_SIZE, at);
        const float share = surface_sums[id].position.w / seen;
        float most = 0.0f;
        for (int signal = 0; signal < WEDGE_SIGNALS; ++signal) {
            const int entry = k * WEDGE_SIGNALS + signal;
            const float3 found = {WEDGE_FOUND(&planes, near_by, entry, WEDGE_FOUND_LEAST, at),
                                  WEDGE_FOUND(&planes, near_by, entry, WEDGE_FOUND_MOST, at),
                                  WEDGE_FOUND(&planes, near_by, entry, WEDGE_FOUND_VARIANCE, at)};
            const Need need = signal_need(settings, lights, surface_sums + id,
                                          reflected + reflected_at((uint)id, 0u), signal, found,
                                          slanted_size, bright);
            sigmas[entry * planes.size + at] = need.sigma;
            most = fmax(most, need.theory);
            noise += need.noise * share;
            least = fmax(least, need.least);
        }
        theory += most * share;
    }
    const float samples = samples_granted(settings->mu, fmax(theory, noise));
    const float probes = (float)settings->probe_samples, cap = (float)settings->max_samples;
    const float rounded = nearest_power_of_two(clamp(fmax(samples, least), probes, cap));
    const SampleEnds before = sample_ends[pixel];
    const uint end = max((uint)clamp(rounded, least, cap), before.paths_before);
    const SurfaceSums surfaces = {surface_sums, more};
    const bool is_edge = ends[at] > 0.0f || has_more_surfaces(film + pixel, surface_sums + pixel);
    const Contrast contrast = contrast_at(film, surfaces, is_edge, x, y, width, height);
    uint rays = camera_rays_of(settings, contrast, is_edge, mean_brightness);
    /* Also where it has been met, or those who met it by luck would stop there, with too much of it. */
    const bool shows_thin_thing = nearness[pixel] > 0.0f && is_edge;
    if (shows_thin_thing || misses_thin_thing(params, nearness[pixel], &planes, places, x, y))
        rays = max(rays, camera_rays(settings, WEDGE_FAINTEST_EDGE, mean_brightness, least_at_edges(settings)));
    sample_ends[pixel].paths = end;
    sample_ends[pixel].camera_rays = max(max(end, before.camera_rays_before), rays);
}

/* A straight edge of contrast C across a pixel leaves an error of mean square 0.11 C^2 n^-1.5 with n
   points of a scrambled Sobol sequence (by simulation, n = 16 to 256, any direction and place). The
   difference to the next pixels is not C: for an edge at a uniformly random place the largest has
   the mean square 7/12 C^2 in its pixel, and 1/3 C^2 in those on both sides, which have no error. */
#define WEDGE_EDGE_NOISE 0.11f
#define WEDGE_SQUARES_ACROSS (7.0f / 12.0f + 2.0f / 3.0f)

__kernel void filter_edge_noise(__global const FilmPixel* restrict film,
                                __global const SurfaceSum* restrict surface_sums,
                                __global const uint* restrict more,
                                __global const float* restrict ends,
                                __global GuardedPixel* restrict guarded, int width, int height) {
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * height) return;
    const Planes planes = make_planes(width, height);
    const int x = pixel % width, y = pixel / width;
    const bool is_edge = ends[pixel_at(&planes, x, y)] > 0.0f || has_more_surfaces(film + pixel, surface_sums + pixel);
    const SurfaceSums surfaces = {surface_sums, more};
    const Contrast c = contrast_at(film, surfaces, is_edge, x, y, width, height);
    const float n = fmax(film[pixel].normal.w, 1.0f);
    const float square = fmax(c.across * c.across / WEDGE_SQUARES_ACROSS, c.inside * c.inside);
    guarded[pixel].error.w = WEDGE_EDGE_NOISE * square / (n * sqrt(n));
}
