/* The tree as kernels read it, in three layouts of its nodes (docs/tracing.md). */
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

/* Kernels get such nodes and the blocks below in one array of rows, each node followed by its blocks; children are
   then the numbers of their first rows. */
typedef struct TreeRow {
    float values[8];
} TreeRow;
WEDGE_ASSERT_SIZE(TreeRow, 32);

/* The same in 80 bytes, after Ylitie, Karras and Laine 2017: planes are origin + step * byte,
   rounded outwards, so that boxes contain those they stand for. Children that are nodes lie side by
   side, and so do those that are blocks, both in the order of their slots. Slots are in space: bits
   0, 1, 2 of a slot tell which children lie farther along x, y, z. */
typedef struct CompressedNode {
    float origin[3];
    /* from the lowest bit: biased exponents of x, y, z; then a bit for each slot with a node */
    uint steps;
    uint first_node, first_block;
    uint leaves; /* a bit for each slot with a block */
    uint unused;
    uint planes[6][2]; /* row as in BvhNode; one byte a slot, the first slot lowest */
} CompressedNode;
WEDGE_ASSERT_SIZE(CompressedNode, 80);

/* Two children. The root of one leaf only has an empty second child. */
typedef struct BinaryNode {
    /* [axis]: lower and upper of the first child, lower and upper of the second */
    float bounds[3][4];
    int child[2]; /* as in BvhNode */
    int unused[2];
} BinaryNode;
WEDGE_ASSERT_SIZE(BinaryNode, 64);

#define WEDGE_BVH_WIDE 0
#define WEDGE_BVH_COMPRESSED 1
#define WEDGE_BVH_BINARY 2

/* Where an array does not fit into one buffer of the device, it is cut into at most this many. */
#define WEDGE_TREE_CHUNKS 8

/* A leaf: up to four triangles. Unused lanes are all zero, with primitive = WEDGE_NO_PRIMITIVE. */
typedef struct TriangleBlock {
    float v0[3][4], v1[3][4], v2[3][4]; /* [axis][lane], world units */
    uint primitive[4];
} TriangleBlock;
WEDGE_ASSERT_SIZE(TriangleBlock, 160);

#define WEDGE_NO_PRIMITIVE 0xffffffffu

/* A visit to a node leaves at most 7 children waiting, so a tree of WEDGE_MAX_DEPTH levels of nodes
   can never have more than this many waiting at once. The builder keeps to the depth. A binary node
   leaves one, and at most 7 of them lie one below the other in place of a wide one: the same. */
#define WEDGE_MAX_DEPTH 27
#define WEDGE_STACK_SIZE (7 * WEDGE_MAX_DEPTH + 1)

WEDGE_SHARED_END

#endif
