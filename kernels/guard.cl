/* The guard: how much to filter is decided pixel by pixel, by estimated error.

   The two halves of a pixel's samples are independent, and so are what they are filtered to. The
   square of their difference tells noise. Bias is told by how the mean drifts from one width of the
   filter to the next wider one: the drifts of both halves have the same mean, and their product has
   the square of it as its own, free of noise (the dual buffers of Rousselle, Knaus, Zwicker 2012,
   but between neighbouring widths, as in Lepski's choice of a bandwidth, 1991). Each is known as well
   as what the narrower of two filters gives is free of noise. A rare bright sample in one half
   cancels. The narrowest "filter" leaves surfaces to the pixel's own samples. What no filter can
   change, coverage of the pixel by surfaces, is alike in all and does not count.

   All of them multiply means, of light by colour (and of how much of a lamp is seen by hue, but for
   what a few samples tell: lib/shadow_hue.clh), which is not the mean of the product where both vary
   together within a surface of a pixel. Radiance as it was sampled, by paths alone, has no such bias,
   and no other: drifts from there on add up to the bias of each filter.

     guard_errors   noise and drifts of each pixel
     guard_smooth   their means over neighbours along rows, by weight
     guard_choose   those along columns, and the mixture of the least error */
#include "lib/geometry.clh"
#include "lib/rest_noise.clh"
#include "lib/signal_list.clh"
#include "wedge/shared/filter.h"

inline float dot_rgb(float4 a, float4 b) {
    return dot(a.xyz, b.xyz) * (1.0f / 3.0f);
}

/* Of the mean of two halves. */
inline float noise_of(__global const float4* halves) {
    const float4 d = halves[0] - halves[1];
    return 0.25f * dot_rgb(d, d);
}

inline float drift_of(__global const float4* wide, __global const float4* narrow) {
    return dot_rgb(wide[0] - narrow[0], wide[1] - narrow[1]);
}

/* Radiance as sampled has the noise of light, and that of how much of each surface and colour samples
   happened to meet. Both are told by luminance. Places in the pixel are a net, of which a half is one
   by chance of every two: halves are off to opposite sides. A quarter of their squared difference,
   which is the mean square error were samples independent, is too much at edges: at a straight one
   this over sqrt(n) of it is (by simulation, n = 4 to 256, any direction and place). */
#define WEDGE_EDGE_SHARE 0.5f

inline float plain_noise(const float4* plain, __global const float4* own, float samples) {
    const float4 sum = plain[0] + plain[1];
    const float luminance_sum = luminance(sum.xyz);
    if (!(luminance_sum > 0.0f)) return 0.0f;
    const float light = own[0].w - own[1].w;
    const float edges = luminance(plain[0].xyz - plain[1].xyz) - light;
    const float square = light * light + WEDGE_EDGE_SHARE * rsqrt(samples) * edges * edges;
    const float4 colour = sum / luminance_sum; /* first: squares may have no place in a float */
    return 0.25f * square * dot_rgb(colour, colour);
}

/* `plain`: radiance as sampled, of both halves. `coverage`: of filter_none. `light`: by scale, `stride` apart. */
inline ScaleErrors errors_of(const float4* plain, float samples, float coverage, __global const HalfLight* light,
                             uint stride) {
    __global const float4 *a = light->halves, *b = light[stride].halves,
                          *c = light[2 * stride].halves, *d = light[3 * stride].halves;
    ScaleErrors e;
    const float drift = dot_rgb(a[0] - plain[0], a[1] - plain[1]);
    e.plain = (float4)(plain_noise(plain, a, samples), drift, drift * drift, coverage);
    e.noise = (float4)(noise_of(a), noise_of(b), noise_of(c), noise_of(d));
    const float first = drift_of(b, a);
    e.drift = (float4)(first * first, first, drift_of(c, b), drift_of(d, c));
    return e;
}

inline ScaleErrors no_errors(void) {
    const ScaleErrors none = {(float4)(0.0f), (float4)(0.0f), (float4)(0.0f)};
    return none;
}

