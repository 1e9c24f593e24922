/* What axis-aligned filtering keeps of a pixel's samples.

   A pixel may show more than one surface; its samples are told apart, so that each surface is
   filtered with its like. Light is kept as signals, which tell what is smooth along a surface where
   its colour need not be: luminance that is reflected of each filtered light, with and without
   shadow, whose ratio is how much of the light is seen; then irradiance from the hemisphere, then
   what the lobe reflects of the hemisphere. Samples are summed in two halves, whose difference
   tells the error.

   Arrays: a surface's entry is that of surface_entry in kernels/lib/surfaces.clh; signals are at
   that * signals + signal, sums of signals at that * 2 + half. */
#ifndef WEDGE_SHARED_FILTER_H
#define WEDGE_SHARED_FILTER_H

#include "wedge/shared/portable.h"

WEDGE_SHARED_BEGIN

/* Most lights whose shadows are filtered; the others are left to Monte Carlo. */
#define WEDGE_MAX_SHADOW_LIGHTS 4
#define WEDGE_SURFACES 3

/* Most pixels show one surface. The others' entries come after those of all first surfaces, so that
   memory for surfaces that nobody sees is never touched. */
#define WEDGE_MORE_SURFACES (WEDGE_SURFACES - 1)

/* Where shadows may vary with hue: sums beside unshadowed light, for each light of a surface, and
   numbers that the light of a pixel's first surface is corrected by, in place of one. */
#define WEDGE_HUE_SUMS 4
#define WEDGE_HUE_CORRECTIONS 7

/* Samples, the first of a pixel, whose shadow rays look for the nearest occluder. */
#define WEDGE_LIGHT_PROBES 8

/* Sums over the samples of a pixel that met the same surface. */
typedef struct SurfaceSum {
    float4 position; /* xyz, w: samples */
    float4 normal;   /* xyz, w: exponents of the lobe, each times the luminance of ks */
    float4 diffuse;  /* rgb: kd, w: band limits of the lobe, Omega_h, times the same */
    float4 specular; /* rgb: ks, w: squares of the luminance of kd + ks */
} SurfaceSum;
WEDGE_ASSERT_SIZE(SurfaceSum, 64);

/* Samples of a pixel: those before `paths` are whole paths, the others only look at what the camera
   sees. `before`: those it has. */
typedef struct SampleEnds {
    uint paths, camera_rays;
    uint paths_before, camera_rays_before;
} SampleEnds;
WEDGE_ASSERT_SIZE(SampleEnds, 16);

/* What probe samples tell of the distances that decide a signal's frequencies. Of a light: from it
   to occluders, along its normal. Of the hemisphere: from the surface to what it sees. World units.
 */
typedef struct DistanceRange {
    float nearest;  /* meaningless if nothing was found */
    float farthest; /* 0: nothing found */
    float receiver; /* lights: from light to receiver, summed over probe samples */
    float samples;  /* probe samples */
} DistanceRange;
WEDGE_ASSERT_SIZE(DistanceRange, 16);

/* Sums over a pixel's samples: radiance that filters are for, by halves; light that is not
   filtered. */
typedef struct SampledLight {
    float4 direct[2];   /* rgb, w: samples */
    float4 indirect[2]; /* rgb, w: 0 */
    float4 rest; /* luminance of what is not filtered; x: of all samples, y: of the first 2^k, as
                    many as there are, but not all; z: of half of those; w: of odd ones */
} SampledLight;
WEDGE_ASSERT_SIZE(SampledLight, 80);

/* Sums over the paths that met a surface of the pixel which is one too many. */
typedef struct Remainder {
    float4 direct;   /* rgb, w: paths */
    float4 indirect; /* rgb, w: 0 */
} Remainder;
WEDGE_ASSERT_SIZE(Remainder, 32);

/* Parts of a pixel's light that are filtered apart: direct, then indirect, as far as a plan has
   signals of them. One of the parts, filtered, by halves of the pixel's samples. */
typedef struct HalfLight {
    float4 halves[2]; /* rgb, w: of the first scale, luminance with the noise that light has as it
                         was sampled; else of no use */
} HalfLight;
WEDGE_ASSERT_SIZE(HalfLight, 32);

/* Filters that the guard chooses from, by the share of the width that theory asks for; the first
   leaves each pixel to its own samples. Light is at (scale * pixels + pixel) * parts + part. */
#define WEDGE_SCALES 4
#define WEDGE_SCALE_WIDTHS \
    { 0.0f, 0.25f, 0.5f, 1.0f }

