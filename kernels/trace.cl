// Traces buffers of rays, for tests and for measuring ray rates.
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

__kernel void trace_closest_rays(__global const BvhNode* nodes,
                                 __global const TriangleBlock* blocks,
                                 __global const PackedRay* rays, __global Hit* hits, uint count) {
    uint i = get_global_id(0);
    if (i >= count) return;
    hits[i] = trace_closest(nodes, blocks, unpack_ray(rays + i));
}

// A hit is t = 0, primitive = 0; a miss is t = t_max, primitive = WEDGE_NO_PRIMITIVE.
__kernel void trace_occluded_rays(__global const BvhNode* nodes,
                                  __global const TriangleBlock* blocks,
                                  __global const PackedRay* rays, __global Hit* hits,
                                  uint count) {
    uint i = get_global_id(0);
    if (i >= count) return;
    Ray ray = unpack_ray(rays + i);
    bool occluded = trace_occluded(nodes, blocks, ray);
    Hit hit = {occluded ? 0.0f : ray.t_max, 0.0f, 0.0f, occluded ? 0u : WEDGE_NO_PRIMITIVE};
    hits[i] = hit;
}
