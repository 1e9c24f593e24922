/* What axis-aligned filtering of soft shadows keeps for each pixel and light. */
#ifndef WEDGE_SHARED_SHADOW_H
#define WEDGE_SHARED_SHADOW_H

#include "wedge/shared/portable.h"

WEDGE_SHARED_BEGIN

/* Most lights whose shadows are filtered; the others are left to Monte Carlo. */
#define WEDGE_MAX_SHADOW_LIGHTS 4

/* Sums over a pixel's samples for one light. Irradiance is by luminance. Distances run along the
   light's normal, in world units. */
typedef struct ShadowPixel {
    float4 reflected; /* rgb: kd / pi times unshadowed irradiance, from many points of the light; w:
                         the irradiance of the sampled point alone, unshadowed */
    float shadowed;   /* irradiance */
    float distance;   /* light to receiver, summed; probe samples only */
    float nearest;    /* light to occluder, least; +inf: none */
    float farthest;   /* light to occluder, largest; 0: none */
} ShadowPixel;
WEDGE_ASSERT_SIZE(ShadowPixel, 32);

/* Where a pixel's samples met the scene, on average. */
typedef struct GeometryPixel {
    float4 position; /* xyz, w: world length of a pixel seen face-on; 0: nothing there */
    float4 normal;   /* xyz unit, w: the same length with foreshortening, sqrt(A_p) */
} GeometryPixel;
WEDGE_ASSERT_SIZE(GeometryPixel, 32);

/* Settings of the method; the defaults are in host/render/shadow_settings.hpp. */
typedef struct ShadowSettings {
    float mu;    /* bandwidth scale: larger is narrower filters and more samples */
    float alpha; /* band limit of geometry as a share of the pixel's */
    float k_gaussian,
        k_uniform; /* standard deviations that a light's profile is taken to be wide */
    int probe_samples, max_samples;
    int max_radius_px;  /* of a filter */
    float pixel_angle;  /* world length of a pixel face-on, at distance 1 */
    float edge_samples; /* of pixels that show edges of geometry, at mu = 1 */
} ShadowSettings;
WEDGE_ASSERT_SIZE(ShadowSettings, 36);

WEDGE_SHARED_END

#endif
