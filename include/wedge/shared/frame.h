/* What a launch of the path tracer needs to know, and what it leaves behind. */
#ifndef WEDGE_SHARED_FRAME_H
#define WEDGE_SHARED_FRAME_H

#include "wedge/shared/portable.h"

WEDGE_SHARED_BEGIN

/* A point (x, y) of the film, in pixels from the top left, looks along
   corner + x * step_x + y * step_y (not normalised) from `position`. */
typedef struct CameraRays {
    float4 position; /* w: largest magnitude of a coordinate */
    float4 corner, step_x, step_y;
} CameraRays;
WEDGE_ASSERT_SIZE(CameraRays, 64);

#define WEDGE_SAMPLER_HASH 0
#define WEDGE_SAMPLER_SOBOL 1
#define WEDGE_SAMPLER_STRATIFIED 2
#define WEDGE_SAMPLER_LATTICE 3

typedef struct FrameParams {
    CameraRays camera;
    float4 background; /* rgb radiance */
    int crop_x, crop_y, crop_width, crop_height; /* px of the whole film */
    uint seed;
    int sampler;
    int sequences; /* of the Sobol sampler: 1, or 2 where even and odd samples are told apart */
    int bounces;
    int search_lights; /* 1: there is light that sampling finds badly or not at all: background,
                          meshes */
    int strata;        /* samples that the stratified sampler deals out at a time, > 0 */
} FrameParams;
WEDGE_ASSERT_SIZE(FrameParams, 128);

/* Sums over a pixel's samples, owned by one work-item. */
typedef struct FilmPixel {
    float4 emission; /* rgb: light seen directly, w: samples that hit anything */
    float4 direct;   /* rgb, w: samples of all but `emission` */
    float4 indirect; /* rgb, w: rays traced */
    float4 square;   /* rgb: sum of the squared total radiance, w: non-finite samples, dropped */
    float4 albedo;   /* rgb: kd + ks at the first hit, w: distance along the view axis */
    float4 normal;   /* xyz: shading normal at the first hit, w: camera rays */
    float4 position; /* xyz: first hit, w: samples of `emission` */
} FilmPixel;
WEDGE_ASSERT_SIZE(FilmPixel, 112);

WEDGE_SHARED_END

#endif
