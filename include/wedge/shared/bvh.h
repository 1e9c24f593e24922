/* The 8-wide tree as kernels read it. */
#ifndef WEDGE_SHARED_BVH_H
#define WEDGE_SHARED_BVH_H

#include "wedge/shared/portable.h"

WEDGE_SHARED_BEGIN

/* Children side by side, so that one float8 operation tests all boxes against one plane.
   An unused slot has lower = +inf and upper = -inf, which no ray enters. */
typedef struct BvhNode {
    float bounds[6][8]; /* row 2 * axis + (0: lower, 1: upper) */
    int child[8];       /* >= 0: node index; < 0: ~index of a TriangleBlock */
} BvhNode;
WEDGE_ASSERT_SIZE(BvhNode, 224);

/* A leaf: up to four triangles. Unused lanes are all zero, with primitive = WEDGE_NO_PRIMITIVE. */
typedef struct TriangleBlock {
    float v0[3][4], v1[3][4], v2[3][4]; /* [axis][lane], world units */
    uint primitive[4];
} TriangleBlock;
WEDGE_ASSERT_SIZE(TriangleBlock, 160);

#define WEDGE_NO_PRIMITIVE 0xffffffffu

/* A visit to a node leaves at most 7 children waiting, so a tree of WEDGE_MAX_DEPTH levels of nodes
   can never have more than this many waiting at once. The builder keeps to the depth. */
#define WEDGE_MAX_DEPTH 27
#define WEDGE_STACK_SIZE (7 * WEDGE_MAX_DEPTH + 1)

WEDGE_SHARED_END

#endif
