/* The flattened scene as kernels read it. */
#ifndef WEDGE_SHARED_SCENE_H
#define WEDGE_SHARED_SCENE_H

#include "wedge/shared/portable.h"

WEDGE_SHARED_BEGIN

/* A vertex in world space. A normal of zero length means: use the face's. */
typedef struct ShadingVertex {
    float px, py, pz;
    float nx, ny, nz;
    float u, v;
} ShadingVertex;
WEDGE_ASSERT_SIZE(ShadingVertex, 32);

typedef struct ShadingTriangle {
    uint v0, v1, v2; /* vertices, counter-clockwise seen from the front */
    uint material;
    int light; /* index of the light this triangle is (a part of), -1: none */
} ShadingTriangle;
WEDGE_ASSERT_SIZE(ShadingTriangle, 20);

#define WEDGE_MODEL_LAMBERT 0
#define WEDGE_MODEL_PHONG 1
#define WEDGE_MODEL_BLINN_PHONG 2

typedef struct SurfaceMaterial {
    float4 diffuse;  /* rgb */
    float4 specular; /* rgb, w: exponent */
    int diffuse_texture, specular_texture, emission_texture;
    int model;
    int normal_texture, bump_texture; /* -1: none; at most one is set */
    int unused[2];
} SurfaceMaterial;
WEDGE_ASSERT_SIZE(SurfaceMaterial, 64);

#define WEDGE_TEXTURE_SRGB8 0
#define WEDGE_TEXTURE_LINEAR8 1
#define WEDGE_TEXTURE_FLOAT32 2

/* sRGB bytes become linear by a table, so many numbers before all texels. */
#define WEDGE_SRGB_TABLE 256

typedef struct TextureInfo {
    uint offset; /* of the first texel, in units of 4 bytes, in the texel buffer */
    int width, height;
    int format;
    float scale_u, scale_v, offset_u, offset_v;
    float value_gain, value_base;
    int clamp_to_edge;
    int unused;
} TextureInfo;
WEDGE_ASSERT_SIZE(TextureInfo, 48);

#define WEDGE_LIGHT_RECT 0
#define WEDGE_LIGHT_TRIANGLE 1
#define WEDGE_LIGHT_POINT 2

/* Rectangle: points origin + a * edge_u + b * edge_v, a and b in [0, 1].
   Triangle: the same with a + b <= 1. Point: origin alone. Emits to the side `normal` points to. */
typedef struct Light {
    float4 origin;   /* xyz, w: area (m^2) */
    float4 edge_u;   /* xyz, w: standard deviation along u as a fraction of |edge_u|; 0: uniform */
    float4 edge_v;   /* xyz, w: the same along v */
    float4 normal;   /* xyz unit, w: probability that this light is chosen */
    float4 radiance; /* rgb (point: intensity), w: running sum of the probabilities up to and with
                        this light */
    int kind;
    int emission_texture; /* -1: none */
    uint primitive;       /* of a triangle light, for its texture coordinates */
    int unused;
    float4 profile; /* of a rectangle. x, y: share of a Gaussian that lies between the edges, along
                       u and v; z: mean emission over the rectangle, as a share of its centre's */
    float4 nodes;   /* of a rectangle, to integrate by its profile with three points along an edge:
                       the middle and, x: along u, y: along v, so far to both sides as a share of the
                       edge; z, w: weight of each of those two; the middle has the rest of 1 */
} Light;
WEDGE_ASSERT_SIZE(Light, 128);

WEDGE_SHARED_END

#endif