/* `weight` times b is added; to variances of means, its square times. */
inline ScaleErrors add_errors(ScaleErrors a, float weight, ScaleErrors b) {
    const float square = weight * weight;
    const ScaleErrors sum = {a.noise + weight * b.noise,
                             a.drift + (float4)(square, weight, weight, weight) * b.drift,
                             a.plain + (float4)(weight, weight, square, weight) * b.plain};
    return sum;
}

/* Of a part. */
inline __global const float4* sampled(__global const SampledLight* light, uint part) {
    return WEDGE_DIRECT_SIGNALS > 0 && part == WEDGE_PART_DIRECT ? light->direct : light->indirect;
}

/* At least 1. */
inline float sample_count(__global const SampledLight* light) {
    return fmax(light->direct[0].w + light->direct[1].w, 1.0f);
}

/* Work-items of this and the next kernel: parts of pixels.

   A render that was stopped early has pixels without a second half. They know nothing: what their
   neighbours know decides, and if none knows anything, the filter is trusted. */
__kernel void guard_errors(__global const SampledLight* restrict unfiltered,
                           __global const HalfLight* restrict light, __global const float* restrict coverage,
                           __global ScaleErrors* restrict errors, uint count) {
    const uint id = get_global_id(0);
    if (id >= count) return;
    __global const SampledLight* u = unfiltered + id / WEDGE_PARTS;
    __global const float4* sums = sampled(u, id % WEDGE_PARTS);
    const float n0 = u->direct[0].w, n1 = u->direct[1].w;
    const float4 plain[2] = {sums[0] / n0, sums[1] / n1};
    errors[id] = n1 > 0.0f ? errors_of(plain, n0 + n1, coverage[id], light + id, count) : no_errors();
}

/* Mean of `errors` over WEDGE_GUARD_RADIUS pixels to each side, as far as they are on the film. The
   nearer they are the more they count, or what is only a line would drown in what is beside it. */
inline ScaleErrors mean_errors(__global const ScaleErrors* errors, int first, int stride,
                               int before, int after) {
    ScaleErrors sum = no_errors();
    float weights = 0.0f;
    const int begin = -min(before, WEDGE_GUARD_RADIUS), end = min(after, WEDGE_GUARD_RADIUS);
    for (int i = begin; i <= end; ++i) {
        const float weight = (float)(WEDGE_GUARD_RADIUS + 1 - abs(i));
        sum = add_errors(sum, weight, errors[first + i * stride]);
        weights += weight;
    }
    return add_errors(no_errors(), 1.0f / weights, sum);
}

__kernel void guard_smooth(__global const ScaleErrors* restrict errors,
                           __global ScaleErrors* restrict smoothed, int width, int height) {
    const int id = (int)get_global_id(0), x = id / WEDGE_PARTS % max(width, 1);
    if (id < width * height * WEDGE_PARTS)
        smoothed[id] = mean_errors(errors, id, WEDGE_PARTS, x, width - 1 - x);
}

/* Where it is a matter of luck which seems better, the wider filter is the better guess: before one
   is chosen, some standard errors of its estimate are taken off the square of a drift: two of that to
   the narrowest filter, as told by its spread over pixels, half of one of those between filters, as told
   by their noise (by measurement, docs/tried.md). The error that is told has none taken off. */
#define WEDGE_FIRST_DOUBT 2.0f
#define WEDGE_NEXT_DOUBT 0.5f
#define WEDGE_NO_DOUBT 0.0f

/* Samples of neighbours complement each other, so that fewer products are independent than there are
   pixels: what was sampled must be better by more than half of its own noise, too. */
#define WEDGE_PLAIN_DOUBT 1.0f
#define WEDGE_CLEARLY 1.5f

/* Magnitude of the drift from what was sampled to the pixel's own samples, or from them to the
   narrowest filter. Pixels are independent there, so that the squares of their products tell the
   `variance` of the mean: one pixel with bright samples in both halves proves nothing. The square
   of their product is infinite where radiance is beyond some 1e9. */
