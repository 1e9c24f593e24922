// Traces buffers of rays, for tests and for measuring ray rates.
#include "kernels/lib/offset.clh"
#include "kernels/lib/trace.clh"

typedef struct {
    float ox, oy, oz, t_max;
    float dx, dy, dz;
    uint source;
} PackedRay;

inline Ray unpack_ray(__global const PackedRay* packed) {
    Ray ray;
    ray.origin = (float3)(packed->ox, packed->oy, packed->oz);
    ray.direction = (float3)(packed->dx, packed->dy, packed->dz);
    ray.t_max = packed->t_max;
    ray.source = packed->source;
    return ray;
}

__kernel void trace_closest_rays(WEDGE_TREE_PARAMS, __global const PackedRay* rays,
                                 __global Hit* hits, uint count) {
    uint i = get_global_id(0);
    if (i >= count) return;
    Tree tree = WEDGE_TREE;
    hits[i] = trace_closest(tree, unpack_ray(rays + i));
}

// A hit is t = 0, primitive = 0; a miss is t = t_max, primitive = WEDGE_NO_PRIMITIVE.
__kernel void trace_occluded_rays(WEDGE_TREE_PARAMS, __global const PackedRay* rays,
                                  __global Hit* hits, uint count) {
    uint i = get_global_id(0);
    if (i >= count) return;
    Tree tree = WEDGE_TREE;
    Ray ray = unpack_ray(rays + i);
    bool occluded = trace_occluded(tree, ray);
    Hit hit = {occluded ? 0.0f : ray.t_max, 0.0f, 0.0f, occluded ? 0u : WEDGE_NO_PRIMITIVE};
    hits[i] = hit;
}

// For each set of lanes, the values at them from packed[8 * set] on.
__kernel void pack_sets_of_lanes(__global const int* values, __global int* packed, uint count) {
    uint set = get_global_id(0);
    if (set >= count) return;
    int found[8];
    pack_lanes8(values, set, found);
    for (int i = 0; i < (int)popcount(set); i++) packed[8 * set + i] = found[i];
}

typedef struct {
    float4 v0, v1, v2;
    float4 barycentrics;
    float4 direction;
} OffsetQuery;

// Where a ray in `direction` starts that leaves the point of a triangle.
__kernel void offset_origins(__global const OffsetQuery* queries, __global float4* origins,
                             uint count) {
    uint i = get_global_id(0);
    if (i >= count) return;
    float3 v0 = queries[i].v0.xyz, v1 = queries[i].v1.xyz, v2 = queries[i].v2.xyz;
    float b1 = queries[i].barycentrics.x, b2 = queries[i].barycentrics.y;
    float3 point = (1.0f - b1 - b2) * v0 + b1 * v1 + b2 * v2;
    float3 normal = normalize(cross(v1 - v0, v2 - v0));
    float3 error = interpolation_error(v0, v1, v2, b1, b2);
    origins[i] = (float4)(offset_origin(point, error, normal, queries[i].direction.xyz), 0.0f);
}
