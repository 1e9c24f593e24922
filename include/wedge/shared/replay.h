/* What the path tracer writes down about one vertex of a path when a single pixel is replayed. */
#ifndef WEDGE_SHARED_REPLAY_H
#define WEDGE_SHARED_REPLAY_H

#include "wedge/shared/portable.h"

WEDGE_SHARED_BEGIN

#define WEDGE_REPLAY_UNUSED 0
#define WEDGE_REPLAY_HIT 1
#define WEDGE_REPLAY_MISS 2

typedef struct PathVertex {
    float4 position;   /* xyz, w: distance from the previous vertex */
    float4 normal;     /* xyz: shading normal */
    float4 throughput; /* rgb, up to this vertex */
    float4 emitted;    /* rgb: radiance the surface emits towards the path, unweighted */
    float4 direct;     /* rgb: light sampled here and scattered back, weighted */
    uint primitive, material;
    int kind; /* WEDGE_REPLAY_* */
    int unused;
} PathVertex;
WEDGE_ASSERT_SIZE(PathVertex, 96);

WEDGE_SHARED_END

#endif