inline float first_drift(float product, float variance, float doubt) {
    const float luck = doubt > 0.0f ? doubt * sqrt(variance) : 0.0f;
    return sqrt(fmax(product - luck, 0.0f));
}

/* The bias of the pixel's own samples, which filters share. */
inline float shared_bias(ScaleErrors e, float doubt) {
    return first_drift(e.plain.y, e.plain.z, doubt);
}

/* Magnitude of the drift from a filter to the next wider one. What is smooth already is hardly
   averaged over neighbours. The halves' drifts have twice the variance of their mean's, which is
   what noise falls by. */
inline float next_drift(float product, float narrow_noise, float wide_noise, float doubt) {
    const float luck = doubt * 2.0f * fmax(narrow_noise - wide_noise, 0.0f);
    return sqrt(fmax(product - luck, 0.0f));
}

/* Mean square errors by scale, with a bias of the first one. */
inline float4 estimated_errors(ScaleErrors e, float shared, float first_doubt, float next_doubt) {
    const float4 n = e.noise;
    float4 bias;
    bias.x = shared;
    bias.y = bias.x + first_drift(e.drift.y, e.drift.x, first_doubt);
    bias.z = bias.y + next_drift(e.drift.z, n.y, n.z, next_doubt);
    bias.w = bias.z + next_drift(e.drift.w, n.z, n.w, next_doubt);
    return n + bias * bias;
}

/* The same, as they are told. */
inline float4 likely_errors(ScaleErrors e) {
    return estimated_errors(e, shared_bias(e, WEDGE_NO_DOUBT), WEDGE_NO_DOUBT, WEDGE_NO_DOUBT);
}

inline float4 mean_of_halves(__global const HalfLight* light) {
    return 0.5f * (light->halves[0] + light->halves[1]);
}

/* What is made of a part of a pixel. */
typedef struct {
    float4 light; /* rgb, w: width of the filter that was taken, as a share of the full one */
    float error;    /* mean square */
    float measured; /* the same, by the pixel's own halves alone */
} Chosen;

/* Mean square error of `share` of a filter and the rest of the pixel's own samples. What the
   filter changes has the filter's bias as its mean, in both halves; noise that halves have in
   common counts in the product, as it does in their mean. `shared`: bias of the pixel's own
   samples, of a mean over pixels. */
inline float measured_error(float share, __global const HalfLight* own,
                            __global const HalfLight* filtered, float shared) {
    __global const float4 *o = own->halves, *f = filtered->halves;
    const float4 noise = mix(o[0], f[0], share) - mix(o[1], f[1], share);
    const float product = share * share * dot_rgb(f[0] - o[0], f[1] - o[1]);
    return 0.25f * dot_rgb(noise, noise) + product +
           shared * (shared + 2.0f * sqrt(fmax(product, 0.0f)));
}

/* Bias and noise are independent, so the mean of a filter and none weighted by the errors is better
   than both. None is the pixel's own samples, and the bias that they share with filters does not
   count. Where that is clearly more than the noise of what was sampled (`unfiltered`), this takes
   their place, and the bias counts. `light`: by scale, `stride` apart. */
inline Chosen choose(ScaleErrors estimates, __global const HalfLight* light,
                     uint stride, float4 unfiltered) {
    const float widths[WEDGE_SCALES] = WEDGE_SCALE_WIDTHS;
    const float plain = estimates.plain.x, shared = shared_bias(estimates, WEDGE_PLAIN_DOUBT);
    const bool is_plain = WEDGE_CLEARLY * (plain + estimates.plain.w) < estimates.noise.x + shared * shared;
    const float4 errors =
        estimated_errors(estimates, is_plain ? shared : 0.0f, WEDGE_FIRST_DOUBT, WEDGE_NEXT_DOUBT);
    const float4 likely = likely_errors(estimates);
    const float by_scale[WEDGE_SCALES] = {errors.x, errors.y, errors.z, errors.w};
    const float told[WEDGE_SCALES] = {likely.x, likely.y, likely.z, likely.w};
    int best = WEDGE_SCALES - 1;
    for (int k = WEDGE_SCALES - 2; k > 0; --k)
        if (by_scale[k] < by_scale[best]) best = k;
    const float none_error = is_plain ? plain : errors.x, filter_error = by_scale[best];
    const float share = filter_error > 0.0f ? none_error / (none_error + filter_error) : 1.0f;
    const float rest = 1.0f - share;
    const float4 none = is_plain ? unfiltered : mean_of_halves(light);
    const float4 filtered = mean_of_halves(light + best * stride);
    const float error = share * share * told[best] + rest * rest * (is_plain ? plain : likely.x);
    const float shared_likely = shared_bias(estimates, WEDGE_NO_DOUBT);
    const Chosen c = {(float4)(mix(none.xyz, filtered.xyz, share), widths[best] * share), error,
                      is_plain ? error
                               : measured_error(share, light, light + best * stride,
                                                shared_likely)};
    return c;
}