/* Errors are means over pixels up to so far away, along rows and columns, with weights that fall to
   nothing beyond: as steady as plain means over 12x12 pixels. */
#define WEDGE_GUARD_RADIUS 7

/* What the halves tell of the errors of filters of a part, by scale; at pixel * parts + part. */
typedef struct ScaleErrors {
    float4 noise; /* mean square, of the mean of both halves */
    float4 drift; /* y, z, w: square of what the filter adds to the bias of the next narrower one;
                     x: square of y, of a pixel; of a mean over pixels, its variance */
    float4 plain; /* of the pixel's radiance as it was sampled; x: noise; y: square of the drift
                     from it to the first scale; z: as drift.x, of y; w: more noise, of where paths
                     looked, that x may not tell */
} ScaleErrors;
WEDGE_ASSERT_SIZE(ScaleErrors, 48);

/* What the guard made of a pixel. */
typedef struct GuardedPixel {
    float4 direct;   /* rgb, w: width of the filter that was taken, as a share of the full one */
    float4 indirect; /* rgb, w: the same */
    float4 error;    /* estimated mean square errors; x, y: of the two over rgb; z: of light not
                        filtered; w: of edges in the pixel */
    float4 measured; /* x, y: the first two where this pixel's halves tell them, which is right in
                        the mean over pixels and may be below 0; z, w: 0 */
} GuardedPixel;
WEDGE_ASSERT_SIZE(GuardedPixel, 64);

/* Mean place of a surface in a pixel, in planes (planes.h), WEDGE_PLACE_PLANES a surface: position
   in the world, length of a pixel there seen face-on (0: nothing is there), unit normal, and the
   same length with foreshortening, sqrt(A_p). A pixel's surfaces are the first of the list: there
   is none after one that is not there. */
#define WEDGE_PLACE_X 0
#define WEDGE_PLACE_Y 1
#define WEDGE_PLACE_Z 2
#define WEDGE_PLACE_SIZE 3
#define WEDGE_PLACE_NX 4
#define WEDGE_PLACE_NY 5
#define WEDGE_PLACE_NZ 6
#define WEDGE_PLACE_SLANTED_SIZE 7
#define WEDGE_PLACE_PLANES 8

/* What the probe found for a signal of a surface, in planes, WEDGE_FOUND_PLANES an entry; the least
   is below 0 where it found nothing. */
#define WEDGE_FOUND_LEAST 0    /* of a light, the least slope; of the hemisphere, 1 / z_min */
#define WEDGE_FOUND_MOST 1     /* of a light, the largest slope; of the hemisphere, z_max */
#define WEDGE_FOUND_VARIANCE 2 /* from one sample to the next; < 0: not known */
#define WEDGE_FOUND_PLANES 3

/* Means of signals over a pixel's samples, in planes, those of one surface after those of another:
   by filtered light luminance with and without shadow, of the first half, then of the second; then
   of signals from the hemisphere rgb and the share of the pixel, of both halves. */
#define WEDGE_LIGHT_PLANES 4
#define WEDGE_HEMISPHERE_PLANES 8

/* Settings of the method; the defaults are in host/render/filter_settings.cpp. */
typedef struct FilterSettings {
    float mu; /* bandwidth scale: larger is more samples */
    /* Widths of filters are what theory asks for at mu = 1 over these: of shadows, of irradiance
       from the hemisphere, of what lobes reflect and light of other lamps. */
    float narrowing_shadows, narrowing_diffuse, narrowing_others;
    float alpha_direct; /* band limit of geometry as a share of the pixel's */
    float alpha_indirect;
    float k_gaussian,
        k_uniform;     /* standard deviations that a light's profile is taken to be wide */
    float pixel_angle; /* world length of a pixel face-on, at distance 1 */
    int probe_samples, max_samples;
    int max_radius_px;        /* of a filter */
    int camera_rays_at_edges; /* whose contrast is the mean brightness; mu = 1 */
    int least_samples;        /* that every pixel gets, whatever its frequencies */
    int mode;                 /* WEDGE_FILTER_MODE_* */
} FilterSettings;
WEDGE_ASSERT_SIZE(FilterSettings, 60);

/* What is done with what was sampled: guarded filters, filters everywhere, none. */
#define WEDGE_FILTER_MODE_GUARDED 0
#define WEDGE_FILTER_MODE_PLAIN 1
#define WEDGE_FILTER_MODE_NONE 2

WEDGE_SHARED_END

#endif