/* `choose`, or the filter everywhere or nowhere. */
inline Chosen choose_by_mode(__constant FilterSettings* settings, ScaleErrors estimates,
                             __global const HalfLight* light, uint stride, float4 unfiltered) {
    if (settings->mode == WEDGE_FILTER_MODE_GUARDED)
        return choose(estimates, light, stride, unfiltered);
    const bool everywhere = settings->mode == WEDGE_FILTER_MODE_PLAIN;
    __global const HalfLight* filter = light + (WEDGE_SCALES - 1) * stride;
    const Chosen c = {(float4)(mean_of_halves(filter).xyz, 1.0f), likely_errors(estimates).w,
                      measured_error(1.0f, light, filter,
                                     shared_bias(estimates, WEDGE_NO_DOUBT))};
    const Chosen plain = {(float4)(unfiltered.xyz, 0.0f), estimates.plain.x, estimates.plain.x};
    return everywhere ? c : plain;
}

/* What the kernel below knows; the arrays are all pixels'. */
typedef struct {
    __constant FilterSettings* settings;
    __global const SampledLight* unfiltered;
    __global const HalfLight* light;
    __global const ScaleErrors* errors;
    int width, height;
} Guard;

inline Chosen choose_part(const Guard* guard, int x, int y, int part) {
    const int stride = guard->width * WEDGE_PARTS, id = y * stride + x * WEDGE_PARTS + part;
    const ScaleErrors estimates =
        mean_errors(guard->errors, id, stride, y, guard->height - 1 - y);
    __global const SampledLight* u = guard->unfiltered + y * guard->width + x;
    __global const float4* sums = sampled(u, (uint)part);
    const float4 mean = (sums[0] + sums[1]) / sample_count(u);
    return choose_by_mode(guard->settings, estimates, guard->light + id,
                          (uint)(stride * guard->height), mean);
}

__kernel void guard_choose(__constant FilterSettings* settings,
                           __global const SampledLight* restrict unfiltered,
                           __global const HalfLight* restrict light,
                           __global const ScaleErrors* restrict errors,
                           __global GuardedPixel* restrict guarded, int width, int height) {
    const int id = (int)get_global_id(0);
    if (id >= width * height) return;
    const Guard guard = {settings, unfiltered, light, errors, width, height};
    const int x = id % width, y = id / width;
    const Chosen nothing = {(float4)(0.0f), 0.0f, 0.0f};
    Chosen direct = nothing, indirect = nothing;
    if (WEDGE_DIRECT_SIGNALS > 0) direct = choose_part(&guard, x, y, WEDGE_PART_DIRECT);
    if (WEDGE_SIGNALS > WEDGE_DIRECT_SIGNALS)
        indirect = choose_part(&guard, x, y, WEDGE_PART_INDIRECT);
    const float rest = rest_noise_at(unfiltered, x, y, width, height).of_mean /
                       sample_count(unfiltered + id);
    const GuardedPixel g = {direct.light, indirect.light,
                            (float4)(direct.error, indirect.error, rest, 0.0f),
                            (float4)(direct.measured, indirect.measured, 0.0f, 0.0f)};
    guarded[id] = g;
}
